#include "core/output/particles.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/output/files.hpp"
#include "scenes/stored_steps.hpp"
#include "tests/unit/core/scratch.hpp"

namespace polybed::core {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

const ParticleScene scene{{0.06, 0.62, 0.004}, {false, false, true}, {"fine", "coarse"}};

/// Particles that tell who they are and when; every third id is missing.
ParticleStep telling_step(std::size_t count, double time) {
  ParticleStep p;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = double(i) / 7 + time;
    p.id.push_back(std::int64_t(i + i / 2));
    p.species.push_back(std::int32_t(i % 2));
    p.radius.push_back(4e-4 * double(1 + i % 2));
    p.position.push_back({x, 2 * x, 3 * x});
    p.velocity.push_back({-x, x * x, 1 / (1 + x)});
    p.spin.push_back({100 * x, 200 * x, -300 * x});
  }
  return p;
}

ParticleSnapshot snapshot(const ParticleStep& p) { return {p.id, p.species, p.radius, p.position, p.velocity, p.spin}; }

void expect_equal(const ParticleStep& a, const ParticleStep& b) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.species, b.species);
  EXPECT_EQ(a.radius, b.radius);
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.velocity, b.velocity);
  EXPECT_EQ(a.spin, b.spin);
}

std::string xdmf_of(const fs::path& directory) { return read_text(directory / "particles.xdmf"); }

TEST(Particles, ComeBackToTheBitThoughTheirNumberChanges) {
  const test::Scratch scratch;
  ParticleWriter writer(scratch.path(), scene);
  const std::vector<std::size_t> counts{5, 8, 0, 1};
  for (std::size_t n = 0; n < counts.size(); ++n) {
    writer.write_step(0.25 * double(n), snapshot(telling_step(counts[n], double(n))));
    const ParticleReader reader(scratch.path());  // complete after every step
    ASSERT_EQ(reader.times().size(), n + 1);
    EXPECT_EQ(reader.index().texts_attribute("/", "species_names"), scene.species);
    for (std::size_t m = 0; m <= n; ++m) expect_equal(reader.step(m), telling_step(counts[m], double(m)));
  }
  EXPECT_THAT(ParticleReader(scratch.path()).times(), ElementsAre(0, 0.25, 0.5, 0.75));
  EXPECT_THROW((void)ParticleReader(scratch.path()).step(4), FileError);
}

// A double holds integers up to 2^53 only; an id beyond would come back as its neighbour.
TEST(Particles, IdsKeepAllTheirBits) {
  const test::Scratch scratch;
  ParticleStep p = telling_step(2, 0);
  p.id = {(std::int64_t(1) << 53) + 1, (std::int64_t(1) << 62) + 1};
  ParticleWriter(scratch.path(), scene).write_step(0, snapshot(p));
  EXPECT_EQ(ParticleReader(scratch.path()).step(0).id, p.id);
}

TEST(Particles, TheStepIsFoundByItsNameWithItsTimeAndTheSpecies) {
  const test::Scratch scratch;
  ParticleWriter(scratch.path(), scene).write_step(0.125, snapshot(telling_step(3, 0)));
  const OutputFile step(scratch.path() / "particles/000001.h5", {"polybed particles step", 1});
  EXPECT_THAT(step.names("step"), ElementsAre("id", "position", "radius", "species", "spin", "velocity"));
  EXPECT_EQ(step.attribute("step", "time_s"), 0.125);
  EXPECT_THAT(step.texts_attribute("step", "species_names"), ElementsAre("fine", "coarse"));
  EXPECT_THAT(step.read("step/position").shape, ElementsAre(3, 3));
  EXPECT_THAT(step.read_integers("paraview/connectivity"), ElementsAre(0, 1, 2));
  const OutputFile index(scratch.path() / "particles.h5", {"polybed particles", 1});
  EXPECT_THAT(index.names("step"), ElementsAre("000001"));
  EXPECT_THAT(index.read("particles").values, ElementsAre(3));
  EXPECT_THAT(xdmf_of(scratch.path()), HasSubstr("NumberOfElements=\"3\""));
}

TEST(Particles, NumbersThatRepeatArePackedAndOthersAreNot) {
  const test::Scratch scratch;
  constexpr std::size_t count = 5000, bytes_of_vectors = 24 * count;
  ParticleStep p = telling_step(count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    p.velocity[i] = p.spin[i] = {0, -1e-3 * double(i / 64), 0};
    for (double& x : p.position[i]) x = std::sin(12345.678 * x);
  }
  ParticleWriter writer(scratch.path(), scene);
  writer.write_step(0, snapshot(p));
  const auto size = fs::file_size(scratch.path() / "particles/000001.h5");
  EXPECT_GT(size, bytes_of_vectors);        // the positions as they are
  EXPECT_LT(size, 1.5 * bytes_of_vectors);  // velocities and spins as they are would make it three times as much
  expect_equal(ParticleReader(scratch.path()).step(0), p);
}

