// What ranks would do on machines we do not have: a discrete-event simulation of rendering by leases.
//
// It plays the real book of leases and the real partitions. Time comes from a measured map of costs
// (--balance-map of `phalanx render`) and from three figures of the network. Rank 0 handles one message at a
// time and renders, too, as the program does.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <deque>
#include <queue>
#include <string>
#include <vector>

#include "core/error.h"
#include "distribute/lease_book.h"
#include "distribute/partition.h"
#include "film/film.h"
#include "output/image_file.h"

namespace phalanx {
namespace {

struct Network {
  double latency_s = 20e-6;        // of a message, one way
  double bytes_per_s = 1.2e9;      // of each link; rank 0's is shared by all
  double handling_s = 3e-6;        // of rank 0 for each message, copying apart
  double copy_bytes_per_s = 4e9;   // of rank 0: message, checksum, film
  double poll_s = 1e-3;            // until a waiting process looks: half of its period
};

struct Setting {
  CostMap cost;                    // seconds of one sample of every pixel, cell by cell
  int spp = 64, samples_per_pass = 16, tile_size = 32, threads = 1;
  double lease_overhead_s = 0;     // of a renderer for each lease
  Network network;
};

struct Outcome {
  double seconds = 0, busy_max = 0, busy_mean = 0;
  std::int64_t messages = 0;
};

struct Event {
  double time;
  enum Kind { kArrivesAtRank, kDone, kArrivesAtZero } kind;
  int rank;
  Lease lease;
  double work_s;
  bool operator>(const Event &o) const { return time > o.time; }
};

class Simulation {
 public:
  Simulation(const Setting &s, int ranks) : s_(s), ranks_(static_cast<std::size_t>(ranks)) {}

  /// Renders `tiles` up to `target` samples, from `start_s` on; returns when all is with rank 0.
  std::vector<BookTile> play(std::vector<BookTile> tiles, int target, double start_s) {
    LeaseBook::Terms terms;
    terms.samples = s_.samples_per_pass;
    terms.overdue_s = 1e9;  // nobody is lost here
    LeaseBook book(std::move(tiles), std::vector<int>(ranks_.size(), s_.threads), terms);
    book.set_target(target);
    now_ = zero_free_ = start_s;
    for (std::size_t r = 0; r < ranks_.size(); ++r) hungry_.push_back(static_cast<int>(r));
    lease_out(book);
    while (!events_.empty()) {
      const Event e = events_.top();
      events_.pop();
      now_ = e.time;
      Rank &rank = ranks_[static_cast<std::size_t>(e.rank)];
      switch (e.kind) {
        case Event::kArrivesAtRank:
          rank.queue.push_back(e.lease);
          start_work(e.rank);
          break;
        case Event::kDone: {
          --rank.working;
          const double sent = now_ + (e.rank == 0 ? 0 : transfer_s(e.lease) + s_.network.latency_s);
          events_.push({sent, Event::kArrivesAtZero, e.rank, e.lease, e.work_s});
          start_work(e.rank);
          break;
        }
        case Event::kArrivesAtZero: {
          // Looked for after half a period on average, unless rank 0 is at it anyway.
          const double seen = now_ > zero_free_ ? now_ + (e.rank == 0 ? 0 : s_.network.poll_s) : zero_free_;
          zero_free_ = seen + s_.network.handling_s + bytes(e.lease) / s_.network.copy_bytes_per_s;
          ++outcome_.messages;
          book.commit(e.lease.id, e.work_s);
          --rank.in_flight;
          hungry_.push_back(e.rank);
          lease_out(book);
          break;
        }
      }
    }
    outcome_.seconds = zero_free_;
    return book.tiles();
  }

  Outcome outcome() {
    outcome_.busy_max = outcome_.busy_mean = 0;
    for (const Rank &r : ranks_) {
      outcome_.busy_max = std::max(outcome_.busy_max, r.busy_s / s_.threads);
      outcome_.busy_mean += r.busy_s / s_.threads / static_cast<double>(ranks_.size());
    }
    return outcome_;
  }
  double now() const { return zero_free_; }

 private:
  struct Rank {
    std::deque<Lease> queue;
    int working = 0, in_flight = 0;
    double busy_s = 0;
  };

