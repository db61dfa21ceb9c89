// Changed case files, in process: each is read or refused with a reason, and what is read comes out whole.
// POLYBED_MUTANTS sets their number; docs/record/stability.md has the result of 100,000 under the sanitizers.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

#include "case_mutator.hpp"
#include "core/case/file.hpp"
#include "core/error.hpp"
#include "shipped_cases.hpp"

namespace polybed::core {
namespace {

/// Roles and laws that the shipped cases name under [effects]: the reader takes them as data, models make them.
std::vector<Role> roles_of(const std::vector<ShippedCase>& cases) {
  std::map<std::string, std::map<std::string, std::string>> laws;
  for (const ShippedCase& one : cases) {
    const std::size_t table = one.text.find("\n[effects]\n");
    if (table == std::string::npos) continue;
    const std::size_t end = std::min(one.text.find("\n[", table + 1), one.text.size());
    for (std::size_t at = one.text.find('\n', table + 1) + 1; at < end; at = one.text.find('\n', at) + 1) {
      const std::string name = one.text.substr(at, one.text.find_first_of(" =", at) - at);
      const std::size_t open = one.text.find('"', at), close = one.text.find('"', open + 1);
      if (open < one.text.find('\n', at)) laws[name][one.text.substr(open + 1, close - open - 1)] = "";
    }
  }
  std::vector<Role> roles;
  for (const auto& [name, of_role] : laws) {
    Role role{name, "tfm, dem", "", "", "", {}};
    for (const auto& [law, help] : of_role) role.laws.push_back({law, help});
    roles.push_back(role);
  }
  return roles;
}

/// A distribution by one class: its least size stands for all.
std::vector<std::pair<double, double>> one_class(const SizeDistribution& given) {
  return {{given.median ? *given.median : given.mean ? *given.mean : given.sieves.front().first, 1.0}};
}

std::size_t mutants() {
  const char* asked = std::getenv("POLYBED_MUTANTS");
  return asked != nullptr ? std::size_t(std::strtoull(asked, nullptr, 10)) : 4000;
}

TEST(CaseMutants, AreReadOrRefusedWithAReason) {
  const std::vector<ShippedCase> from = shipped_cases(POLYBED_SOURCE_DIR "/cases");
  const std::vector<Role> roles = roles_of(from);
  ASSERT_GT(roles.size(), 5U);
  CaseMutator mutator(20261121, roles);
  std::size_t read = 0, refused = 0;
  for (std::size_t n = 0; n < mutants(); ++n) {
    const ShippedCase& seed = from[n % from.size()];
    std::string text = seed.text;
    for (std::size_t k = 1 + mutator.below(3); k-- > 0;) text = mutator.changed(text);
    try {
      const std::string whole = resolved_case(parse_case(text, seed.path, {}, roles, one_class));
      EXPECT_EQ(resolved_case(parse_case(whole, seed.path, {}, roles, one_class)), whole) << "mutant " << n << "\n"
                                                                                          << text;
      ++read;
    } catch (const CaseError& error) {
      EXPECT_NE(std::string(error.what()), "") << "mutant " << n;
      ++refused;
    } catch (const FileError&) {  // a list of particles or a table that is not there
      ++refused;
    }
  }
  fmt::print("{} read, {} refused\n", read, refused);
  EXPECT_GT(read, mutants() / 5) << "the changes leave little to read";
  EXPECT_GT(refused, mutants() / 5) << "the changes hardly change anything";
}

}  // namespace
}  // namespace polybed::core
