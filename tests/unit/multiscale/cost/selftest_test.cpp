#include "multiscale/cost/selftest.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "multiscale/cost/check.hpp"
#include "multiscale/cost/judge.hpp"
#include "multiscale/cost/work.hpp"

namespace polybed::multiscale {
namespace {

TEST(Selftest, EveryOraclePasses) {
  for (const Oracle& o : pure_oracles()) EXPECT_TRUE(o.passed) << o.id << ": " << o.found << ", wanted " << o.wanted;
}

// Two references 0.1 % apart have a floor of 1 %: good for a target of 1 %, or for an error above it; not for less.
TEST(Reference, CarriesWhatLiesAboveTenTimesItsDisagreement) {
  EXPECT_TRUE(carries(0.001, {0.002}, 0.01));
  EXPECT_TRUE(carries(0.002, {0.03}, 0.01));
  EXPECT_FALSE(carries(0.002, {0.019, 0.001}, 0.01));
  EXPECT_FALSE(carries(0.002, {}, 0.01));
}

core::JsonValue sweep(const std::string& runs) {
  return core::parse_json(R"({"case_hash": "a", "clock": "work", "work_version": 1, "qoi": [{"id": "bed_height",
    "shown": true}], "runs": [)" +
                          runs + "]}");
}

std::string run(double error, double cost, const std::string& status) {
  return R"({"kind": "candidate", "status": ")" + status + R"(", "s_per_sim_s": )" + std::to_string(cost) +
         R"(, "qoi": {"bed_height": {"error": )" + std::to_string(error) + "}}}";
}

TEST(CostDiff, TellsWhatTheSameErrorCostsMore) {
  const core::JsonValue before = sweep(run(0.01, 1, "pareto") + "," + run(0.002, 5, "pareto"));
  EXPECT_TRUE(dearer(before, before).empty());
  EXPECT_TRUE(dearer(before, sweep(run(0.002, 1.09, "pareto"))).empty()) << "9 % dearer, and more accurate";
  const auto found = dearer(before, sweep(run(0.01, 1.2, "pareto") + "," + run(0.02, 0.5, "pareto")));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].now, 1.2);
  EXPECT_EQ(found[1].now, 0) << "no run is as accurate";
  const core::JsonValue other =
      core::parse_json(R"({"case_hash": "b", "clock": "work", "work_version": 1, "qoi": [], "runs": []})");
  EXPECT_THROW((void)dearer(before, other), core::FileError);
}

// 1000 right-hand sides of 100 unknowns at 23 ns and 500 iterations at 8 ns: 2.3 ms and 0.4 ms.
TEST(Work, IsWeighedInSeconds) {
  const core::JsonValue record = core::parse_json(R"({"model": "tfm", "unknowns": 100, "work": {"steps": 7,
    "rejected_steps": 0, "rhs_evaluations": 1000, "pressure_solves": 3, "linear_iterations": 500}})");
  EXPECT_NEAR(weighed(counters_of(record, 0)), 2.7e-3, 1e-15);
  const core::JsonValue implicit = core::parse_json(R"({"model": "tfm", "unknowns": 100, "work": {"steps": 7,
    "rejected_steps": 0, "rhs_evaluations": 1000, "pressure_solves": 0, "linear_iterations": 500}})");
  EXPECT_NEAR(weighed(counters_of(implicit, 0)), 2.3e-3 + 4.5e-3, 1e-15);  // Jacobian products at 90 ns
}

}  // namespace
}  // namespace polybed::multiscale
