// The suite itself: what is planted in a run is found by the invariant that is meant to find it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <set>
#include <thread>

#include "core/error.hpp"
#include "core/output/files.hpp"
#include "core/timers.hpp"
#include "hard/child.hpp"
#include "hard/fuzz.hpp"
#include "hard/grains.hpp"
#include "hard/matrix.hpp"
#include "hard/result_text.hpp"
#include "hard/scenes.hpp"
#include "scenes/beads.hpp"
#include "scenes/scratch.hpp"

namespace polybed::hard {
namespace {

using Plant = std::function<void(tfm::Fields&)>;

/// A run whose fields are changed before anybody looks at them.
class PlantedRun final : public Run {
 public:
  PlantedRun(Run& run, Plant plant) : run_(run), plant_(std::move(plant)), shown_(run.fields()) {}
  [[nodiscard]] double time() const override { return run_.time(); }
  tfm::StepLine step(double stop) override { return run_.step(stop); }
  const tfm::Fields& fields() override {
    shown_ = run_.fields();
    plant_(shown_);
    return shown_;
  }
  void restart() override { run_.restart(); }
  [[nodiscard]] tfm::Work work() const override { return run_.work(); }
  [[nodiscard]] tfm::Model& model() override { return run_.model(); }

 private:
  Run& run_;
  Plant plant_;
  tfm::Fields shown_;
};

/// What a sound run of a short bed comes to with something planted in it.
Result with(const Plant& plant, const std::vector<double>& volume_share = {0.569, 0.431}) {
  core::Scene scene = two_species(20, 0.06, false);
  scene.bed.volume_share = volume_share;
  scene.bed.static_height = 0.03;
  scene.bed.start_solids_fraction = 0.5;
  scene.inlet.superficial_velocity = {{0.0, 0.02}};
  Trial trial({"explicit", "limited", ""});
  return trial.judge([&](Trial& t) {
    const auto run = t.begin(scene);
    PlantedRun planted(*run, plant);
    t.advance(planted, 0.02, {.steps = false});
  });
}

TEST(Suite, FindsNothingInASoundRun) {
  EXPECT_EQ(with([](tfm::Fields&) {}).outcome, Outcome::pass);
}

TEST(Suite, FindsANumberThatIsNone) {
  const Result result = with([](tfm::Fields& fields) {
    for (double& p : fields.fluid.pressure) p = std::numeric_limits<double>::quiet_NaN();
  });
  EXPECT_EQ(result.outcome, Outcome::fail);
  EXPECT_THAT(result.broken, testing::HasSubstr("V3 finite"));
}

// std::max, by which limits are asked, lets such numbers pass.
TEST(Suite, FindsANumberThatIsNoneInDragAndSideways) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Plant> plants{[](tfm::Fields& fields) { fields.solids.exchange[1].back() = none; },
                                  [](tfm::Fields& fields) { fields.fluid.flux[0].back() = none; },
                                  [](tfm::Fields& fields) { fields.solids.velocity[0][0].front() = none; }};
  for (const Plant& plant : plants) {
    const Result result = with(plant);
    EXPECT_EQ(result.outcome, Outcome::fail);
    EXPECT_THAT(result.broken, testing::HasSubstr("V3 finite"));
  }
}

TEST(Suite, FindsSolidsFromNowhere) {
  const Result result = with(
      [](tfm::Fields& fields) { fields.solids.fraction[0].assign(fields.solids_fraction.size(), 1e-20); }, {0.0, 1.0});
  EXPECT_EQ(result.outcome, Outcome::fail);
  EXPECT_THAT(result.broken, testing::HasSubstr("V1 solids from nowhere"));
}

TEST(Suite, FindsALeakOfABillionthOfTheMass) {
  const Result result = with([](tfm::Fields& fields) {
    for (double& phi : fields.solids.fraction[0]) phi *= 1 - 1e-9;
  });
  EXPECT_EQ(result.outcome, Outcome::fail);
  EXPECT_EQ(result.broken, "V1 mass");
  EXPECT_NEAR(result.worst.value, 1e-9, 1e-11);
}

TEST(Suite, FindsDragThatPushes) {
  const Result result = with([](tfm::Fields& fields) {
    for (double& drag : fields.solids.exchange[0]) drag = -std::abs(drag) - 1;
  });
  EXPECT_EQ(result.outcome, Outcome::fail);
  EXPECT_THAT(result.broken, testing::HasSubstr("V13 drag power below 0"));
}

TEST(Suite, FindsALostParticle) {
  Trial trial({"particles", "", ""});
  const Result result = trial.judge([](Trial& t) {
    scenes::Beads run(scenes::dry_box(0.5e-3, {5e6, 0.25, 2500}, {0.01, 0.01, 0.01}),
                      {{"a", {2e-3, 2e-3, 2e-3}}, {"a", {5e-3, 5e-3, 5e-3}}});
    Grains grains(t, run.model);
    const_cast<dem::Particles&>(run.model.particles()).owned = 1;  // as if the last one had gone
    grains.see();
  });
  EXPECT_EQ(result.outcome, Outcome::fail);
  EXPECT_THAT(result.broken, testing::HasSubstr("V1 particles missing"));
}

TEST(Suite, TellsAHangAndACrashAndGoesOn) {
  std::vector<ChildEnd> ends(4);
  const auto work = [](std::size_t n) -> std::string {
    if (n == 0) std::this_thread::sleep_for(std::chrono::hours(1));
    if (n == 1) std::abort();
    if (n == 2) throw std::runtime_error("nobody catches this");
    return std::string(100'000, 'x');  // more than a pipe holds
  };
  in_children(ends.size(), {.jobs = 2, .seconds = 2}, work, [&](std::size_t n, const ChildEnd& end) { ends[n] = end; });
  EXPECT_EQ(ends[0].text, "no end after 2 s");
  EXPECT_THAT(ends[1].text, testing::StartsWith("crashed"));
  EXPECT_FALSE(ends[1].answered || ends[2].answered || ends[0].answered);
  EXPECT_TRUE(ends[3].answered);
  EXPECT_EQ(ends[3].text.size(), 100'000U);
}

TEST(Suite, TellsWorkWithoutEndByItsComputing) {
  ChildEnd found;
  const auto forever = [](std::size_t) -> std::string {
    for (double sum = 0;; sum += 1)
      if (core::cpu_seconds() < 0) return std::to_string(sum);
  };
  in_children(1, {.seconds = 120, .cpu = 1}, forever, [&](std::size_t, const ChildEnd& end) { found = end; });
  EXPECT_EQ(found.text, "no end after 1 s of computing");
}

TEST(Suite, TellsOneThatIsKilledFromOneThatComputedTooLong) {
  ChildEnd found;
  const auto killed = [](std::size_t) -> std::string {
    std::raise(SIGKILL);
    return "";
  };
  in_children(1, {.seconds = 60, .cpu = 50}, killed, [&](std::size_t, const ChildEnd& end) { found = end; });
  EXPECT_EQ(found.text, "crashed: Killed");
}

// What still runs when the caller throws ends with it: nobody would take its answer.
TEST(Suite, LeavesNoPieceBehindAnException) {
  const scenes::Scratch folder;
  const std::filesystem::path there = folder.path() / "there";
  const auto work = [&](std::size_t n) -> std::string {
    if (n == 1) core::write_atomically(there, std::to_string(::getpid()));
    while (n == 1 || !std::filesystem::exists(there)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return "";
  };
  const auto take = [](std::size_t, const ChildEnd&) { throw std::runtime_error("no room for the answer"); };
  EXPECT_THROW(in_children(2, {.jobs = 2, .seconds = 3600}, work, take), std::runtime_error);
  pid_t other = 0;
  std::ifstream(there) >> other;
  ASSERT_GT(other, 0);
  EXPECT_EQ(::kill(other, 0), -1);
  EXPECT_EQ(errno, ESRCH);
}

TEST(Suite, ResultsComeThroughTheirText) {
  Result result;
  result.outcome = Outcome::degraded;
  result.worst = {"V7 \"balance\"", 1.5e-3, 1e-3};
  result.cause = "two\nlines";
  result.work.steps = 12;
  const Result other = result_of(text_of(result));
  EXPECT_EQ(other.outcome, result.outcome);
  EXPECT_EQ(other.worst.id, result.worst.id);
  EXPECT_EQ(other.worst.value, result.worst.value);
  EXPECT_EQ(other.cause, result.cause);
  EXPECT_EQ(other.work.steps, 12U);
}

TEST(Suite, RefusesWhatTheCatalogueHasNot) {
  EXPECT_THROW((void)cells_of(catalogue(), {.only = {"T99"}}), core::CaseError);
  EXPECT_THROW((void)cells_of(catalogue(), {.schemes = {"magic"}}), core::CaseError);
  EXPECT_THROW((void)cells_of(catalogue(), {.naive = {"no_such"}}), core::CaseError);
  EXPECT_THROW((void)cells_of(catalogue(), {.only = {"D1"}, .schemes = {"explicit/limited"}}), core::CaseError);
  EXPECT_EQ(cells_of(catalogue(), {.only = {"T3"}}).size(), 2 * all_schemes().size());  // and T3 rest
}

// Numbers once drawn: a draw that is written down must be drawn again on every machine and by every later program.
TEST(Draws, OfOneSeedAreTheSame) {
  const Draw draw = draw_of(5, 0);
  EXPECT_EQ(draw.of("species"), 1);
  EXPECT_DOUBLE_EQ(draw.of("diameter 1"), 0.00058161832061407999);
  EXPECT_DOUBLE_EQ(draw.of("youngs modulus"), 3917374.7823525895);
  EXPECT_NE(draw_of(5, 3), draw_of(6, 3));
  EXPECT_NE(draw_of(5, 3), draw_of(5, 4));
}

TEST(Draws, StayInTheEnvelope) {
  for (std::uint64_t n = 0; n < 300; ++n) {
    const Draw draw = draw_of(9, n);
    EXPECT_GE(draw.of("species"), 1);
    EXPECT_LE(draw.of("species"), 6);
    EXPECT_GE(draw.of("diameter 1"), 1e-6);
    EXPECT_LE(draw.of("diameter 1"), 0.1);
    EXPECT_LE(draw.of("density 1"), 2e4);
    EXPECT_GE(draw.of("viscosity"), 1e-6);
    EXPECT_LE(draw.of("viscosity"), 1e3);
    EXPECT_LE(draw.of("velocity over u_mf"), 100);
    EXPECT_GE(draw.of("end"), 1e-3);
    EXPECT_LE(draw.of("end"), 4);
  }
}

// What the run loop meets: breakpoints, and checkpoints whose last multiple misses the end of the run by an ulp.
TEST(Draws, HaveTimesThatNearlyMeet) {
  int breakpoints = 0, near_ends = 0;
  for (std::uint64_t n = 0; n < 300; ++n) {
    const Draw draw = draw_of(9, n);
    breakpoints += draw.of("breakpoints") > 0;
    const double end = draw.of("end"), every = draw.of("checkpoint_every") > 0 ? draw.of("checkpoint_every") : end / 10;
    const double nearest = std::round(end / every) * every;
    near_ends += nearest != end && std::abs(nearest - end) <= 2e-16 * end;
  }
  EXPECT_GT(breakpoints, 60);
  EXPECT_GT(near_ends, 3);
}

// Draws whose account of energy did not close when nothing had moved far yet: what was cut to whole units, rounding of
// places, and the first step of a slip that relaxes far within it.
TEST(Draws, CloseTheAccountOfEnergyFromTheFirstStepsOn) {
  constexpr double cpu = 0.2;  // s each; they failed after 64 or 128 steps
  for (const std::uint64_t n : {2, 31, 41, 109, 206}) {
    const Result result = result_of_case(case_text(draw_of(1, n)), "case", cpu);
    EXPECT_EQ(result.outcome, Outcome::pass) << n << ": " << result.broken << " " << result.cause;
    EXPECT_GT(result.work.steps, 128U) << n;
  }
}

// What fails beyond a viscosity of 10 Pa s with two species or more comes down to two species and, by bisection to 5 %
// and two digits, little more than 10 Pa s; all else to its standard.
TEST(Draws, AreShrunkAndStillFail) {
  const auto fails = [](const Draw& draw) { return draw.of("viscosity") > 10 && draw.of("species") >= 2; };
  int shrunk_ones = 0;
  for (std::uint64_t n = 0; n < 50; ++n) {
    const Draw draw = draw_of(3, n);
    if (!fails(draw)) continue;
    const Draw least = shrunk(draw, fails);
    EXPECT_TRUE(fails(least));
    EXPECT_LE(least.size(), draw.size());
    EXPECT_EQ(least.size(), 2);
    EXPECT_EQ(least.of("species"), 2);
    EXPECT_LT(least.of("viscosity"), 10.8);
    ++shrunk_ones;
  }
  EXPECT_GT(shrunk_ones, 3);
}

TEST(Draws, AreOneKindIfOnlyNumbersDiffer) {
  Result one, other;
  one.broken = other.broken = "V16 honest stop";
  one.cause = "t = 0.0025 s: the integrator cannot go on, last step 1.2e-08 s\nmore";
  other.cause = "t = 1 s: the integrator cannot go on, last step 3e-10 s";
  EXPECT_EQ(kind_of(one), kind_of(other));
  EXPECT_EQ(kind_of(one), "V16 honest stop: t = # s: the integrator cannot go on, last step # s");
  other.cause = "crashed: Segmentation fault";
  EXPECT_NE(kind_of(one), kind_of(other));
}

// Kept, read again as a cell and run, a case that is refused is what its folder says of it once that says so.
TEST(Draws, AreKeptAsCellsOfTheSuite) {
  const scenes::Scratch folder;
  Found found{7, draw_of(5, 0), {}};
  found.result.broken = "V5 energy";
  EXPECT_EQ(keep(found, 5, folder.path()).filename(), "001");
  EXPECT_EQ(keep(found, 5, folder.path()).filename(), "002");
  const std::vector<HardCase> cases = kept_cases(folder.path());
  ASSERT_EQ(cases.size(), 2U);
  EXPECT_EQ(cases[1].id, "F002");
  EXPECT_EQ(kept_outcome(folder.path(), "F002"), "PASS");
  std::ofstream(folder.path() / "002" / "expected.toml") << "outcome = \"REFUSED\"\n";
  EXPECT_EQ(kept_outcome(folder.path(), "F002"), "REFUSED");
  std::ofstream(folder.path() / "002" / "case.toml") << "no = \"case\"\n";
  Trial trial(cases[1].schemes.at(0));
  EXPECT_EQ(name_of(trial.judge(cases[1].work).outcome), "REFUSED");
  EXPECT_TRUE(kept_cases(folder.path() / "nowhere").empty());
}

TEST(Expected, IsReadWithWhatIsBroken) {
  const scenes::Scratch folder;
  std::ofstream(folder.path() / "expected.csv") << "case,treatment,outcome,broken\nT1,explicit/limited,PASS,\n"
                                                   "T4,naive x,FAIL,V1 mass; V6 rest, and more\n";
  const Expected expected = read_expected(folder.path() / "expected.csv");
  EXPECT_EQ(expected.size(), 2U);
  EXPECT_EQ(expected.at({"T1", "explicit/limited"}), "PASS");
  EXPECT_EQ(expected.at({"T4", "naive x"}), "FAIL, V1 mass; V6 rest, and more");
  EXPECT_THROW((void)read_expected(folder.path() / "none.csv"), core::FileError);
}

// A row of a case that is no more would stand there for ever, and a cell without a row is never as expected.
TEST(Expected, HasARowForEveryCellAndNoOther) {
  std::set<std::pair<std::string, std::string>> cells, rows;
  for (const Cell& cell : cells_of(catalogue(), {.all = true, .naive = {"all"}}))
    cells.insert({cell.one.id, cell.treatment.name()});
  for (const auto& [key, outcome] : read_expected(POLYBED_SOURCE_DIR "/cases/hard/expected.csv")) rows.insert(key);
  EXPECT_EQ(cells, rows);
  EXPECT_EQ(expected_path().filename(), "expected.csv");
  EXPECT_TRUE(std::filesystem::exists(expected_path()));
}

}  // namespace
}  // namespace polybed::hard
