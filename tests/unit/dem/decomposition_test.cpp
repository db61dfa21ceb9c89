// Parts, ghosts and gathering where one rank has it all. On several ranks: tests/parallel/particles_test.cpp.
#include "dem/parallel/decomposition.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "dem/contacts/materials.hpp"
#include "dem/contacts/neighbours.hpp"
#include "dem/parallel/exchange.hpp"
#include "dem/parallel/gathered.hpp"
#include "dem/parallel/ordered_rows.hpp"
#include "dem/verlet.hpp"

namespace polybed::dem {
namespace {

Box unit_box() {
  Box box;
  box.size = {1, 1, 1};
  box.periodic = {true, true, true};
  return box;
}

Particles two_apart(double distance) {
  Particles particles;
  for (std::int64_t id = 0; id < 2; ++id) {
    Particle p{};
    p.id = 1 - id;  // not in the order in which they lie
    p.place = {{0.5 + distance * double(id), 0.5, 0.5}, 0.05};
    p.motion.inverse_mass = 1;
    particles.add(p);
  }
  particles.owned = 2;
  return particles;
}

TEST(OneRank, OwnsTheBoxWhateverTheWork) {
  const Box box = unit_box();
  Decomposition parts(box, nullptr, 5);  // nothing is cut, so that nothing is too thin
  const Particles particles = two_apart(0.1);
  parts.balance(particles.place, std::vector<std::int32_t>{1, 7});
  EXPECT_EQ(parts.owner({0.2, 0.9, 7}), 0);
  EXPECT_EQ(parts.own().high, box.size);
  EXPECT_EQ(parts.centre(), (Vector{0.5, 0.5, 0.5}));
  EXPECT_EQ(parts.whole(0.01), (std::array<bool, 3>{true, true, true}));
  EXPECT_EQ(parts.imbalance(std::vector<std::int32_t>{1, 7}), 1);
}

TEST(OneRank, HasNoGhostsAndEveryPairIsInner) {
  const Box box = unit_box();
  Exchange exchange(box, nullptr, 0.01, 0.05);
  Particles particles = two_apart(0.105);
  KeptContacts kept({{0, 1, {3.0}}}, 1);
  exchange.balance(particles, std::vector<std::int32_t>{1, 1});
  exchange.migrate(particles, kept);
  exchange.choose_ghosts(particles);
  exchange.send_ghosts(particles);
  exchange.receive_ghosts(particles);
  EXPECT_EQ(particles.size(), 2);
  EXPECT_EQ(exchange.cuts(), 0);
  EXPECT_EQ(kept.size(), 1);
  core::Scene scene;
  scene.species.resize(1);
  scene.species[0].diameter = 0.1;
  scene.species[0].density = 1000;
  const Materials materials(scene);
  NeighbourSearch search(box, materials, 0.01, 0.01);
  Contacts contacts;
  search.find_pairs(particles, 0, exchange.decomposition().centre(), exchange.decomposition().whole(0.11), contacts);
  ASSERT_EQ(contacts.pairs.size(), 1);
  EXPECT_EQ(contacts.inner, 1);
  EXPECT_EQ(particles.id[std::size_t(contacts.pairs[0].first)], 0);  // the lower id comes first
}

TEST(OneRank, GathersById) {
  const Snapshot all = gathered_snapshot(two_apart(0.1), nullptr);
  EXPECT_EQ(all.id, (std::vector<std::int64_t>{0, 1}));
  EXPECT_EQ(all.position[0][0], 0.6);
  // A pair across ranks is kept on both and comes out once. The last number of a row tells where it stood.
  const std::vector<double> rows{2, 5, 0, 1, -3, 1, 2, 5, 0, 1, 4, 3, 0, 9, 4};
  EXPECT_EQ(gathered_rows(rows, 3, 2, nullptr), (std::vector<double>{0, 9, 4, 1, -3, 1, 1, 4, 3, 2, 5, 0}));
  EXPECT_EQ(gathered_rows({3, 30, 1, 10, 2, 20, 0, 0}, 2, 1, nullptr),
            (std::vector<double>{0, 0, 1, 10, 2, 20, 3, 30}));
  EXPECT_TRUE(gathered_rows({}, 2, 1, nullptr).empty());
}

TEST(OneRank, OrdersRowsByTheirIds) {
  const OrderedRows rows({{2, 5, 0}, {1, -3, 1}, {1, 4, 2}, {0, 9, 3}}, nullptr);
  EXPECT_EQ(rows.count(), 4);
  const auto fill = [](std::int32_t at, double* row) {
    row[0] = at;
    row[1] = 10 * at;
  };
  EXPECT_EQ(on_first(rows.blocks("a", 2, true, fill), nullptr), (std::vector<double>{3, 30, 1, 10, 2, 20, 0, 0}));
  const OrderedRows none({}, nullptr);
  EXPECT_TRUE(on_first(none.blocks("a", 2, true, fill), nullptr).empty());
}

/// More than one piece, and ids with holes.
TEST(OneRank, OrdersManyRowsInPieces) {
  std::vector<RowName> own;
  constexpr std::int32_t many = 50000;
  for (std::int32_t n = 0; n < many; ++n) own.push_back({3 * ((std::int64_t(n) * 7919) % many), 0, n});
  const OrderedRows rows(own, nullptr);
  const auto blocks =
      rows.blocks("a", 1, false, [&](std::int32_t at, double* row) { *row = double(own[std::size_t(at)].low); });
  EXPECT_GT(blocks.size(), 2);
  std::size_t next = 0;
  for (const core::BlockData& block : blocks) {
    EXPECT_EQ(block.slab.shape, (std::vector<std::size_t>{many, 1}));
    EXPECT_EQ(block.slab.start[0], next);
    next += block.slab.count[0];
  }
  EXPECT_EQ(next, many);
  const std::vector<double> all = on_first(blocks, nullptr);
  ASSERT_EQ(all.size(), many);
  for (std::size_t n = 0; n < all.size(); ++n) ASSERT_EQ(all[n], 3.0 * double(n));
}

/// The list is made again if a place is not a number, also where particles behind it in the order are fine.
TEST(Verlet, WhatIsNotANumberHasMovedTooFar) {
  Verlet verlet(false, 0.1, {0, 0, 0}, FixedPoint{}, FixedPoint{}, 0);
  Particles particles = two_apart(0.1);
  verlet.mark(particles);
  particles.motion[1].v[1] = 2;
  EXPECT_DOUBLE_EQ(verlet.next_drift(particles, 0.1, {}).distance, 0.2);  // 2 m/s for 0.1 s
  particles.place[0].x[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(verlet.next_drift(particles, 0.1, {}).distance));
}

}  // namespace
}  // namespace polybed::dem
