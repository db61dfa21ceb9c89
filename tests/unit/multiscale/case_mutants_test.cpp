// Changed case files beyond their reading (tests/unit/core/case_mutants_test.cpp): what is read is weighed, and, if it
// is small, begins to run, or is refused with a reason. POLYBED_MUTANTS sets their number.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <numeric>
#include <string>
#include <vector>

#include "../core/case_mutator.hpp"
#include "../core/shipped_cases.hpp"
#include "core/case/file.hpp"
#include "core/error.hpp"
#include "core/timers.hpp"
#include "dem/model.hpp"
#include "multiscale/particle_requirements.hpp"
#include "multiscale/roles.hpp"
#include "multiscale/scene_rules.hpp"
#include "tfm/model.hpp"

namespace polybed::multiscale {
namespace {

using Seed = core::ShippedCase;

std::size_t mutants() {
  const char* asked = std::getenv("POLYBED_MUTANTS");
  return asked != nullptr ? std::size_t(std::strtoull(asked, nullptr, 10)) : 2000;
}

/// What came of them.
struct Count {
  std::size_t read = 0, refused = 0, weighed = 0, begun = 0, refused_later = 0;
};

/// A step of either model, if it takes milliseconds.
bool begins(const core::Scene& scene) {
  constexpr double most_cells = 1500, most_particles = 150;
  const double cells = double(scene.column.cells[0]) * scene.column.cells[1] * scene.column.cells[2];
  if (cells > most_cells) return false;
  core::Timers timers;
  if (rules_of_tfm().problems(scene).empty()) {
    tfm::Model model(scene, timers);
    model.step(scene.run.until);
    return true;
  }
  if (!rules_of_dem().problems(scene).empty()) return false;
  if (double(particle_requirements_of(scene).count()) > most_particles) return false;
  dem::Model model(scene, timers);
  model.step(scene.run.until);
  return true;
}

/// Of what is refused after reading: each problem has its place in the case.
void expect_places(const core::CaseError& error) {
  EXPECT_FALSE(error.problems().empty()) << error.what();
  for (const core::CaseProblem& problem : error.problems()) EXPECT_GT(problem.line, 0) << problem.text();
}

/// As the commands do after reading: the choice of effects, the model. Refusals are theirs to tell.
void use(const core::Scene& scene, bool step, Count& count) {
  core::Scene chosen;
  try {
    chosen = with_choice(scene);
    ++count.weighed;
    refuse(chosen, either_model());  // what is chosen beside what is given
  } catch (const core::CaseError& error) {
    expect_places(error);
    ++count.refused_later;
    return;
  }
  try {
    if (step) count.begun += begins(chosen);
  } catch (const core::StartError& error) {  // no other error of a case: it has kept every rule
    expect_places(error);
    ++count.refused_later;
  } catch (const core::NumericsError& error) {
    EXPECT_NE(std::string(error.what()), "");
    ++count.refused_later;
  }
}

void read(const std::string& text, const Seed& seed, bool step, Count& count) {
  try {
    const std::vector<core::Role> roles = all_roles();
    const core::Scene scene = core::parse_case(text, seed.path, {}, roles, size_classes,
                                               core::Rulebook(scene_rules(), either_model()), core::OtherRoles::chosen);
    ++count.read;
    const std::string whole = core::resolved_case(scene);
    EXPECT_EQ(core::resolved_case(core::parse_case(whole, seed.path, {}, roles, size_classes)), whole) << text;
    use(scene, step, count);
  } catch (const core::CaseError& error) {
    EXPECT_NE(std::string(error.what()), "");
    ++count.refused;
  } catch (const core::FileError&) {  // a list of particles or a table that is not there
    ++count.refused;
  }
}

TEST(CaseMutants, AreReadOrRefusedWithAReason) {
  const std::vector<Seed> from = core::shipped_cases(POLYBED_SOURCE_DIR "/cases");
  core::CaseMutator mutator(20261121, all_roles());
  Count count;
  constexpr std::size_t step_every = 7;  // no divisor of the number of seeds: each is stepped in its turn
  for (std::size_t n = 0; n < mutants(); ++n) {
    const Seed& seed = from[n % from.size()];
    std::string text = seed.text;
    for (std::size_t k = 1 + mutator.below(3); k-- > 0;) text = mutator.changed(text);
    const double begin = core::cpu_seconds();
    ASSERT_NO_THROW(read(text, seed, n % step_every == 0, count)) << "mutant " << n << "\n" << text;
    constexpr double longest = 60;  // CPU s: a step of a small case takes milliseconds, under sanitizers a hundred
    EXPECT_LT(core::cpu_seconds() - begin, longest) << "mutant " << n << "\n" << text;
  }
  fmt::print("{} read, {} refused; of those read {} weighed, {} begun, {} refused by what uses them\n", count.read,
             count.refused, count.weighed, count.begun, count.refused_later);
  EXPECT_GT(count.read, mutants() / 5) << "the changes leave little to read";
  EXPECT_GT(count.weighed, mutants() / 8) << "what is read is hardly used";
  EXPECT_GT(count.begun, mutants() / 200) << "hardly any begins to run";
  EXPECT_GT(count.refused, mutants() / 5) << "the changes hardly change anything";
}

}  // namespace
}  // namespace polybed::multiscale
