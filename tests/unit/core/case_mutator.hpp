// Case files as nobody means them: a text changed at random, the same from a seed on any machine, as no distribution of
// the standard library is asked. Half of the changes break what a file is, the others leave its form and change what it
// says, so that what reads and uses a case is reached, too.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/case/keys.hpp"
#include "core/case/registry.hpp"

namespace polybed::core {

class CaseMutator {
 public:
  CaseMutator(std::uint64_t seed, std::vector<Role> roles) : dice_(seed), roles_(std::move(roles)) {}

  [[nodiscard]] std::string changed(const std::string& text);
  [[nodiscard]] std::size_t below(std::size_t n) { return std::size_t(dice_() % n); }

 private:
  // What breaks the form.
  std::string flipped(std::string text);
  std::string with_tokens_swapped(const std::string& text);
  std::string with_odd_ends(std::string text);
  std::string without_a_line(std::string text);
  std::string with_a_line_twice(std::string text);
  // What leaves it.
  std::string with_another_number(const std::string& text, bool odd);
  std::string with_a_key(const std::string& text);
  std::string with_a_law(const std::string& text);

  [[nodiscard]] std::pair<std::size_t, std::size_t> line(const std::string& text);
  [[nodiscard]] std::string value_of(const Key& key);

  std::mt19937_64 dice_;
  std::vector<Role> roles_;
};

}  // namespace polybed::core
