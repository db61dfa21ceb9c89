// The catalogue as tests: every case with every scheme has the outcome that expected.csv states, and every textbook
// treatment fails where the product passes. Figures go to the test's report, from which docs/stability.md is written.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include "stability/hard_case.hpp"
#include "stability/scenes.hpp"

namespace polybed::stability {
namespace {

struct Planned : std::pair<HardCase, Treatment> {
  using pair::pair;
  friend void PrintTo(const Planned& planned, std::ostream* out) {
    *out << planned.first.id << " " << planned.second.name();
  }
};

std::vector<Planned> plan(const std::vector<HardCase>& cases) {
  std::vector<Planned> planned;
  for (const HardCase& one : cases) {
    for (const Treatment& scheme : one.schemes) planned.emplace_back(one, scheme);
    for (const std::string& name : one.naive) planned.emplace_back(one, Treatment{"explicit", "limited", name});
  }
  return planned;
}

std::string test_name(const testing::TestParamInfo<Planned>& info) {
  std::string name = info.param.first.id + "_" + info.param.second.name();
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
}

/// case and treatment to outcome and what is beyond its limit, of the committed table.
std::map<std::pair<std::string, std::string>, std::string> expected_outcomes() {
  std::ifstream file(POLYBED_SOURCE_DIR "/tests/stability/expected.csv");
  std::map<std::pair<std::string, std::string>, std::string> expected;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream row(line);
    std::string id, treatment, outcome, broken;
    std::getline(row, id, ',');
    std::getline(row, treatment, ',');
    std::getline(row, outcome, ',');
    std::getline(row, broken);
    expected[{id, treatment}] = broken.empty() ? outcome : outcome + ", " + broken;
  }
  return expected;
}

void record(const HardCase& one, const Treatment& treatment, const Result& result) {
  const auto put = [](const char* key, const std::string& value) { testing::Test::RecordProperty(key, value); };
  put("case", one.id);
  put("title", one.title);
  put("treatment", treatment.name());
  put("outcome", name_of(result.outcome));
  put("broken", result.broken);
  put("worst", result.worst.id);
  put("value", fmt::format("{:.2g}", result.worst.value));
  put("limit", fmt::format("{:.2g}", result.worst.limit));
  put("share", fmt::format("{:.2g}", result.worst.share()));
  put("least_step", fmt::format("{:.2g}", result.least_step));
  put("steps", fmt::format("{}", result.work.steps));
  put("rejected", fmt::format("{}", result.work.rejected_steps));
  put("cpu", fmt::format("{:.2f}", result.cpu));
  put("cause", result.cause);
  put("reported", result.reported);
}

class Hard : public testing::TestWithParam<Planned> {};

TEST_P(Hard, HasItsOutcome) {
  const auto& [one, treatment] = GetParam();
  Trial trial(treatment);
  const Result result = trial.judge(one.work);
  record(one, treatment, result);
  const std::string found = name_of(result.outcome) + (result.broken.empty() ? "" : ", " + result.broken);
  const std::string figures =
      fmt::format("worst: {} = {:.3g}, limit {:.3g}; least step {:.3g} s, {} steps, {} rejected; {}", result.worst.id,
                  result.worst.value, result.worst.limit, result.least_step, result.work.steps,
                  result.work.rejected_steps, result.cause);
  fmt::print("{} {} {} {:.2f} s; {}\n", one.id, treatment.name(), found, result.cpu, figures);
  const auto expected = expected_outcomes();
  const auto row = expected.find({one.id, treatment.name()});
  ASSERT_NE(row, expected.end()) << "not in expected.csv: " << found << "; " << figures;
  EXPECT_EQ(found, row->second) << figures;
  if (!treatment.naive.empty()) {
    EXPECT_TRUE(result.outcome == Outcome::fail || result.outcome == Outcome::refused)
        << "the textbook treatment passes: the case is not hard";
  }
}

// The runs that textbook treatments ride on are sound: without a treatment they do as the product does, over a jump of
// the inlet, too. Round-off of steps of one length; Newton's tolerance where steps differ.
TEST(Naive, RunsWithoutATreatmentDoAsTheProduct) {
  for (const std::string integrator : {"explicit", "implicit"}) {
    core::Scene scene = two_species(30, 0.09, false);
    scene.inlet.superficial_velocity = {{0.0, 0.02}, {0.05, 0.02}, {0.05, 0.03}};
    scene.bed.static_height = 0.03;
    scene.bed.start_solids_fraction = 0.5;
    if (integrator == "explicit") scene.tfm.fixed_step = 5e-4;
    Trial product({integrator, "limited", ""}), other({integrator, "limited", "nothing " + integrator});
    const auto a = product.begin(scene), b = other.begin(scene);
    product.advance(*a, 0.1);
    other.advance(*b, 0.1);
    const fluid::Profile one = profile_of(*a), two = profile_of(*b);
    for (std::size_t k = 0; k < one.slabs(); ++k)
      EXPECT_NEAR(one.fraction[0][k], two.fraction[0][k], integrator == "explicit" ? 1e-9 : 1e-4) << integrator;
  }
}

// Momenta as unknowns are no mistake in themselves: where there are solids everywhere they give the same.
TEST(Naive, MomentaAsUnknownsWorkWhereNothingVanishes) {
  core::Scene scene = uniform_bed(1e-3, 2200, 998.207, 1.00157e-3, 0.36, 30, 0.09);
  scene.inlet.superficial_velocity = {{0.0, 0.035}};
  Trial product({"implicit", "limited", ""}), other({"implicit", "limited", "divide_by_phi"});
  const auto a = product.begin(scene), b = other.begin(scene);
  product.advance(*a, 0.1);
  other.advance(*b, 0.1);
  const fluid::Profile one = profile_of(*a), two = profile_of(*b);
  for (std::size_t k = 0; k < one.slabs(); ++k) EXPECT_NEAR(one.fraction[0][k], two.fraction[0][k], 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Short, Hard, testing::ValuesIn(plan(short_cases())), test_name);
INSTANTIATE_TEST_SUITE_P(Long, Hard, testing::ValuesIn(plan(long_cases())), test_name);

}  // namespace
}  // namespace polybed::stability
