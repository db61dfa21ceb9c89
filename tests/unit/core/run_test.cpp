// The loop over events: what an integrator is asked to step to, and that a run which is resumed meets the same events.
#include "core/numerics/run.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>
#include <string>

#include "core/case/scene.hpp"
#include "core/error.hpp"
#include "core/numerics/schedule.hpp"

namespace polybed::core {
namespace {

using ::testing::ElementsAre;

constexpr double ulp = std::numeric_limits<double>::epsilon();

/// Takes steps of one length and refuses, as IDA does, to start towards a stop that round-off alone keeps apart.
class Steps : public Simulation {
 public:
  explicit Steps(double step, double begin = 0) : step_(step), time_(begin) {}
  [[nodiscard]] double time() const override { return time_; }
  void step(double stop) override {
    if (fresh_ && stop - time_ < 4 * ulp * (time_ + stop)) throw NumericsError("IDA_ILL_INPUT");
    if (stop <= time_) throw NumericsError("a stop that is passed");
    fresh_ = false;
    before_ = time_;
    time_ = time_ + step_ >= stop ? stop : time_ + step_;
  }
  void show(double t) override {
    if (t < before_ || t > time_) throw NumericsError("a time outside the last step is shown");
  }
  void restart() override {
    fresh_ = true;
    restarts.push_back(time_);
  }

  std::vector<double> restarts;

