#include "lease_book.h"

#include <algorithm>
#include <cmath>

namespace phalanx {

LeaseBook::LeaseBook(std::vector<BookTile> tiles, std::vector<int> threads, Terms terms)
    : tiles_(std::move(tiles)),
      sample_s_(tiles_.size(), 0.0),
      threads_(std::move(threads)),
      lost_(threads_.size(), false),
      terms_(terms),
      pools_(threads_.size() + 1),
      next_id_(terms.first_id) {
  for (const BookTile &t : tiles_) {
    area_ += area(t.rect);
    samples_done_ += area(t.rect) * t.samples;
  }
  num_done_ = tiles_.size();  // with a target of 0
}

void LeaseBook::set_target(int samples) {
  target_ = std::max(target_, samples);
  num_done_ = 0;
  for (Pool &pool : pools_) {
    pool.free.clear();
    pool.samples = 0;
  }
  std::vector<bool> is_leased(tiles_.size(), false);
  for (const auto &[id, o] : outstanding_) is_leased[static_cast<std::size_t>(o.tile)] = true;
  for (std::size_t t = 0; t < tiles_.size(); ++t) {
    if (tiles_[t].samples >= target_) ++num_done_;
    else if (!is_leased[t]) make_free(static_cast<std::int32_t>(t));
  }
}

LeaseBook::Pool &LeaseBook::pool_of(int owner) {
  const bool own = owner >= 0 && !lost_[static_cast<std::size_t>(owner)];
  return own ? pools_[static_cast<std::size_t>(owner)] : pools_.back();
}

/// Where `rank` finds work: its own tiles first.
const LeaseBook::Pool *LeaseBook::pool_for(int rank) const {
  const Pool &own = pools_[static_cast<std::size_t>(rank)];
  if (!own.free.empty()) return &own;
  return pools_.back().free.empty() ? nullptr : &pools_.back();
}

int LeaseBook::threads_of_pool(const Pool *pool, int rank) const {
  if (pool != &pools_.back()) return threads_[static_cast<std::size_t>(rank)];
  int sum = 0;
  for (std::size_t r = 0; r < threads_.size(); ++r) sum += lost_[r] ? 0 : threads_[r];
  return std::max(1, sum);
}

LeaseBook::Order LeaseBook::order_of(std::int32_t tile) const {
  const auto t = static_cast<std::size_t>(tile);
  return {tiles_[t].samples, -sample_s_[t], tile};
}

void LeaseBook::make_free(std::int32_t tile) {
  const BookTile &t = tiles_[static_cast<std::size_t>(tile)];
  Pool &pool = pool_of(t.owner);
  pool.free.insert(order_of(tile));
  pool.samples += area(t.rect) * (target_ - t.samples);
}

void LeaseBook::take(std::int32_t tile) {
  const BookTile &t = tiles_[static_cast<std::size_t>(tile)];
  Pool &pool = pool_of(t.owner);
  pool.free.erase(order_of(tile));
  pool.samples = std::max(0.0, pool.samples - area(t.rect) * (target_ - t.samples));
}

/// A free tile becomes up to four.
void LeaseBook::split(std::int32_t tile) {
  take(tile);
  const BookTile whole = tiles_[static_cast<std::size_t>(tile)];
  const double sample_s = sample_s_[static_cast<std::size_t>(tile)];
  const Rect r = whole.rect;
  const int w = (r.width + 1) / 2, h = (r.height + 1) / 2;
  bool first = true;
  for (const Rect part : {Rect{r.x, r.y, w, h}, Rect{r.x + w, r.y, r.width - w, h},
                          Rect{r.x, r.y + h, w, r.height - h},
                          Rect{r.x + w, r.y + h, r.width - w, r.height - h}}) {
    if (part.width == 0 || part.height == 0) continue;
    std::int32_t at = tile;
    if (!first) {
      at = static_cast<std::int32_t>(tiles_.size());
      tiles_.push_back(whole);
      sample_s_.push_back(0);
    }
    first = false;
    tiles_[static_cast<std::size_t>(at)].rect = part;
    sample_s_[static_cast<std::size_t>(at)] = sample_s * area(part) / area(r);
    make_free(at);
  }
}

/// Seconds that a sample of a pixel takes on average.
double LeaseBook::pixel_sample_s() const {
  return timed_samples_ > 0 ? timed_s_ / timed_samples_ : 0;
}

double LeaseBook::cost_of_sample(std::int32_t tile) const {
  const auto t = static_cast<std::size_t>(tile);
  return sample_s_[t] > 0 ? sample_s_[t] : pixel_sample_s() * area(tiles_[t].rect);
}

/// The shortest lease that it is worth to talk about.
double LeaseBook::shortest_s() const {
  return std::max(terms_.smallest_s, terms_.message_s * threads_of_pool(&pools_.back(), 0));
}

std::optional<Lease> LeaseBook::grant(int rank, double now) {
  for (;;) {
    const Pool *const pool = pool_for(rank);
    if (pool == nullptr) return grant_again(rank, now);
    const std::int32_t tile = pool->free.begin()->tile;
    const BookTile &t = tiles_[static_cast<std::size_t>(tile)];
    const int threads = threads_of_pool(pool, rank);
    const double left_s = pool->samples * pixel_sample_s() / threads;  // of this pool
    const double sample_s = cost_of_sample(tile);
    const int missing = target_ - t.samples;
    const double least_s = sample_s * std::min(missing, terms_.samples);

    const bool can_split = std::max(t.rect.width, t.rect.height) > terms_.smallest_side;
    if (can_split && threads > 1 && least_s > std::max(shortest_s(), 0.25 * left_s)) {
      split(tile);
      continue;
    }
    const double wanted_s =
        std::max(shortest_s(), std::min(terms_.longest_s, 0.25 * left_s));
    const bool is_known = sample_s_[static_cast<std::size_t>(tile)] > 0;  // it may be far from the mean
    const double units = is_known ? wanted_s / (sample_s * terms_.samples) : 1;
    // While there is much to do, at most as many as it has: the picture gets finer everywhere alike.
    const double most = left_s < terms_.even_s
                            ? 1e6
                            : std::max(1.0, std::floor(static_cast<double>(t.samples) / terms_.samples));
    const int samples = static_cast<int>(std::clamp(std::floor(units), 1.0, most)) * terms_.samples;

    take(tile);
    const Lease lease = {next_id_++, t.rect, t.samples, t.samples + std::min(samples, missing)};
    outstanding_[lease.id] = {lease, tile, {{rank, now}}};
    outstanding_samples_ += area(t.rect) * (lease.end_sample - lease.first_sample);
    return lease;
  }
}

/// What others have had for long may have got lost with them, or they are slow.
std::optional<Lease> LeaseBook::grant_again(int rank, double now) {
  const Outstanding *oldest = nullptr;
  for (const auto &[id, o] : outstanding_) {
    if (o.holders.size() > 1 || o.holders.empty() || o.holders[0].rank == rank) continue;
    const double expected_s =
        cost_of_sample(o.tile) * (o.lease.end_sample - o.lease.first_sample);
    if (now - o.holders[0].since < std::max(terms_.overdue_s, 4 * expected_s)) continue;
    if (oldest == nullptr || o.holders[0].since < oldest->holders[0].since) oldest = &o;
  }
  if (oldest == nullptr) return std::nullopt;
  outstanding_[oldest->lease.id].holders.push_back({rank, now});
  return oldest->lease;
}

bool LeaseBook::commit(std::int64_t id, double seconds) {
  const auto found = outstanding_.find(id);
  if (found == outstanding_.end()) return false;
  const std::int32_t tile = found->second.tile;
  const Lease lease = found->second.lease;
  outstanding_.erase(found);
  BookTile &t = tiles_[static_cast<std::size_t>(tile)];
  const int samples = lease.end_sample - lease.first_sample;
  outstanding_samples_ -= area(t.rect) * samples;
  samples_done_ += area(t.rect) * samples;
  timed_samples_ += area(t.rect) * samples;
  timed_s_ += seconds;
  sample_s_[static_cast<std::size_t>(tile)] = seconds / samples;
  t.samples = lease.end_sample;
  if (t.samples >= target_) ++num_done_;
  else make_free(tile);
  return true;
}

void LeaseBook::lose(int rank) {
  if (is_lost(rank)) return;
  lost_[static_cast<std::size_t>(rank)] = true;
  Pool &own = pools_[static_cast<std::size_t>(rank)];
  pools_.back().free.merge(own.free);
  pools_.back().samples += own.samples;
  own.samples = 0;
  std::vector<std::int64_t> orphans;
  for (auto &[id, o] : outstanding_) {
    std::erase_if(o.holders, [&](const Holder &h) { return h.rank == rank; });
    if (o.holders.empty()) orphans.push_back(id);
  }
  for (const std::int64_t id : orphans) {
    const Outstanding o = outstanding_[id];
    outstanding_.erase(id);
    outstanding_samples_ -= area(o.lease.rect) * (o.lease.end_sample - o.lease.first_sample);
    make_free(o.tile);
  }
}

void LeaseBook::find(int rank) {
  lost_[static_cast<std::size_t>(rank)] = false;
  for (BookTile &t : tiles_)
    if (t.owner == rank) t.owner = -1;  // they lie in the pool for all
}

double LeaseBook::seconds_left() const {
  double samples = outstanding_samples_;
  for (const Pool &pool : pools_) samples += pool.samples;
  return samples * pixel_sample_s() / threads_of_pool(&pools_.back(), 0);
}

bool LeaseBook::is_plentiful(int rank) const {
  const Pool *const pool = pool_for(rank);
  return pool != nullptr && pool->samples * pixel_sample_s() / threads_of_pool(pool, rank) > 0.1;
}

bool LeaseBook::has_free() const {
  return std::any_of(pools_.begin(), pools_.end(), [](const Pool &p) { return !p.free.empty(); });
}

int LeaseBook::fewest_samples() const {
  int fewest = target_;
  for (const BookTile &t : tiles_) fewest = std::min(fewest, t.samples);
  return fewest;
}

double LeaseBook::samples_wanted() const { return area_ * target_; }

}  // namespace phalanx