  double bytes(const Lease &l) const {
    return static_cast<double>(l.rect.width) * l.rect.height *
           static_cast<double>(Film::bytes_per_pixel(false));
  }
  double transfer_s(const Lease &l) const { return bytes(l) / s_.network.bytes_per_s; }
  double work_s(const Lease &l) const {
    return s_.cost.cost_of(l.rect) * (l.end_sample - l.first_sample) + s_.lease_overhead_s;
  }

  void start_work(int r) {
    Rank &rank = ranks_[static_cast<std::size_t>(r)];
    while (rank.working < s_.threads && !rank.queue.empty()) {
      const Lease lease = rank.queue.front();
      rank.queue.pop_front();
      ++rank.working;
      const double work = work_s(lease);
      rank.busy_s += work;
      events_.push({now_ + work, Event::kDone, r, lease, work});
    }
  }

  void lease_out(LeaseBook &book) {
    std::vector<int> still;
    std::sort(hungry_.begin(), hungry_.end(), std::greater<>());
    hungry_.erase(std::unique(hungry_.begin(), hungry_.end()), hungry_.end());
    for (bool any = true; any && !hungry_.empty();) {
      any = false;
      still.clear();
      for (const int r : hungry_) {
        Rank &rank = ranks_[static_cast<std::size_t>(r)];
        if (rank.in_flight >= s_.threads + (book.is_plentiful(r) ? 1 : 0)) continue;
        const auto lease = book.grant(r, now_);
        if (!lease) continue;
        ++rank.in_flight;
        double out = std::max(zero_free_, now_);
        if (lease->first_sample > 0) out += bytes(*lease) / s_.network.copy_bytes_per_s;
        zero_free_ = out;
        if (r > 0) {
          zero_free_ += s_.network.handling_s;
          const double film_s = lease->first_sample > 0 ? transfer_s(*lease) : 0;
          out = zero_free_ + s_.network.latency_s + film_s + s_.network.poll_s;
          ++outcome_.messages;
        }
        events_.push({out, Event::kArrivesAtRank, r, *lease, 0});
        still.push_back(r);
        any = true;
      }
      hungry_ = still;
    }
  }

