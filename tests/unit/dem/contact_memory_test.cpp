// What is kept of contacts while steps go by: nothing of those that have parted.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/case/file.hpp"
#include "dem/model.hpp"

namespace polybed::dem {
namespace {

/// A crowd in a closed box with walls.
core::Scene crowd() {
  return core::parse_case(
      "[column]\nsize = [0.01, 0.01, 0.01]\ncells = [4, 4, 4]\n[fluid]\nname = \"none\"\n"
      "[[species]]\nname = \"a\"\ndiameter = 0.001\ndensity = 2500\n[bed]\nparticles = [400]\nstart = \"random\"\n"
      "solids_fraction = 0.6\n[effects]\ncontact = \"hertz_mindlin\"\n[dem]\nstart_speed = 0.3\ngreatest_speed = "
      "2\nyoungs_modulus = 5e7\n"
      "[run]\nuntil = 1\n",
      "case.toml", {}, roles());
}

/// Pairs with a memory that is not zero although they do not touch.
std::size_t remembered_without_reason(const Contacts& contacts) {
  std::size_t found = 0;
  for (std::int32_t p = 0; p < std::int32_t(contacts.pairs.size()); ++p) {
    const double* memory = contacts.memory_of(p);
    const bool any = std::any_of(memory, memory + contacts.memory_size, [](double m) { return m != 0; });
    found += any && !std::binary_search(contacts.touching.begin(), contacts.touching.end(), p) ? 1 : 0;
  }
  return found;
}

TEST(ContactMemory, IsForgottenWhenAPairParts) {
  core::Timers timers;
  Model model(crowd(), timers);
  std::size_t parted = 0, at_walls = 0;
  for (int n = 0; n < 400; ++n) {
    const std::vector<std::int32_t> before = model.pairs().touching;
    const std::uint64_t lists = model.work().rebuilds;
    model.step(1);
    for (const Contacts* contacts : {&model.pairs(), &model.walls()}) {
      EXPECT_EQ(remembered_without_reason(*contacts), 0) << "step " << n;
      EXPECT_TRUE(std::is_sorted(contacts->touching.begin(), contacts->touching.end()));
    }
    at_walls += model.walls().touching.size();
    if (model.work().rebuilds != lists) continue;
    const auto& now = model.pairs().touching;
    for (const std::int32_t p : before) parted += std::binary_search(now.begin(), now.end(), p) ? 0 : 1;
  }
  EXPECT_GT(parted, 100);  // so that there was something to forget
  EXPECT_GT(at_walls, 100);
}

}  // namespace
}  // namespace polybed::dem
