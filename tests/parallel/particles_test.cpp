// Messages, parts of the box, migration and ghosts, on as many ranks as mpirun starts. Every rank knows where all
// particles are, so that it can tell what it must own, see and pair.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "core/error.hpp"
#include "core/numerics/mpi.hpp"
#include "core/numerics/random.hpp"
#include "dem/contacts/materials.hpp"
#include "dem/contacts/neighbours.hpp"
#include "dem/model.hpp"
#include "dem/parallel/exchange.hpp"
#include "dem/parallel/gathered.hpp"
#include "dem/parallel/ordered_rows.hpp"
#include "dem/stress.hpp"
#include "scenes/dem_gas.hpp"

namespace polybed::dem {
namespace {

const std::shared_ptr<const core::Ranks>& ranks() {
  static const std::shared_ptr<const core::Ranks> ranks = core::Ranks::of_program();
  return ranks;
}
int rank() { return ranks() ? ranks()->rank() : 0; }
int count() { return ranks() ? ranks()->count() : 1; }

Box box_of(Vector size, std::array<bool, 3> periodic) {
  Box box;
  box.size = size;
  box.periodic = periodic;
  return box;
}

std::vector<Box> boxes() {
  return {box_of({1, 1, 1}, {true, true, true}), box_of({1, 2, 0.7}, {false, false, false}),
          box_of({0.8, 1.5, 0.4}, {true, false, true})};
}

constexpr double least = 0.08, reach = 0.04;  // m: diameter of the largest particle, and skin
constexpr std::int64_t all = 600;

core::Scene two_sizes() {
  core::Scene scene;
  scene.species.resize(2);
  scene.species[0].name = "large";
  scene.species[0].diameter = least;
  scene.species[1].name = "small";
  scene.species[1].diameter = 0.4 * least;
  for (core::Species& species : scene.species) species.density = 1000;
  return scene;
}

/// Of two sizes, anywhere in a share of the box (in its low corner), the same on every rank.
Particle particle(const Box& box, std::int64_t id, double share, std::uint64_t seed) {
  Particle p{};
  p.id = id;
  p.species = id % 3 == 0 ? 0 : 1;
  p.place.radius = p.species == 0 ? 0.5 * least : 0.2 * least;
  for (std::size_t k = 0; k < 3; ++k) {
    p.place.x[k] = box.size[k] * share * core::uniform(seed, k, std::uint64_t(id));
    p.motion.v[k] = core::normal(seed, 3 + k, std::uint64_t(id));
  }
  return p;
}

Particles own_particles(const Box& box, const Decomposition& parts, double share, std::uint64_t seed) {
  Particles particles;
  for (std::int64_t id = 0; id < all; ++id) {
    const Particle p = particle(box, id, share, seed);
    if (parts.owner(p.place.x) == rank()) particles.add(p);
  }
  particles.owned = particles.size();
  return particles;
}

/// Whether two particles are nearer than contact and reach, of any image.
bool are_near(const Box& box, const Particle& a, const Particle& b) {
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    double d = std::abs(a.place.x[k] - b.place.x[k]);
    if (box.periodic[k]) d = std::min(d, box.size[k] - d);
    square += d * d;
  }
  const double near = a.place.radius + b.place.radius + reach;
  return square < near * near;
}

TEST(Messages, ArriveInTheOrderOfRanksAlongOnePattern) {
  const auto number = [](int from, int to) { return (from + 2 * to) % 3; };  // none, one or two; also to itself
  std::vector<int> to, from;
  for (int r = 0; ranks() && r < count(); ++r) {
    to.push_back(number(rank(), r));
    from.push_back(number(r, rank()));
  }
  core::Messages messages(ranks(), to);
  EXPECT_EQ(messages.from(), from);
  EXPECT_EQ(messages.incoming(), std::size_t(std::accumulate(from.begin(), from.end(), 0)));
  for (int round = 0; round < 3; ++round) {
    std::vector<std::array<int, 3>> out, expected;
    for (int r = 0; r < int(to.size()); ++r) {
      for (int n = 0; n < number(rank(), r); ++n) out.push_back({rank(), r, round + n});
      for (int n = 0; n < number(r, rank()); ++n) expected.push_back({r, rank(), round + n});
    }
    std::vector<std::array<int, 3>> in(messages.incoming());
    messages.start(std::span<const std::array<int, 3>>(out), std::span<std::array<int, 3>>(in));
    messages.finish();
    EXPECT_EQ(in, expected);
  }
}

TEST(Decomposition, EveryPlaceHasOneOwnerWhosePartItIsIn) {
  for (const Box& box : boxes()) {
    Decomposition parts(box, ranks(), least);
    for (const bool cut : {false, true}) {
      const Particles own = own_particles(box, parts, 0.6, 5);
      if (cut) parts.balance(own.place, std::vector<std::int32_t>(own.size(), 1));
      for (std::uint64_t n = 0; n < 2000; ++n) {
        Vector x;
        for (std::size_t k = 0; k < 3; ++k) x[k] = box.size[k] * core::uniform(9, k, n);
        int holders = 0;
        for (int r = 0; r < count(); ++r) {
          const Part& part = parts.parts()[std::size_t(r)];
          bool holds = true;
          for (std::size_t k = 0; k < 3; ++k) holds = holds && x[k] >= part.low[k] && x[k] < part.high[k];
          holders += holds ? 1 : 0;
          EXPECT_EQ(holds, parts.owner(x) == r);
        }
        EXPECT_EQ(holders, 1);
      }
      if (box.periodic[1]) continue;
      // What flies over the top, or has sunk a little into a wall, belongs to an outer part.
      const Part& above = parts.parts()[std::size_t(parts.owner({0.1, 9, 0.1}))];
      EXPECT_EQ(above.high[1], box.size[1]);
      const Part& below = parts.parts()[std::size_t(parts.owner({0.1, -1e-3, 0.1}))];
      EXPECT_EQ(below.low[1], 0);
    }
  }
}

TEST(Decomposition, WorkIsSharedEvenly) {
  constexpr std::uint64_t points = 20000;
  for (const Box& box : boxes())
    for (const int power : {1, 3}) {  // evenly anywhere, and crowded at the low corner
      std::vector<Place> place;
      std::vector<std::int32_t> work;
      for (std::uint64_t n = std::uint64_t(rank()); n < points; n += std::uint64_t(count())) {
        Place p{};
        for (std::size_t k = 0; k < 3; ++k) p.x[k] = box.size[k] * std::pow(core::uniform(1, k, n), power);
        place.push_back(p);
        work.push_back(1 + std::int32_t(n % 5));
      }
      Decomposition parts(box, ranks(), 1e-4);
      parts.balance(place, work);
      std::vector<double> share(std::size_t(count()), 0.0);
      for (std::size_t i = 0; i < place.size(); ++i) share[std::size_t(parts.owner(place[i].x))] += work[i];
      core::add_over_ranks(ranks().get(), share);
      // A cut is found to a 4096th of a part. Crowded as the third power, the first of these bins holds a sixteenth of
      // the points and more than a part's share may be lost in it; so the crowd is held to a wider limit.
      const double even = 3.0 * points / count(), limit = power == 1 ? 0.02 : 0.15;
      for (const double s : share) EXPECT_NEAR(s / even, 1, limit) << count() << " ranks, power " << power;
    }
}

TEST(Decomposition, WorkOutOfBalanceIsSeen) {
  const Box box = boxes()[0];
  const Decomposition parts(box, ranks(), least);
  const std::vector<std::int32_t> work(10, rank() == 0 ? 3 : 1);
  EXPECT_DOUBLE_EQ(parts.imbalance(work), 3.0 * count() / (count() + 2));
  EXPECT_EQ(parts.imbalance({}), 1);  // nobody has any
}

/// However the work lies, a cut leaves no part thinner than a particle, and nothing is refused on the way.
TEST(Decomposition, NoCutLeavesAPartThinnerThanAParticle) {
  const Box box = box_of({4.2 * least, 2.1 * least, 1.1 * least}, {true, false, true});
  if (count() > 8) GTEST_SKIP();
  Decomposition parts(box, ranks(), least);
  for (std::uint64_t heap = 0; heap < 50; ++heap) {
    std::vector<Place> place(rank() == 0 ? 40 : 0);
    for (Place& p : place)
      for (std::size_t k = 0; k < 3; ++k) p.x[k] = box.size[k] * core::uniform(heap, k, heap % 2 == 0 ? 1 : heap);
    parts.balance(place, std::vector<std::int32_t>(place.size(), 1));
    for (const Part& part : parts.parts())
      for (std::size_t k = 0; k < 3; ++k) EXPECT_GE(part.high[k] - part.low[k], least * (1 - 1e-6));
  }
}

TEST(Decomposition, PartsThinnerThanAParticleAreRefused) {
  const Box narrow = box_of({0.9 * count() * least, 0.1 * least, 0.1 * least}, {true, true, true});
  if (count() == 1) {
    EXPECT_NO_THROW(Decomposition(narrow, ranks(), least));
    return;
  }
  try {
    const Decomposition parts(narrow, ranks(), least);
    ADD_FAILURE() << "taken";
  } catch (const core::CaseError& error) {
    EXPECT_EQ(std::string(error.what()),
              fmt::format("{} ranks would own parts of 0.072 m, thinner than the largest particle, 0.08 m: use fewer",
                          count()));
  }
  Box sheared = boxes()[0];
  sheared.shear_rate = 1;
  EXPECT_THROW(Decomposition(sheared, ranks(), least), core::CaseError);
}

TEST(Exchange, ParticlesAndTheirContactsGoToTheirOwners) {
  for (const Box& box : boxes()) {
    Exchange exchange(box, ranks(), reach, 0.5 * least);
    const Decomposition& parts = exchange.decomposition();
    // All in the corner, a twentieth of the box: on most numbers of ranks all on one, the others have none.
    Particles particles = own_particles(box, parts, 0.05, 1);
    std::vector<KeptContact> kept;
    for (std::size_t i = 0; i < particles.owned; ++i) {
      const std::int64_t id = particles.id[i];
      kept.push_back({id, -1, {double(id)}});
      if (id + 1 < all) kept.push_back({id, id + 1, {0.5 * double(id)}});
      // A pair across ranks is kept on both.
      if (id > 0 && parts.owner(particle(box, id - 1, 0.05, 1).place.x) != rank())
        kept.push_back({id - 1, id, {0.5 * double(id - 1)}});
    }
    // All at once to anywhere, across several ranks.
    for (std::size_t i = 0; i < particles.owned; ++i)
      particles.place[i].x = particle(box, particles.id[i], 1, 2).place.x;
    KeptContacts moved(kept, 1);
    exchange.migrate(particles, moved);
    std::set<std::int64_t> own;
    for (std::size_t i = 0; i < particles.owned; ++i) {
      own.insert(particles.id[i]);
      EXPECT_EQ(parts.owner(particles.place[i].x), rank());
      EXPECT_EQ(particles.place[i].x, particle(box, particles.id[i], 1, 2).place.x);
      EXPECT_EQ(particles.motion[i].v, particle(box, particles.id[i], 0.05, 1).motion.v);
    }
    std::set<std::pair<std::int64_t, std::int64_t>> known;
    for (std::size_t n = 0; n < moved.size(); ++n) {
      const std::int64_t low = moved.low(n), high = moved.high(n);
      if (moved.memory(n)[0] == (high < 0 ? double(low) : 0.5 * double(low))) known.insert({low, high});
    }
    for (std::int64_t id = 0; id < all; ++id) {
      EXPECT_EQ(own.count(id) == 1, parts.owner(particle(box, id, 1, 2).place.x) == rank());
      if (own.count(id) == 0) continue;
      EXPECT_TRUE(known.count({id, -1}) == 1) << id;
      EXPECT_TRUE(id + 1 == all || known.count({id, id + 1}) == 1) << id;
      EXPECT_TRUE(id == 0 || known.count({id - 1, id}) == 1) << id;
    }
    const Snapshot gathered = gathered_snapshot(particles, ranks());
    EXPECT_EQ(gathered.id.size(), core::is_first(ranks().get()) ? std::size_t(all) : 0);
    for (std::size_t n = 0; n < gathered.id.size(); ++n) {
      EXPECT_EQ(gathered.id[n], std::int64_t(n));
      EXPECT_EQ(gathered.position[n], particle(box, std::int64_t(n), 1, 2).place.x);
    }
  }
}

/// Whatever rank has a row, it comes out in its place, and every rank writes some.
TEST(OrderedRows, AreWrittenByAllRanks) {
  constexpr std::int32_t many = 40000;
  std::vector<RowName> own;
  for (std::int32_t n = 0; n < many; ++n)
    if ((std::int64_t(n) * 7919) % count() == rank()) own.push_back({n / 2, n % 2 == 0 ? -1 : n, n});
  const OrderedRows rows(own, ranks());
  EXPECT_EQ(rows.count(), many);
  const auto blocks = rows.blocks("a", 2, true, [](std::int32_t at, double* row) {
    row[0] = at;
    row[1] = -at;
  });
  std::size_t mine = 0;
  for (const core::BlockData& block : blocks) mine += block.slab.count[0];
  EXPECT_NEAR(double(mine), 2.0 * many / count(), 8.0 * double(blocks.size()));  // ids are cut, not rows
  const std::vector<double> all = on_first(blocks, ranks());
  ASSERT_EQ(all.size(), core::is_first(ranks().get()) ? 2 * std::size_t(many) : 0);
  for (std::size_t n = 0; n < all.size(); n += 2) {
    ASSERT_EQ(all[n], double(n / 2));
    ASSERT_EQ(all[n + 1], -double(n / 2));
  }
}

/// Every near pair with a particle of this rank is listed once, also where a part fills nearly all of a periodic
/// direction and one ghost is near both of its faces.
TEST(Exchange, NoPairIsMissed) {
  for (const Box& box : boxes())
    for (const double share : {1.0, 0.15}) {  // cut evenly, and so that the last parts are nearly the whole box
      Exchange exchange(box, ranks(), reach, 0.5 * least);
      Decomposition& parts = exchange.decomposition();
      const Particles heap = own_particles(box, parts, share, 3);
      parts.balance(std::span(heap.place).first(heap.owned), std::vector<std::int32_t>(heap.owned, 1));
      Particles particles = own_particles(box, parts, 1, 4);
      exchange.choose_ghosts(particles);
      const Materials materials(two_sizes());
      NeighbourSearch search(box, materials, reach, reach);
      Contacts contacts;
      search.find_pairs(particles, 0, parts.centre(), parts.whole(least + reach), contacts);
      std::multiset<std::pair<std::int64_t, std::int64_t>> found;
      for (std::size_t n = 0; n < contacts.pairs.size(); ++n) {
        const auto i = std::size_t(contacts.pairs[n].first), j = std::size_t(contacts.pairs[n].second);
        found.insert({particles.id[i], particles.id[j]});
        EXPECT_EQ(n < contacts.inner, i < particles.owned && j < particles.owned);
      }
      std::size_t expected = 0;
      for (std::int64_t a = 0; a < all; ++a)
        for (std::int64_t b = a + 1; b < all; ++b) {
          const Particle one = particle(box, a, 1, 4), other = particle(box, b, 1, 4);
          const bool here = parts.owner(one.place.x) == rank() || parts.owner(other.place.x) == rank();
          if (!here || !are_near(box, one, other)) continue;
          ++expected;
          EXPECT_EQ(found.count({a, b}), 1) << a << ' ' << b << ", share " << share;
        }
      EXPECT_EQ(found.size(), expected);
    }
}

TEST(Exchange, GhostsAreWhereTheirOwnersAre) {
  const Box box = boxes()[0];
  Exchange exchange(box, ranks(), reach, 0.5 * least);
  Particles particles = own_particles(box, exchange.decomposition(), 1, 6);
  exchange.choose_ghosts(particles);
  for (std::size_t i = 0; i < particles.owned; ++i) {
    particles.place[i].x[0] += 1e-3 * double(particles.id[i]);
    particles.motion[i].w[2] = double(particles.id[i]);
  }
  exchange.send_ghosts(particles);
  exchange.receive_ghosts(particles);
  EXPECT_EQ(count() > 1, particles.size() > particles.owned);
  for (std::size_t i = particles.owned; i < particles.size(); ++i) {
    const std::int64_t id = particles.id[i];
    EXPECT_EQ(particles.place[i].x[0], particle(box, id, 1, 6).place.x[0] + 1e-3 * double(id));
    EXPECT_EQ(particles.motion[i].w[2], double(id));
    EXPECT_EQ(particles.motion[i].v, particle(box, id, 1, 6).motion.v);
  }
}

/// The stress of a gas that collides, on all ranks and on one: particles have the same bits, so have its whole units.
TEST(Stress, IsTheSameOnAnyNumberOfRanks) {
  const scenes::Gas gas{.number = 300, .fraction = 0.3, .restitution = 0.8};
  const core::Scene scene = scenes::scene_of(gas);
  core::Timers timers, timers_alone;
  Model model(scene, timers, ranks()), alone(scene, timers_alone);
  std::int64_t contacts = 0;
  for (int n = 0; n < 200; ++n) {
    model.step(1e300);
    alone.step(1e300);
    if (n % 20 != 0) continue;
    const Stress shared = stress_of(model), whole = stress_of(alone);
    EXPECT_EQ(shared.contact, whole.contact);
    EXPECT_EQ(shared.kinetic, whole.kinetic);
    EXPECT_EQ(shared.contacts, whole.contacts);
    contacts += whole.contacts;
  }
  EXPECT_GT(contacts, 50);
}

}  // namespace
}  // namespace polybed::dem

/// Only the first rank reports; a failure on any rank ends them all with 1.
int main(int argc, char** argv) {
  testing::InitGoogleMock(&argc, argv);
  const auto ranks = polybed::core::Ranks::of_program();
  const int failed = RUN_ALL_TESTS();
  const bool any = polybed::core::on_any_rank(ranks.get(), failed != 0);
  MPI_Finalize();
  return any ? 1 : 0;
}
