// OpenEXR over memory: the library never sees a file, so no write error can escape it unnoticed.
#include "exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>

#include <cstring>
#include <stdexcept>

#include "../core/error.h"
#include "limits.h"

namespace phalanx {
namespace {

class MemoryWriter : public Imf::OStream {
 public:
  MemoryWriter() : OStream("memory") {}
  void write(const char data[], int n) override {
    const std::size_t end = at_ + static_cast<std::size_t>(n);
    if (end > bytes.size()) bytes.resize(end);
    std::memcpy(bytes.data() + at_, data, static_cast<std::size_t>(n));
    at_ = end;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t position) override { at_ = position; }

  std::string bytes;

 private:
  std::size_t at_ = 0;
};

class MemoryReader : public Imf::IStream {
 public:
  explicit MemoryReader(const std::string &bytes) : IStream("memory"), bytes_(bytes) {}
  bool read(char data[], int n) override {
    if (n < 0 || at_ > bytes_.size() || static_cast<std::size_t>(n) > bytes_.size() - at_)
      throw std::runtime_error("the file ends too early");
    std::memcpy(data, bytes_.data() + at_, static_cast<std::size_t>(n));
    at_ += static_cast<std::size_t>(n);
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t position) override { at_ = position; }

 private:
  const std::string &bytes_;
  std::size_t at_ = 0;
};

/// OpenEXR addresses pixels by their place in the data window: pixel (x, y) is at
/// base + x * sizeof(float) + y * row. The sum is taken in integers: base itself may lie outside.
Imf::Slice slice_of(const Imath::Box2i &window, float *values) {
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const auto row_bytes = static_cast<std::int64_t>(sizeof(float)) * width;
  const std::int64_t offset =
      window.min.y * row_bytes + window.min.x * static_cast<std::int64_t>(sizeof(float));
  auto *base = reinterpret_cast<char *>(reinterpret_cast<std::intptr_t>(values) - offset);
  return Imf::Slice(Imf::FLOAT, base, sizeof(float), static_cast<std::size_t>(row_bytes));
}

Image image_of_header(const Imf::Header &header, std::size_t file_size, const std::string &name,
                      std::int64_t max_pixels) {
  const Imath::Box2i data = header.dataWindow(), display = header.displayWindow();
  std::int64_t num_channels = 0;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
    if (c.channel().xSampling != 1 || c.channel().ySampling != 1)
      throw InputError(
          fmt::format("{}: channel {} is subsampled; that is not supported", name, c.name()));
    num_channels++;
  }
  const std::int64_t width = std::int64_t{data.max.x} - data.min.x + 1;
  const std::int64_t height = std::int64_t{data.max.y} - data.min.y + 1;
  const double max_ratio = 65536;  // a constant picture under PIZ comes near
  check_image_claim(width, height, 4 * num_channels, file_size, max_ratio, name, max_pixels);

  Image image = make_image(static_cast<int>(width), static_cast<int>(height));
  image.x = data.min.x - display.min.x;
  image.y = data.min.y - display.min.y;
  image.full_width = display.max.x - display.min.x + 1;
  image.full_height = display.max.y - display.min.y + 1;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
    add_channel(image, c.name());
  for (auto a = header.begin(); a != header.end(); ++a)
    if (const auto *text = dynamic_cast<const Imf::StringAttribute *>(&a.attribute()))
      image.metadata.emplace_back(a.name(), text->value());
  return image;
}

}  // namespace

std::string encode_exr(const Image &image) {
  const Imath::Box2i display({0, 0}, {image.full_width - 1, image.full_height - 1});
  const Imath::Box2i data({image.x, image.y},
                          {image.x + image.width - 1, image.y + image.height - 1});
  Imf::Header header(display, data);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const auto &[key, value] : image.metadata) header.insert(key, Imf::StringAttribute(value));
  Imf::FrameBuffer pixels;
  for (const Channel &channel : image.channels) {
    header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
    pixels.insert(channel.name, slice_of(data, const_cast<float *>(channel.values.data())));
  }
  MemoryWriter stream;
  {
    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(pixels);
    file.writePixels(image.height);
  }  // the destructor completes the table of scanlines
  return std::move(stream.bytes);
}

Image decode_exr(const std::string &bytes, const std::string &name, std::int64_t max_pixels) {
  try {
    Imf::Header::setMaxImageSize(kMaxImageSide, kMaxImageSide);
    MemoryReader stream(bytes);
    Imf::InputFile file(stream);
    Image image = image_of_header(file.header(), bytes.size(), name, max_pixels);
    const Imath::Box2i data = file.header().dataWindow();
    Imf::FrameBuffer pixels;
    for (Channel &channel : image.channels)
      pixels.insert(channel.name, slice_of(data, channel.values.data()));
    file.setFrameBuffer(pixels);
    file.readPixels(data.min.y, data.max.y);
    return image;
  } catch (const InputError &) {
    throw;
  } catch (const std::bad_alloc &) {
    throw;
  } catch (const std::exception &error) {
    throw InputError(fmt::format("{}: not an EXR that can be read: {}", name, error.what()));
  }
}

}  // namespace phalanx
