#include "messages.h"

#include "../core/bytes.h"

namespace phalanx {
namespace {

std::vector<std::byte> to_vector(std::span<const std::byte> bytes) {
  return {bytes.begin(), bytes.end()};
}

}  // namespace

std::vector<std::byte> bytes_of(const Work &work) {
  ByteWriter out;
  out.put(work.lease);
  out.put_bytes(work.film);
  return out.take();
}

Work read_work(std::span<const std::byte> bytes) {
  ByteReader in(bytes);
  Work work;
  work.lease = in.get<Lease>();
  work.film = to_vector(in.rest());
  return work;
}

std::vector<std::byte> bytes_of(const FinishedMessage &message) {
  const Finished &f = message.finished;
  ByteWriter out;
  out.put(f.lease);
  out.put(f.rays);
  out.put(f.invalid);
  out.put(f.seconds);
  out.put(message.figures);
  out.put_bytes(f.film);
  return out.take();
}

FinishedMessage read_finished(std::span<const std::byte> bytes) {
  ByteReader in(bytes);
  FinishedMessage message;
  Finished &f = message.finished;
  f.lease = in.get<Lease>();
  f.rays = in.get<RayCounts>();
  f.invalid = in.get<InvalidSamples>();
  f.seconds = in.get<double>();
  message.figures = in.get<RankStats>();
  f.film = to_vector(in.rest());
  return message;
}

std::vector<std::byte> bytes_of(const Farewell &farewell) {
  ByteWriter out;
  out.put(farewell.figures);
  out.put(farewell.wave_bytes_per_thread);
  out.put(static_cast<std::uint32_t>(farewell.stages.size()));
  for (const StageStats &s : farewell.stages) {
    out.put_text(s.name);
    out.put(s.seconds);
    out.put(s.items);
    out.put(s.lanes_active);
    out.put(s.lanes_total);
  }
  return out.take();
}

Farewell read_farewell(std::span<const std::byte> bytes) {
  ByteReader in(bytes);
  Farewell farewell;
  farewell.figures = in.get<RankStats>();
  farewell.wave_bytes_per_thread = in.get<std::int64_t>();
  const auto count = in.get<std::uint32_t>();
  for (std::uint32_t i = 0; i < count; ++i) {
    StageStats s;
    s.name = in.get_text();
    s.seconds = in.get<double>();
    s.items = in.get<std::int64_t>();
    s.lanes_active = in.get<std::int64_t>();
    s.lanes_total = in.get<std::int64_t>();
    farewell.stages.push_back(std::move(s));
  }
  return farewell;
}

}  // namespace phalanx
