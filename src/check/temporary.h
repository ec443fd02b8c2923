// Pictures that a scene has to read from files: written to a folder of their own, which goes when they do.
#pragma once
#include <stdlib.h>

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>

#include "../output/image_file.h"

namespace phalanx::check {

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = std::filesystem::temp_directory_path() / "phalanx-check-XXXXXX";
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("cannot make a temporary folder");
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder &) = delete;
  TemporaryFolder &operator=(const TemporaryFolder &) = delete;

  /// Writes a grey picture and returns its path; the extension says how.
  std::string picture(const std::string &name, int width, int height,
                      const std::function<float(int x, int y)> &value) const {
    Image image = make_image(width, height);
    for (const char *channel : {"R", "G", "B"}) {
      std::vector<float> &values = add_channel(image, channel);
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
          values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] = value(x, y);
    }
    const std::string path = path_ / name;
    write_image(path, image, 0);
    return path;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace phalanx::check
