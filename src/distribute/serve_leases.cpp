// A rank that is not 0.
#include "../core/timer.h"
#include "lease_render.h"
#include "messages.h"

namespace phalanx {
namespace {

constexpr double kPollSeconds = 2e-3;
constexpr double kAliveSeconds = 0.5;
constexpr double kGiveUpSeconds = 30;  // of silence

std::vector<std::byte> bytes_of_text(const char *text) {
  const auto bytes = std::as_bytes(std::span(text, std::char_traits<char>::length(text)));
  return {bytes.begin(), bytes.end()};
}

}  // namespace

bool serve_leases(Ranks &ranks, const Scene &scene, const Accel &accel, const Plan &plan,
                  const RenderOptions &options) {
  TileRenderer tiles(scene, accel, plan, options);
  Crew crew(tiles, plan);
  RankStats figures;
  figures.rank = ranks.rank();
  figures.threads = plan.threads;
  const auto refresh = [&] {
    figures.busy_s = crew.busy_s();
    figures.cpu_s = crew.cpu_s();
    figures.waiting_s = crew.waiting_s();
    figures.communicating_s = ranks.seconds();
  };
  double last_heard = wall_seconds(), last_said = 0;
  const auto say = [&](MessageTag tag, std::vector<std::byte> bytes) {
    ranks.send(0, tag, std::move(bytes));
    last_said = wall_seconds();
  };

  for (bool has_ended = false, has_failed = false; !has_ended;) {
    while (const std::optional<Message> message = ranks.receive()) {
      last_heard = wall_seconds();
      if (message->tag == kTagEnd) has_ended = true;
      if (message->tag == kTagWork && !has_failed) crew.give(read_work(message->bytes));
    }
    try {
      for (Finished &finished : crew.take(has_failed ? 0 : kPollSeconds)) {
        ++figures.tiles;
        figures.rays += finished.rays.total();
        refresh();
        say(kTagFinished, bytes_of(FinishedMessage{std::move(finished), figures}));
      }
    } catch (const std::exception &error) {  // others can go on without this rank
      has_failed = true;
      say(kTagFailed, bytes_of_text(error.what()));
    }
    const double now = wall_seconds();
    if (now - last_said > kAliveSeconds) say(kTagAlive, {});
    if (now - last_heard > kGiveUpSeconds) return false;
  }
  crew.stop();
  refresh();
  RunStats stats;
  tiles.collect(stats);
  say(kTagFarewell, bytes_of(Farewell{figures, stats.wave_bytes_per_thread, stats.stages}));
  return true;
}

}  // namespace phalanx
