// The book, played without messages: whatever happens to ranks, every sample is rendered once.
#include "distribute/lease_book.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>

#include "distribute/partition.h"

using namespace phalanx;

namespace {

std::vector<BookTile> tiles(Rect crop, int size, int owners = 0) {
  std::vector<BookTile> list;
  for (const Rect &r : tiles_of(crop, size))
    list.push_back({r, owners > 0 ? static_cast<int>(list.size()) % owners : -1, 0});
  return list;
}

/// Samples of every pixel, counted as leases are committed; they have to come in their order.
struct Pixels {
  explicit Pixels(Rect crop) : width(crop.width), samples(static_cast<std::size_t>(crop.width * crop.height)) {}
  void commit(const Lease &lease) {
    for (int y = lease.rect.y; y < lease.rect.y + lease.rect.height; ++y)
      for (int x = lease.rect.x; x < lease.rect.x + lease.rect.width; ++x) {
        int &n = samples[static_cast<std::size_t>(y * width + x)];
        in_order = in_order && n == lease.first_sample;
        n = lease.end_sample;
      }
  }
  bool all_are(int n) const {
    return std::all_of(samples.begin(), samples.end(), [&](int s) { return s == n; });
  }
  int width;
  std::vector<int> samples;
  bool in_order = true;
};

}  // namespace

TEST_CASE("leases: ranks that answer in any order, or get lost, or come back, render all samples once") {
  const Rect crop = {0, 0, 70, 45};
  for (int seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(static_cast<unsigned>(seed));
    const int ranks = 1 + seed % 5, spp = 1 + seed % 70;
    std::vector<int> threads;
    for (int r = 0; r < ranks; ++r) threads.push_back(1 + static_cast<int>(random() % 3));
    LeaseBook book(tiles(crop, 16, seed % 2 ? ranks : 0), threads, {});
    book.set_target(spp);
    Pixels pixels(crop);
    std::vector<std::pair<int, Lease>> running;  // rank, lease
    double now = 0;
    int steps = 0;
    while (!book.done() && ++steps < 100000) {
      now += 0.01;
      const int rank = static_cast<int>(random() % static_cast<unsigned>(ranks));
      if (!book.is_lost(rank))
        if (const auto lease = book.grant(rank, now)) running.push_back({rank, *lease});
      if (!running.empty() && random() % 2) {
        const std::size_t i = random() % running.size();
        const auto [who, lease] = running[i];
        running.erase(running.begin() + static_cast<long>(i));
        const double pixel_s = 1e-6 * (1 + lease.rect.x);
        const double seconds =
            pixel_s * lease.rect.width * lease.rect.height * (lease.end_sample - lease.first_sample);
        if (ranks > 1 && random() % 8 == 0) continue;  // the answer never arrives
        if (book.commit(lease.id, seconds)) pixels.commit(lease);
        CHECK_FALSE(book.commit(lease.id, seconds));  // a second answer is not counted
      }
      if (random() % 50 == 0 && rank > 0) book.is_lost(rank) ? book.find(rank) : book.lose(rank);
    }
    CHECK(book.done());
    CHECK(pixels.in_order);
    CHECK(pixels.all_are(spp));
    CHECK(book.fewest_samples() == spp);
    CHECK(book.samples_done() == doctest::Approx(70.0 * 45 * spp));
  }
}

TEST_CASE("leases: tiles with an owner go to nobody else, until the owner is lost") {
  LeaseBook book(tiles({0, 0, 64, 64}, 16, 2), {1, 1}, {});
  book.set_target(16);
  int given = 0;
  while (const auto lease = book.grant(0, 0)) {
    CHECK(lease->rect.x % 32 == 0);
    ++given;
    CHECK(book.commit(lease->id, 0.01));
  }
  CHECK(given == 8);
  CHECK_FALSE(book.done());
  book.lose(1);
  while (const auto lease = book.grant(0, 0)) CHECK(book.commit(lease->id, 0.01));
  CHECK(book.done());
}

TEST_CASE("leases: they get shorter towards the end") {
  LeaseBook book(tiles({0, 0, 256, 256}, 32), {1, 1}, {});
  book.set_target(256);
  double longest = 0, last = 1e9;
  // Two ranks, each pixel and sample takes a microsecond.
  std::optional<Lease> work[2] = {book.grant(0, 0), book.grant(1, 0)};
  double ends[2] = {0, 0};
  const auto cost = [](const Lease &l) {
    return 1e-6 * l.rect.width * l.rect.height * (l.end_sample - l.first_sample);
  };
  for (int r : {0, 1}) ends[r] = cost(*work[r]);
  for (;;) {
    const int r = work[0] && (!work[1] || ends[0] <= ends[1]) ? 0 : 1;
    if (!work[r]) break;
    const double s = cost(*work[r]), now = ends[r];
    longest = std::max(longest, s);
    last = s;
    book.commit(work[r]->id, s);
    work[r] = book.grant(r, now);
    if (work[r]) ends[r] = now + cost(*work[r]);
  }
  CHECK(book.done());
  CHECK(longest > 0.1);
  CHECK(longest <= 0.31);
  CHECK(last < 0.005);
  CHECK(std::abs(ends[0] - ends[1]) < 0.01);  // of 8.4 s
}

TEST_CASE("leases: what takes too long is given to a second rank, and the first answer counts") {
  LeaseBook book(tiles({0, 0, 8, 8}, 8), {1, 1}, {});
  book.set_target(4);
  const auto first = book.grant(1, 0);
  REQUIRE(first);
  CHECK_FALSE(book.grant(0, 1.0));
  const auto again = book.grant(0, 2.5);
  REQUIRE(again);
  CHECK(again->id == first->id);
  CHECK_FALSE(book.grant(0, 9.0));  // not a third time
  CHECK(book.commit(again->id, 0.1));
  CHECK_FALSE(book.commit(first->id, 9.0));
  CHECK(book.done());
}

TEST_CASE("leases: the target may grow while leases are out") {
  LeaseBook book(tiles({0, 0, 16, 8}, 8), {1}, {});
  book.set_target(16);
  const auto a = book.grant(0, 0), b = book.grant(0, 0);
  REQUIRE((a && b));
  CHECK(book.commit(a->id, 0.1));
  CHECK_FALSE(book.has_free());
  book.set_target(24);
  CHECK(book.has_free());
  CHECK(book.commit(b->id, 0.1));
  CHECK_FALSE(book.done());
  while (const auto lease = book.grant(0, 0)) {
    CHECK(lease->end_sample == 24);
    CHECK(book.commit(lease->id, 0.1));
  }
  CHECK(book.done());
}
