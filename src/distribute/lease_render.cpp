// Rank 0: one thread that talks, leases and keeps the film, beside those that render.
#include "lease_render.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <future>

#include "../core/error.h"
#include "../core/timer.h"
#include "checkpoint.h"
#include "messages.h"
#include "screen_box.h"

namespace phalanx {
namespace {

constexpr double kPollSeconds = 2e-3;     // between looks at messages; own leases wake it
constexpr double kChoresSeconds = 0.05;   // between looks at signals, silence, checkpoints
constexpr double kProgressSeconds = 0.25;
constexpr double kAliveSeconds = 1;       // between words to other ranks
constexpr double kSilenceSeconds = 3;     // after which a rank counts as lost
constexpr int kCostCell = 16;             // pixels
constexpr int kMostPilotSamples = 4;
constexpr std::int64_t kFirstIdAfterPilot = std::int64_t{1} << 40;

class Coordinator {
 public:
  Coordinator(Ranks &ranks, const Scene &scene, const Accel &accel, const Plan &plan,
              const RenderOptions &options, const LeaseOptions &lease_options,
              const LeaseHooks &hooks);
  ~Coordinator() { end_others(); }
  LeaseResult run();

 private:
  struct Peer {
    RankStats figures;
    int in_flight = 0;       // leases it has
    double last_heard = 0;
    bool failed = false;     // said so; silent ones may come back
    bool said_farewell = false;
  };

  void resume();
  void pilot();
  std::vector<BookTile> partition() const;
  void render_until_done(LeaseBook &book, bool may_grow);
  void receive_all(LeaseBook &book);
  void commit(LeaseBook &book, int from, const Finished &finished);
  void lease_out(LeaseBook &book);
  void hand(int rank, const Lease &lease);
  void grow_target(LeaseBook &book);
  void do_chores(LeaseBook &book);
  void look_for_silence(LeaseBook &book, double now);
  void lose(LeaseBook &book, int rank, const std::string &why);
  void start_checkpoint(const std::vector<BookTile> &tiles);
  void finish_checkpoint(bool wait);
  void warn(const std::string &text);
  void end_others();
  void hear_farewells(double at_most_s);
  RunStats stats_so_far(const std::vector<BookTile> &tiles) const;
  Image map() const;