  const Setting &s_;
  std::vector<Rank> ranks_;
  std::vector<int> hungry_;  // those that may take another lease
  std::priority_queue<Event, std::vector<Event>, std::greater<>> events_;
  double now_ = 0, zero_free_ = 0;
  Outcome outcome_;
};

std::vector<BookTile> tiles_for(const std::vector<Rect> &regions, int size, int samples) {
  std::vector<BookTile> tiles;
  for (std::size_t r = 0; r < regions.size(); ++r)
    for (const Rect &t : tiles_of(regions[r], size)) tiles.push_back({t, static_cast<int>(r), samples});
  return tiles;
}

Outcome simulate(const Setting &s, Balance balance, int ranks) {
  const Rect crop = s.cost.crop;
  const std::vector<int> shares(static_cast<std::size_t>(ranks), s.threads);
  Simulation simulation(s, ranks);
  std::vector<BookTile> free;
  for (const Rect &t : tiles_of(crop, s.tile_size)) free.push_back({t, -1, 0});
  switch (balance) {
    case Balance::kDynamic: simulation.play(free, s.spp, 0); break;
    case Balance::kRows:
      simulation.play(tiles_for(split_rows(crop, shares), s.tile_size, 0), s.spp, 0);
      break;
    case Balance::kColumns:
      simulation.play(tiles_for(split_columns(crop, shares), s.tile_size, 0), s.spp, 0);
      break;
    case Balance::kGrid:
      simulation.play(tiles_for(split_grid(crop, shares), s.tile_size, 0), s.spp, 0);
      break;
    case Balance::kBbox:  // the map does not know surfaces: the box is the whole picture, as indoors
      simulation.play(tiles_for(split_bbox(crop, crop, shares), s.tile_size, 0), s.spp, 0);
      break;
    case Balance::kCost: {
      const int pilot = ranks > 1 ? std::clamp(s.spp / 16, 1, 4) : 0;
      std::vector<BookTile> small;
      for (const Rect &t : tiles_of(crop, s.cost.cell)) small.push_back({t, -1, 0});
      if (pilot > 0) simulation.play(small, pilot, 0);
      simulation.play(tiles_for(split_cost(s.cost, shares), s.tile_size, pilot), s.spp, simulation.now());
      break;
    }
  }
  return simulation.outcome();
}

/// The map of a rendering, stretched to width x height pixels.
CostMap read_map(const std::string &path, int width, int height) {
  const Image image = read_image(path);
  const Channel *const cost = find_channel(image, "cost");
  if (cost == nullptr) throw InputError(path + ": there is no layer cost; --balance-map writes one");
  const int w = width > 0 ? width : image.width, h = height > 0 ? height : image.height;
  CostMap map({0, 0, w, h}, 16);
  for (int y = 0; y < map.rows(); ++y)
    for (int x = 0; x < map.columns(); ++x) {
      const Rect cell = intersection(map.crop, {x * 16, y * 16, 16, 16});
      double sum = 0;
      for (int v = cell.y; v < cell.y + cell.height; ++v)
        for (int u = cell.x; u < cell.x + cell.width; ++u) {
          const auto from_x = static_cast<std::size_t>(std::int64_t{u} * image.width / w);
          const auto from_y = static_cast<std::size_t>(std::int64_t{v} * image.height / h);
          sum += static_cast<double>(cost->values[from_y * static_cast<std::size_t>(image.width) + from_x]);
        }
      map.seconds[static_cast<std::size_t>(y * map.columns() + x)] = sum;
    }
  return map;
}

std::vector<int> numbers(const std::string &list) {
  std::vector<int> values;
  for (std::size_t at = 0; at < list.size();) {
    const std::size_t end = std::min(list.find(',', at), list.size());
    values.push_back(std::max(1, std::atoi(list.substr(at, end - at).c_str())));
    at = end + 1;
  }
  return values;
}

const char kUsage[] =
    "usage: phalanx_scaling MAP.exr [--spp N] [--size WxH] [--threads N] [--ranks A,B,...]\n"
    "         [--latency-us X] [--gbytes X] [--handling-us X] [--poll-us X] [--lease-us X]\n"
    "Prints CSV: strategy, ranks, threads, seconds, speedup, efficiency, imbalance, messages.\n";

int run(int argc, char **argv) {
  std::string path, ranks = "1,2,4,8,16,32,64,128,256,512,1024,2048,4096";
  int width = 0, height = 0;
  Setting s{CostMap({0, 0, 1, 1}, 16), 64, 16, 32, 1, 0, {}};
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    if (!option.starts_with("--")) {
      path = option;
      continue;
    }
    if (i + 1 >= argc) throw InputError(option + ": a value is missing");
    const std::string value = argv[++i];
    const double number = std::atof(value.c_str());
    if (option == "--spp") s.spp = static_cast<int>(number);
    else if (option == "--threads") s.threads = static_cast<int>(number);
    else if (option == "--ranks") ranks = value;
    else if (option == "--size" && std::sscanf(value.c_str(), "%dx%d", &width, &height) == 2) continue;
    else if (option == "--latency-us") s.network.latency_s = number * 1e-6;
    else if (option == "--gbytes") s.network.bytes_per_s = number * 1e9;
    else if (option == "--handling-us") s.network.handling_s = number * 1e-6;
    else if (option == "--poll-us") s.network.poll_s = number * 1e-6;
    else if (option == "--lease-us") s.lease_overhead_s = number * 1e-6;
    else throw InputError(option + " " + value + ": not known");
  }
  if (path.empty() || s.spp < 1 || s.threads < 1) {
    fmt::print(stderr, "{}", kUsage);
    return kExitBadInput;
  }
  s.cost = read_map(path, width, height);
  const double alone = s.cost.cost_of(s.cost.crop) * s.spp / s.threads;
  fmt::print("strategy,ranks,threads,seconds,speedup,efficiency,imbalance,messages\n");
  for (const char *name : {"dynamic", "cost", "rows", "columns", "grid", "bbox"})
    for (const int n : numbers(ranks)) {
      const Outcome o = simulate(s, *balance_from_name(name), n);
      fmt::print("{},{},{},{:.6g},{:.5g},{:.4f},{:.4f},{}\n", name, n, s.threads, o.seconds,
                 alone / o.seconds, alone / o.seconds / n, o.busy_max / o.busy_mean, o.messages);
    }
  return kExitDone;
}

}  // namespace
}  // namespace phalanx

int main(int argc, char **argv) {
  try {
    return phalanx::run(argc, argv);
  } catch (const phalanx::InputError &error) {
    fmt::print(stderr, "phalanx_scaling: {}\n", error.what());
    return phalanx::kExitBadInput;
  }
}