TEST(Particles, ResumingRemovesLaterStepsAndKeepsTheNumbers) {
  const test::Scratch scratch;
  {
    ParticleWriter writer(scratch.path(), scene);
    for (int n = 0; n < 4; ++n) writer.write_step(n, snapshot(telling_step(std::size_t(n) + 1, n)));
  }
  ParticleWriter writer(scratch.path(), scene, 1.0);
  EXPECT_THAT(ParticleReader(scratch.path()).times(), ElementsAre(0, 1));
  EXPECT_FALSE(fs::exists(scratch.path() / "particles/000003.h5"));
  writer.write_step(7, snapshot(telling_step(9, 7)));
  const ParticleReader reader(scratch.path());
  EXPECT_THAT(reader.times(), ElementsAre(0, 1, 7));
  expect_equal(reader.step(2), telling_step(9, 7));
  const std::string xdmf = xdmf_of(scratch.path());
  for (const char* count : {"1", "2", "9"})
    EXPECT_THAT(xdmf, HasSubstr("NumberOfElements=\"" + std::string(count) + "\""));
  EXPECT_THAT(xdmf, Not(HasSubstr("NumberOfElements=\"3\"")));
}

TEST(Particles, AnotherSceneIsNotContinued) {
  const test::Scratch scratch;
  ParticleWriter(scratch.path(), scene).write_step(0, snapshot(telling_step(2, 0)));
  ParticleScene other = scene;
  other.species[1] = "coarser";
  EXPECT_THROW(ParticleWriter(scratch.path(), other, 1.0), FileError);
  other = scene;
  other.periodic[0] = true;
  EXPECT_THROW(ParticleWriter(scratch.path(), other, 1.0), FileError);
  EXPECT_EQ(ParticleReader(scratch.path()).times().size(), 1u);
}

TEST(Particles, ANewRunRemovesTheOldSteps) {
  const test::Scratch scratch;
  ParticleWriter(scratch.path(), scene).write_step(0, snapshot(telling_step(2, 0)));
  const ParticleWriter writer(scratch.path(), scene);
  EXPECT_TRUE(ParticleReader(scratch.path()).times().empty());
  EXPECT_FALSE(fs::exists(scratch.path() / "particles/000001.h5"));
  EXPECT_FALSE(fs::exists(scratch.path() / "particles.xdmf"));
}

TEST(Particles, NoNotANumberReachesTheDisk) {
  const test::Scratch scratch;
  ParticleWriter writer(scratch.path(), scene);
  const ParticleStep good = telling_step(5, 0);
  for (int kind = 0; kind < 4; ++kind) {
    ParticleStep p = good;
    auto& spoilt = kind == 0 ? p.radius[3] : kind == 1 ? p.position[3][0] : kind == 2 ? p.velocity[3][1] : p.spin[3][2];
    spoilt = kind == 1 ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
    constexpr std::array<const char*, 4> names{"radius", "position x", "velocity y", "spin z"};
    try {
      writer.write_step(0.5, snapshot(p));
      FAIL() << names[std::size_t(kind)];
    } catch (const NumericsError& error) {
      EXPECT_THAT(error.what(), HasSubstr(names[std::size_t(kind)]));
      EXPECT_THAT(error.what(), HasSubstr("particle 4"));  // ids 0 1 3 4 6
    }
  }
  EXPECT_TRUE(ParticleReader(scratch.path()).times().empty());
  EXPECT_FALSE(fs::exists(scratch.path() / "particles/000001.h5"));
}

TEST(Particles, WhatDoesNotFitTogetherIsRefused) {
  const test::Scratch scratch;
  ParticleWriter writer(scratch.path(), scene);
  ParticleStep p = telling_step(4, 0);
  p.spin.pop_back();
  EXPECT_THROW(writer.write_step(0, snapshot(p)), std::invalid_argument);
  p = telling_step(4, 0);
  std::swap(p.id[1], p.id[2]);
  EXPECT_THROW(writer.write_step(0, snapshot(p)), std::invalid_argument);
  p = telling_step(4, 0);
  p.species[2] = 2;
  EXPECT_THROW(writer.write_step(0, snapshot(p)), std::invalid_argument);
}

TEST(Particles, AFullDiskLeavesTheStepsBefore) {
  const test::Scratch scratch;
  ParticleWriter writer(scratch.path(), scene);
  writer.write_step(0, snapshot(telling_step(3, 0)));
  {
    const test::FullDisk disk(2000);
    EXPECT_THROW(writer.write_step(1, snapshot(telling_step(3, 1))), FileError);
  }
  const ParticleReader reader(scratch.path());
  EXPECT_EQ(reader.times().size(), 1u);
  expect_equal(reader.step(0), telling_step(3, 0));
}

}  // namespace
}  // namespace polybed::core
