#include "share_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <type_traits>

#include "../core/bytes.h"
#include "../core/error.h"
#include "../scene/scene_bytes.h"
#include "../wavefront/isa.h"

namespace phalanx {
namespace {

template <typename T>
void broadcast_value(Ranks &ranks, T &value) {
  static_assert(std::is_trivially_copyable_v<T>);
  ranks.broadcast(std::as_writable_bytes(std::span(&value, 1)));
}

void broadcast_text(Ranks &ranks, std::string &text) {
  std::uint64_t size = text.size();
  broadcast_value(ranks, size);
  text.resize(size);
  ranks.broadcast(std::as_writable_bytes(std::span(text.data(), text.size())));
}

std::vector<std::byte> outcome(int code, const std::string &text) {
  ByteWriter out;
  out.put(code);
  out.put_text(text);
  return out.take();
}

[[noreturn]] void throw_as(int code, const std::string &text) {
  if (code == kExitBadInput) throw InputError(text);
  if (code == kExitOutOfMemory) throw MemoryError(text);
  if (code == kExitCannotWrite) throw WriteError(text);
  throw std::runtime_error(text);
}

}  // namespace

void agree(Ranks &ranks, const std::function<void()> &step) {
  if (ranks.size() == 1) return step();
  std::exception_ptr own;
  int code = kExitDone;
  std::string text;
  const auto failed = [&](int with, const char *what) {
    own = std::current_exception();
    code = with;
    text = what;
  };
  try {
    step();
  } catch (const InputError &error) {
    failed(kExitBadInput, error.what());
  } catch (const MemoryError &error) {
    failed(kExitOutOfMemory, error.what());
  } catch (const std::bad_alloc &) {
    failed(kExitOutOfMemory, "out of memory");
  } catch (const WriteError &error) {
    failed(kExitCannotWrite, error.what());
  } catch (const std::exception &error) {
    failed(1, error.what());
  }
  const auto all = ranks.gather(outcome(code, text));
  int first_failed = -1;
  for (int r = 0; r < static_cast<int>(all.size()) && first_failed < 0; ++r)
    if (ByteReader(all[static_cast<std::size_t>(r)]).get<int>() != kExitDone) first_failed = r;
  broadcast_value(ranks, first_failed);
  if (first_failed < 0) return;
  if (ranks.rank() != 0) throw StoppedByOthers{};
  if (own) std::rethrow_exception(own);
  ByteReader in(all[static_cast<std::size_t>(first_failed)]);
  const int its_code = in.get<int>();
  throw_as(its_code, fmt::format("rank {}: {}", first_failed, in.get_text()));
}

LoadedScene load_on_all(Ranks &ranks, bool shared_files, const std::function<LoadedScene()> &load) {
  LoadedScene loaded;
  agree(ranks, [&] {
    if (ranks.rank() == 0 || shared_files) loaded = load();
  });
  if (ranks.size() == 1 || shared_files) return loaded;

  SceneDescription &d = loaded.description;
  broadcast_text(ranks, d.file);
  broadcast_value(ranks, d.camera);
  broadcast_value(ranks, d.film);
  broadcast_value(ranks, d.sampler);
  broadcast_value(ranks, d.integrator);
  std::vector<std::uint64_t> sizes;
  const auto ignore = [](auto &) {};
  visit_scene(loaded.scene, [&](auto &array) { sizes.push_back(array.size()); }, ignore);
  ranks.broadcast(std::as_writable_bytes(std::span(sizes)));
  agree(ranks, [&] {
    std::size_t i = 0;
    visit_scene(loaded.scene, [&](auto &array) { array.resize(sizes[i++]); }, ignore);
  });
  visit_scene(
      loaded.scene,
      [&](auto &array) { ranks.broadcast(std::as_writable_bytes(std::span(array))); },
      [&](auto &value) { broadcast_value(ranks, value); });
  return loaded;
}

std::string common_isa(Ranks &ranks, const std::string &wanted) {
  std::string isa;
  agree(ranks, [&] { isa = resolve_isa(wanted); });
  const std::vector<std::string> known = known_isas();
  const auto at = std::find(known.begin(), known.end(), isa) - known.begin();
  const std::vector<int> all = share_numbers(ranks, static_cast<int>(at));
  return known[static_cast<std::size_t>(*std::min_element(all.begin(), all.end()))];
}

void check_same(Ranks &ranks, const std::string &text, const std::string &what) {
  std::string first = text;
  if (ranks.size() > 1) broadcast_text(ranks, first);
  agree(ranks, [&] {
    if (first != text)
      throw InputError(fmt::format("{} differs from rank 0's: {} instead of {}", what, text, first));
  });
}

std::vector<int> share_numbers(Ranks &ranks, int own) {
  const auto each = ranks.gather(std::as_bytes(std::span(&own, 1)));
  std::vector<int> numbers(static_cast<std::size_t>(ranks.size()));
  for (std::size_t r = 0; r < each.size(); ++r)
    std::memcpy(&numbers[r], each[r].data(), sizeof(int));
  ranks.broadcast(std::as_writable_bytes(std::span(numbers)));
  return numbers;
}

}  // namespace phalanx