  Ranks &ranks_;
  const Scene &scene_;
  const Plan &plan_;
  const RenderOptions &options_;
  const LeaseOptions &lease_options_;
  const LeaseHooks &hooks_;
  TileRenderer renderer_;
  Film film_;
  std::vector<BookTile> tiles_;       // between books
  std::vector<Peer> peers_;           // by rank; 0 is this one
  Crew crew_;
  PictureFacts facts_;
  Tally tally_;
  CostMap cost_, samples_;            // seconds, and samples of pixels, so far
  std::vector<float> rank_map_;
  RunStats stats_;
  std::vector<StageStats> other_stages_;
  const double start_;
  double earlier_s_ = 0;              // of rendering, before the checkpoint
  int resumed_spp_ = 0, target_ = 0;
  double last_chores_ = 0, last_progress_ = 0, last_alive_ = 0, last_checkpoint_ = 0;
  std::future<std::string> checkpoint_;  // being written: what went wrong, or ""
  std::string checkpoint_failure_;
  bool stop_ = false, out_of_time_ = false, others_ended_ = false;
};

Coordinator::Coordinator(Ranks &ranks, const Scene &scene, const Accel &accel, const Plan &plan,
                         const RenderOptions &options, const LeaseOptions &lease_options,
                         const LeaseHooks &hooks)
    : ranks_(ranks),
      scene_(scene),
      plan_(plan),
      options_(options),
      lease_options_(lease_options),
      hooks_(hooks),
      renderer_(scene, accel, plan, options),
      film_(plan.crop, plan.aovs),
      peers_(static_cast<std::size_t>(ranks.size())),
      crew_(renderer_, plan),
      cost_(plan.crop, kCostCell),
      samples_(plan.crop, kCostCell),
      rank_map_(static_cast<std::size_t>(film_.num_pixels()), 0.0f),
      start_(wall_seconds()) {
  for (int r = 0; r < ranks.size(); ++r) {
    Peer &peer = peers_[static_cast<std::size_t>(r)];
    peer.figures.rank = r;
    peer.figures.threads = lease_options.threads[static_cast<std::size_t>(r)];
    peer.last_heard = start_;
  }
  last_checkpoint_ = last_progress_ = start_;
  for (const Rect &r : tiles_of(plan.crop, plan.tile_size)) tiles_.push_back({r, -1, 0});
  if (!lease_options.checkpoint.empty())
    facts_ = picture_facts(plan, options, lease_options.scene_fingerprint);
}

void Coordinator::warn(const std::string &text) {
  stats_.warnings.push_back(text);
  if (hooks_.warn) hooks_.warn(text);
}

void Coordinator::resume() {
  std::optional<Checkpoint> found =
      load_checkpoint(lease_options_.checkpoint, facts_, plan_.crop, plan_.aovs);
  if (!found) {
    warn(lease_options_.checkpoint + ": there is no checkpoint yet; rendering from the beginning");
    return;
  }
  if (!found->warning.empty()) warn(found->warning);
  film_ = std::move(found->film);
  tally_ = found->tally;
  earlier_s_ = found->tally.seconds;
  tiles_.clear();
  for (const BookTile &tile : found->tiles)
    for (const Rect &r : tiles_of(tile.rect, plan_.tile_size))
      tiles_.push_back({r, -1, tile.samples});
  resumed_spp_ = plan_.spp;
  for (const BookTile &tile : tiles_) resumed_spp_ = std::min(resumed_spp_, tile.samples);
}

/// The first few samples of every pixel, leased to whoever is free, tell what parts of the picture cost.
void Coordinator::pilot() {
  int most = 0;
  std::vector<BookTile> small;
  for (const BookTile &tile : tiles_) {
    most = std::max(most, tile.samples);
    for (const Rect &r : tiles_of(tile.rect, kCostCell)) small.push_back({r, -1, tile.samples});
  }
  const int samples = std::clamp(plan_.spp / 16, 1, kMostPilotSamples);
  LeaseBook book(std::move(small), lease_options_.threads, {});
  book.set_target(std::min(plan_.spp, most + samples));
  render_until_done(book, false);
  tiles_ = book.tiles();
}

/// Cuts what is to be rendered along the regions of a static strategy.
std::vector<BookTile> Coordinator::partition() const {
  const std::vector<int> &shares = lease_options_.threads;
  std::vector<Rect> regions;
  switch (lease_options_.balance) {
    case Balance::kDynamic: return tiles_;
    case Balance::kRows: regions = split_rows(plan_.crop, shares); break;
    case Balance::kColumns: regions = split_columns(plan_.crop, shares); break;
    case Balance::kGrid: regions = split_grid(plan_.crop, shares); break;
    case Balance::kBbox:
      regions = split_bbox(plan_.crop, screen_box(scene_, plan_.frame), shares);
      break;
    case Balance::kCost: {
      CostMap a_sample = cost_;
      for (std::size_t i = 0; i < a_sample.seconds.size(); ++i)
        if (samples_.seconds[i] > 0) a_sample.seconds[i] /= samples_.seconds[i];
      // Cells at the edge are smaller: seconds of a sample of a pixel, times pixels.
      for (std::size_t i = 0; i < a_sample.seconds.size(); ++i) {
        const int x = static_cast<int>(i) % a_sample.columns() * a_sample.cell;
        const int y = static_cast<int>(i) / a_sample.columns() * a_sample.cell;
        a_sample.seconds[i] *= std::min(a_sample.cell, plan_.crop.width - x) *
                               static_cast<double>(std::min(a_sample.cell, plan_.crop.height - y));
      }
      regions = split_cost(a_sample, shares);
      break;
    }
  }
  // Tiles of all samples alike are cut anew; others, from a checkpoint, are cut as they are.
  const bool alike = std::all_of(tiles_.begin(), tiles_.end(), [&](const BookTile &t) {
    return t.samples == tiles_.front().samples;
  });
  std::vector<BookTile> parts;
  for (std::size_t rank = 0; rank < regions.size(); ++rank) {
    if (alike) {
      for (const Rect &r : tiles_of(regions[rank], plan_.tile_size))
        parts.push_back({r, static_cast<int>(rank), tiles_.front().samples});
      continue;
    }
    for (const BookTile &tile : tiles_) {
      const Rect r = intersection(regions[rank], tile.rect);
      if (r.width > 0 && r.height > 0)
        parts.push_back({r, static_cast<int>(rank), tile.samples});
    }
  }
  return parts;
}

void Coordinator::commit(LeaseBook &book, int from, const Finished &finished) {
  Peer &peer = peers_[static_cast<std::size_t>(from)];
  peer.in_flight = std::max(0, peer.in_flight - 1);
  if (!book.commit(finished.lease.id, finished.seconds)) return;  // somebody was faster
  const Lease &lease = finished.lease;
  film_.set_region(lease.rect, finished.film);
  tally_.invalid.merge(finished.invalid);
  tally_.rays.camera += finished.rays.camera;
  tally_.rays.bounce += finished.rays.bounce;
  tally_.rays.shadow += finished.rays.shadow;
  const int samples = lease.end_sample - lease.first_sample;
  const double pixels = static_cast<double>(lease.rect.width) * lease.rect.height;
  cost_.add(lease.rect, finished.seconds);
  samples_.add(lease.rect, samples * pixels);
  for (int y = 0; y < lease.rect.height; ++y)
    std::fill_n(rank_map_.begin() + (lease.rect.y - plan_.crop.y + y) * std::int64_t{plan_.crop.width} +
                    (lease.rect.x - plan_.crop.x),
                lease.rect.width, static_cast<float>(from));
}

void Coordinator::hand(int rank, const Lease &lease) {
  Work work{lease, {}};
  if (lease.first_sample > 0) work.film = film_.region_bytes(lease.rect);
  ++peers_[static_cast<std::size_t>(rank)].in_flight;
  if (rank == 0)
    crew_.give(std::move(work));
  else
    ranks_.send(rank, kTagWork, bytes_of(work));
}

void Coordinator::lease_out(LeaseBook &book) {
  const double now = wall_seconds();
  for (bool any = true; any;) {  // one each in turn, so that the last tiles are shared
    any = false;
    for (int r = ranks_.size() - 1; r >= 0; --r) {
      Peer &peer = peers_[static_cast<std::size_t>(r)];
      if (peer.figures.lost) continue;
      const int wanted = peer.figures.threads + (book.is_plentiful(r) ? 1 : 0);
      if (peer.in_flight >= wanted) continue;
      const std::optional<Lease> lease = book.grant(r, now);
      if (!lease) continue;
      hand(r, *lease);
      any = true;
    }
  }
}

/// With a limit of time: one more pass if it will fit, like the average of those so far.
void Coordinator::grow_target(LeaseBook &book) {
  if (target_ >= plan_.spp || out_of_time_ || book.has_free()) return;
  const double elapsed = wall_seconds() - start_;
  const int rendered = target_ - resumed_spp_;
  const double finish = elapsed + book.seconds_left();
  const double pass_s = finish / std::max(1, rendered) * plan_.samples_per_pass;
  if (finish + pass_s > plan_.time_limit_s) {
    out_of_time_ = true;
    return;
  }
  target_ = std::min(plan_.spp, target_ + plan_.samples_per_pass);
  book.set_target(target_);
}

void Coordinator::receive_all(LeaseBook &book) {
  while (const std::optional<Message> message = ranks_.receive()) {
    Peer &peer = peers_[static_cast<std::size_t>(message->from)];
    peer.last_heard = wall_seconds();
    if (peer.figures.lost && !peer.failed) {
      peer.figures.lost = false;
      peer.in_flight = 0;
      book.find(message->from);
      warn(fmt::format("rank {} answers again", message->from));
    }
    if (message->tag == kTagFinished) {
      const FinishedMessage finished = read_finished(message->bytes);
      const bool lost = peer.figures.lost;
      peer.figures = finished.figures;
      peer.figures.lost = lost;
      commit(book, message->from, finished.finished);
    } else if (message->tag == kTagFailed) {
      peer.failed = true;
      lose(book, message->from,
           "failed: " + std::string(reinterpret_cast<const char *>(message->bytes.data()),
                                    message->bytes.size()));
    }
  }
}

void Coordinator::lose(LeaseBook &book, int rank, const std::string &why) {
  Peer &peer = peers_[static_cast<std::size_t>(rank)];
  if (peer.figures.lost) return;
  peer.figures.lost = true;
  peer.in_flight = 0;
  book.lose(rank);
  ranks_.give_up(rank);
  warn(fmt::format("rank {} {}; its tiles go to others", rank, why));
}

void Coordinator::look_for_silence(LeaseBook &book, double now) {
  for (int r = 1; r < ranks_.size(); ++r)
    if (now - peers_[static_cast<std::size_t>(r)].last_heard > kSilenceSeconds)
      lose(book, r, "does not answer");
  if (now - last_alive_ > kAliveSeconds) {
    last_alive_ = now;
    for (int r = 1; r < ranks_.size(); ++r)
      if (!peers_[static_cast<std::size_t>(r)].figures.lost) ranks_.send(r, kTagAlive, {});
  }
}

/// The film is copied now and written by another thread.
void Coordinator::start_checkpoint(const std::vector<BookTile> &tiles) {
  Tally tally = tally_;
  tally.seconds = earlier_s_ + wall_seconds() - start_;
  std::string bytes = checkpoint_bytes(facts_, film_, tiles, tally);
  checkpoint_ = std::async(std::launch::async, [this, bytes = std::move(bytes)]() -> std::string {
    try {
      write_checkpoint(lease_options_.checkpoint, bytes);
      return "";
    } catch (const std::exception &error) {
      return error.what();
    }
  });
  last_checkpoint_ = wall_seconds();
}

void Coordinator::finish_checkpoint(bool wait) {
  if (!checkpoint_.valid()) return;
  if (!wait && checkpoint_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  checkpoint_failure_ = checkpoint_.get();
  if (!checkpoint_failure_.empty()) warn(checkpoint_failure_);
}

void Coordinator::do_chores(LeaseBook &book) {
  const double now = wall_seconds();
  if (now - last_chores_ < kChoresSeconds) return;
  last_chores_ = now;
  if (hooks_.progress) {
    // Signals are looked for at every call; the line is drawn less often.
    Progress p;
    p.spp_done = book.fewest_samples();
    p.spp_total = plan_.spp < kNoSampleLimit ? plan_.spp : 0;
    p.fraction = book.samples_done() /
                 (static_cast<double>(film_.num_pixels()) * std::max(1, plan_.spp));
    p.elapsed_s = now - start_;
    if (plan_.time_limit_s > 0)
      p.fraction = std::min(1.0, std::max(p.fraction, p.elapsed_s / plan_.time_limit_s));
    p.rays = tally_.rays.total();
    p.between_passes = now - last_progress_ > kProgressSeconds;
    if (p.between_passes) last_progress_ = now;
    if (!hooks_.progress(p, film_)) stop_ = true;
  }
  if (ranks_.size() > 1) look_for_silence(book, now);
  if (hooks_.wants_snapshot && hooks_.wants_snapshot())
    hooks_.snapshot(film_, stats_so_far(book.tiles()));
  finish_checkpoint(false);
  if (!lease_options_.checkpoint.empty() && !checkpoint_.valid() && !stop_ &&
      now - last_checkpoint_ >= lease_options_.checkpoint_every_s)
    start_checkpoint(book.tiles());
}

void Coordinator::render_until_done(LeaseBook &book, bool may_grow) {
  for (int r = 0; r < ranks_.size(); ++r)
    if (peers_[static_cast<std::size_t>(r)].figures.lost) book.lose(r);
  while (!stop_) {
    receive_all(book);
    if (may_grow) grow_target(book);
    if (book.done()) return;
    lease_out(book);
    for (const Finished &finished : crew_.take(ranks_.size() > 1 ? kPollSeconds : kChoresSeconds)) {
      RankStats &own = peers_[0].figures;
      ++own.tiles;
      own.rays += finished.rays.total();
      commit(book, 0, finished);
    }
    do_chores(book);
  }
}

void Coordinator::end_others() {
  if (others_ended_) return;
  others_ended_ = true;
  for (int r = 1; r < ranks_.size(); ++r) ranks_.send(r, kTagEnd, {});
}

void Coordinator::hear_farewells(double at_most_s) {
  const double start = wall_seconds();
  const auto all_said = [&] {
    return std::all_of(peers_.begin() + 1, peers_.end(),
                       [](const Peer &p) { return p.said_farewell || p.figures.lost; });
  };
  while (!all_said() && wall_seconds() - start < at_most_s) {
    const std::optional<Message> message = ranks_.receive();
    if (!message) {
      crew_.take(kPollSeconds);  // nothing comes any more: a pause
      continue;
    }
    if (message->tag != kTagFarewell) continue;
    Peer &peer = peers_[static_cast<std::size_t>(message->from)];
    const Farewell farewell = read_farewell(message->bytes);
    const bool lost = peer.figures.lost;
    peer.figures = farewell.figures;
    peer.figures.lost = lost;
    peer.said_farewell = true;
    stats_.wave_bytes_per_thread =
        std::max(stats_.wave_bytes_per_thread, farewell.wave_bytes_per_thread);
    other_stages_.insert(other_stages_.end(), farewell.stages.begin(), farewell.stages.end());
  }
  if (stop_) return;  // a signal: there was no time to wait
  for (Peer &peer : peers_) {
    if (peer.figures.rank == 0 || peer.said_farewell || peer.figures.lost) continue;
    peer.figures.lost = true;
    ranks_.give_up(peer.figures.rank);
    warn(fmt::format("rank {} does not answer; its tiles went to others", peer.figures.rank));
  }
}

RunStats Coordinator::stats_so_far(const std::vector<BookTile> &tiles) const {
  RunStats stats = stats_;
  stats.mode = mode_name(options_.mode);
  stats.isa = options_.isa;
  stats.threads = plan_.threads;
  stats.ranks = ranks_.size();
  stats.balance = balance_name(lease_options_.balance);
  stats.spp = plan_.spp;  // at most
  for (const BookTile &tile : tiles) stats.spp = std::min(stats.spp, tile.samples);
  stats.samples_per_pixel = stats.spp;
  stats.resumed_spp = resumed_spp_;
  stats.wall_s = wall_seconds() - start_;
  stats.rays = tally_.rays;
  stats.invalid = tally_.invalid;
  add_clamp_figures(stats, film_, plan_.clamp);
  for (const Peer &peer : peers_) stats.per_rank.push_back(peer.figures);
  stats.per_rank[0].busy_s = crew_.busy_s();
  stats.per_rank[0].cpu_s = crew_.cpu_s();
  stats.per_rank[0].waiting_s = crew_.waiting_s();
  stats.per_rank[0].communicating_s = ranks_.seconds();
  return stats;
}

Image Coordinator::map() const {
  const Rect c = plan_.crop;
  Image image = make_image(c.width, c.height);
  image.x = c.x;
  image.y = c.y;
  image.full_width = plan_.frame.width;
  image.full_height = plan_.frame.height;
  add_channel(image, "rank") = rank_map_;
  std::vector<float> &cost = add_channel(image, "cost");
  for (int y = 0; y < c.height; ++y)
    for (int x = 0; x < c.width; ++x) {
      const auto cell = static_cast<std::size_t>(y / cost_.cell * cost_.columns() + x / cost_.cell);
      const double samples = samples_.seconds[cell];
      cost[static_cast<std::size_t>(y) * static_cast<std::size_t>(c.width) +
           static_cast<std::size_t>(x)] =
          samples > 0 ? static_cast<float>(cost_.seconds[cell] / samples) : 0.0f;
    }
  return image;
}

LeaseResult Coordinator::run() {
  const double cpu_start = cpu_seconds();
  if (lease_options_.resume) resume();
  const bool has_time_limit = plan_.time_limit_s > 0;
  if (lease_options_.balance == Balance::kCost && ranks_.size() > 1) pilot();
  LeaseBook::Terms terms;
  terms.samples = plan_.samples_per_pass;
  terms.first_id = kFirstIdAfterPilot;
  LeaseBook book(partition(), lease_options_.threads, terms);
  int most = 0;
  for (const BookTile &tile : book.tiles()) most = std::max(most, tile.samples);
  target_ = has_time_limit ? std::min(plan_.spp, std::max(most, plan_.samples_per_pass))
                           : plan_.spp;
  book.set_target(target_);
  if (!stop_) render_until_done(book, has_time_limit);

  end_others();
  finish_checkpoint(true);
  if (!lease_options_.checkpoint.empty()) {
    start_checkpoint(book.tiles());
    finish_checkpoint(true);
  }
  const double wall_s = wall_seconds() - start_;
  hear_farewells(stop_ ? 0.2 : kSilenceSeconds);
  crew_.stop();

  LeaseResult result{std::move(film_), {}, map(), checkpoint_failure_};
  RunStats stages;
  renderer_.collect(stages);
  stats_ = stats_so_far(book.tiles());
  stats_.wall_s = wall_s;
  stats_.cpu_s = cpu_seconds() - cpu_start;
  stats_.stopped_by = stop_ ? "signal" : stats_.spp < plan_.spp ? "time" : "spp";
  stats_.wave_bytes_per_thread =
      std::max(stats_.wave_bytes_per_thread, stages.wave_bytes_per_thread);
  stats_.stages = stages.stages;
  for (const StageStats &other : other_stages_) {
    auto own = std::find_if(stats_.stages.begin(), stats_.stages.end(),
                            [&](const StageStats &s) { return s.name == other.name; });
    if (own == stats_.stages.end()) own = stats_.stages.insert(own, {other.name, 0, 0, 0, 0});
    own->seconds += other.seconds;
    own->items += other.items;
    own->lanes_active += other.lanes_active;
    own->lanes_total += other.lanes_total;
  }
  result.stats = std::move(stats_);
  return result;
}

}  // namespace

LeaseResult render_leases(Ranks &ranks, const Scene &scene, const Accel &accel, const Plan &plan,
                          const RenderOptions &options, const LeaseOptions &lease_options,
                          const LeaseHooks &hooks) {
  return Coordinator(ranks, scene, accel, plan, options, lease_options, hooks).run();
}

int lease_tile_size(const Plan &plan, const std::vector<int> &threads) {
  int total = 0, size = plan.tile_size;
  for (const int n : threads) total += n;
  const auto count = [&] {
    return std::int64_t{(plan.crop.width + size - 1) / size} * ((plan.crop.height + size - 1) / size);
  };
  while (total > 1 && size > 8 && count() < 4 * std::int64_t{total}) size /= 2;
  return size;
}

}  // namespace phalanx