 private:
  double step_, time_, before_ = 0;
  bool fresh_ = true;
};

/// What a run did: times of its restarts, checkpoints and rows.
struct Record {
  std::vector<double> restarts, checkpoints, rows;
};

Record record_of(const Stops& stops, double every, double step, double begin = 0) {
  Steps steps(step, begin);
  Record record;
  const Observer rows{"rows", every, [&](double t) { record.rows.push_back(t); }};
  run(
      steps, stops, {rows}, begin == 0, [&](double t) { record.checkpoints.push_back(t); }, [] { return true; });
  record.restarts = steps.restarts;
  return record;
}

TEST(Run, MeetsEveryWholeMillisecondWithTheDefaultPeriods) {
  int apart = 0;
  for (int ms = 1; ms <= 100'000; ++ms) {
    const double until = ms / 1000.0, every = until / 20, checkpoint_every = until / 10;
    apart += 10 * checkpoint_every != until || 20 * every != until;
    const Record record = record_of({until, checkpoint_every, {}}, every, until / 7);
    ASSERT_EQ(record.checkpoints.size(), 10U) << until;
    ASSERT_EQ(record.checkpoints.back(), until);
    ASSERT_EQ(record.restarts.size(), 10U) << until;
    ASSERT_EQ(record.rows.size(), 21U) << until;
    ASSERT_EQ(record.rows.back(), until);
  }
  EXPECT_GT(apart, 1000) << "ends that rounding keeps apart from the last multiple are what is tested";
}

TEST(Run, MeetsBreakpointsAndCheckpointsAsOneEvent) {
  int apart = 0;
  for (int n = 1; n <= 1000; ++n)
    for (const double every : {0.1, 0.01, 0.007, 1.0 / 3}) {
      const double breakpoint = std::strtod(std::to_string(n * every).c_str(), nullptr);
      if (!same_time(breakpoint, n * every)) continue;
      apart += breakpoint != n * every;
      const Record record = record_of({breakpoint + every / 2, every, {breakpoint}}, every, breakpoint);
      ASSERT_EQ(std::count(record.restarts.begin(), record.restarts.end(), breakpoint), 1) << breakpoint;
      ASSERT_EQ(std::count(record.checkpoints.begin(), record.checkpoints.end(), breakpoint), 1) << breakpoint;
      ASSERT_EQ(std::count(record.rows.begin(), record.rows.end(), breakpoint), 1) << breakpoint;
      ASSERT_EQ(record.checkpoints.size(), std::size_t(n) + 1) << breakpoint;
    }
  EXPECT_GT(apart, 100);
}

TEST(Run, StopsAtTheKinkWhereAnEndOrACheckpointIsAnUlpAway) {
  const double checkpoint_every = 0.1, breakpoint = 0.3;
  ASSERT_GT(3 * checkpoint_every, breakpoint);
  const Record across = record_of({0.5, checkpoint_every, {breakpoint}}, 0, 1);
  EXPECT_THAT(across.restarts, ElementsAre(0.1, 0.2, breakpoint, 0.4, 0.5));
  EXPECT_EQ(across.checkpoints, across.restarts);
  for (const double until : {breakpoint * (1 - ulp), breakpoint, breakpoint * (1 + ulp)}) {
    const Record record = record_of({until, checkpoint_every, {breakpoint}}, 0, 1);
    EXPECT_THAT(record.checkpoints, ElementsAre(0.1, 0.2, breakpoint)) << until - breakpoint;
    EXPECT_THAT(record.rows, ElementsAre(0, breakpoint));
  }
}

/// A run that was killed anywhere takes up its last checkpoint and goes on as if nothing had been.
TEST(Run, MeetsTheSameEventsAfterAResume) {
  const Stops stops{1.8, 0.18, {0.3, 0.54, 1.2}};
  const Record whole = record_of(stops, 0.06, 0.05);
  for (std::size_t n = 0; n < whole.checkpoints.size(); ++n) {
    const double begin = whole.checkpoints[n];
    const auto rest = [&](const std::vector<double>& times) {
      return std::vector<double>(std::upper_bound(times.begin(), times.end(), begin), times.end());
    };
    const Record resumed = record_of(stops, 0.06, 0.05, begin);
    EXPECT_EQ(resumed.restarts, rest(whole.restarts)) << begin;
    EXPECT_EQ(resumed.checkpoints, rest(whole.checkpoints)) << begin;
    EXPECT_EQ(resumed.rows, rest(whole.rows)) << begin;
  }
}

TEST(Run, TakesNoStepFromACheckpointAnUlpBeforeTheEnd) {
  EXPECT_TRUE(record_of({1.8, 0.18, {}}, 0.09, 0.1, 10 * 0.18).restarts.empty());
}

/// The same steps of a model that has no state inside them.
class WholeSteps : public Steps {
 public:
  using Steps::Steps;
  [[nodiscard]] bool shows_inside_steps() const override { return false; }
};

// Steps of 0.25 s: rows every 0.1 s become one a step with its time, those every 0.5 s stay, and tables of a model that
// interpolates have all of them.
TEST(Run, WritesOneRowAStepWhereAModelHasNoStateInsideSteps) {
  const auto rows_of = [](Simulation& simulation, double every) {
    std::vector<double> rows;
    run(
        simulation, {1, 0, {}}, {{"rows", every, [&](double t) { rows.push_back(t); }}}, true, [](double) {},
        [] { return true; });
    return rows;
  };
  WholeSteps dense(0.25), sparse(0.25);
  EXPECT_THAT(rows_of(dense, 0.1), ElementsAre(0, 0.25, 0.5, 0.75, 1));
  EXPECT_THAT(rows_of(sparse, 0.5), ElementsAre(0, 0.5, 1));
  Steps shown(0.25);
  EXPECT_EQ(rows_of(shown, 0.1).size(), 11U);
}

/// A run of two steps of 1 s with outputs every 10 ms whose user wants to stop once a number of rows is written.
std::string told_of_a_stop(double until, std::size_t rows, Record& record) {
  Steps steps(1);
  const auto note = [&](double t) { record.rows.push_back(t); };
  try {
    run(
        steps, {until, 0, {}}, {{"rows", 0.01, note}, {"fields", 0.01, note}}, false,
        [&](double t) { record.checkpoints.push_back(t); }, [&] { return record.rows.size() < rows; },
        [&] { return record.rows.size() >= rows; });
  } catch (const Stopped& stopped) {
    return stopped.what();
  }
  return "";
}

TEST(Run, StopsBetweenTheOutputsOfAStep) {
  Record record;
  EXPECT_THAT(told_of_a_stop(2, 5, record), ::testing::HasSubstr("without the outputs from 0.06 s on"));
  EXPECT_THAT(record.rows, ElementsAre(0.01, 0.02, 0.03, 0.04, 0.05));
  EXPECT_THAT(record.checkpoints, ElementsAre(1.0));
}

TEST(Run, ShowsItsEndEvenIfItIsStoppedBetweenOutputs) {
  Record record;
  EXPECT_THAT(told_of_a_stop(1, 3, record), ::testing::HasSubstr("without the outputs from 0.04 s on"));
  EXPECT_THAT(record.rows, ElementsAre(0.01, 0.02, 0.03, 1.0, 1.0));
  EXPECT_THAT(record.checkpoints, ElementsAre(1.0));
}

TEST(Run, LeavesNothingOutIfItIsStoppedAfterTheLastOutput) {
  Record record;
  EXPECT_EQ(told_of_a_stop(2, 200, record), "stopped by the user; a checkpoint has been written");
  EXPECT_EQ(record.rows.size(), 200U);
}

TEST(Schedule, CountsMultiplesFromATimeThatIsOneUpToRounding) {
  EXPECT_EQ(next_multiple(0.1, 0), 0.1);
  EXPECT_EQ(next_multiple(0.1, 0.3), 0.4);  // 3 * 0.1 is later by an ulp
  EXPECT_EQ(next_multiple(0.18, 1.8), 11 * 0.18);
  EXPECT_EQ(next_multiple(0.1, 0.3 - 1e-10), 3 * 0.1);
  EXPECT_EQ(next_multiple(0, 3), std::numeric_limits<double>::infinity());
}

TEST(Schedule, JoinsTimesOfTablesThatRoundingKeepsApart) {
  Scene scene;
  scene.inlet.superficial_velocity = {{0, 1}, {0.3, 1}, {3 * 0.1, 2}, {0.3 + 1e-9, 3}};
  scene.jets.resize(1);
  scene.jets[0].superficial_velocity = {{3 * 0.1, 4}, {1, 5}};
  join_times(scene);
  const std::vector<std::pair<double, double>> inlet{{0, 1}, {0.3, 1}, {0.3, 2}, {0.3 + 1e-9, 3}},
      jet{{0.3, 4}, {1, 5}};
  EXPECT_EQ(scene.inlet.superficial_velocity, inlet);
  EXPECT_EQ(scene.jets[0].superficial_velocity, jet);
}

}  // namespace
}  // namespace polybed::core
