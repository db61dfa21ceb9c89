// Case files as nobody means them, in process: each is read or refused with a reason, and what is read comes out whole.
// POLYBED_MUTANTS sets their number; docs/stability.md has the result of 100,000 under the sanitizers.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "core/case_file.hpp"
#include "core/error.hpp"

namespace polybed::core {
namespace {

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> seeds() {
  std::vector<std::string> texts;
  for (const char* name : {"matsuura-akehata", "thesis-b", "classifier", "shear-box", "bounce-and-roll", "taghipour"})
    texts.push_back(text_of(std::string(POLYBED_SOURCE_DIR "/cases/") + name + "/case.toml"));
  return texts;
}

/// Changes texts at random, the same from a seed on any machine: no distribution of the standard library is asked.
class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : dice_(seed) {}

  std::string changed(std::string text) {
    if (text.empty()) return text;
    switch (below(8)) {
      case 0:
        return flipped(text);
      case 1:
        return with_tokens_swapped(text);
      case 2:
      case 3:
        return with_another_number(text);
      case 4:
        return without_a_line(text);
      case 5:
        return with_a_line_twice(text);
      case 6:
        return text.substr(0, below(text.size()));
      default:
        return with_odd_ends(text);
    }
  }
  std::size_t below(std::size_t n) { return std::size_t(dice_() % n); }

 private:
  std::string flipped(std::string text) {
    for (std::size_t n = 1 + below(4); n-- > 0;) text[below(text.size())] ^= char(1 << below(8));
    return text;
  }
  std::string with_tokens_swapped(const std::string& text) {
    std::vector<std::pair<std::size_t, std::size_t>> tokens;
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find_first_of(" \n=,[]", begin), text.size());
      if (end > begin) tokens.emplace_back(begin, end - begin);
      begin = end + 1;
    }
    if (tokens.size() < 2) return text;
    auto a = tokens[below(tokens.size())], b = tokens[below(tokens.size())];
    if (a.first > b.first) std::swap(a, b);
    if (a == b) return text;
    return text.substr(0, a.first) + text.substr(b.first, b.second) +
           text.substr(a.first + a.second, b.first - a.first - a.second) + text.substr(a.first, a.second) +
           text.substr(b.first + b.second);
  }
  std::string with_another_number(const std::string& text) {
    static const std::vector<std::string> odd{"nan",
                                              "inf",
                                              "-inf",
                                              "0",
                                              "-0.0",
                                              "-1",
                                              "1e308",
                                              "-1e308",
                                              "1e-308",
                                              "1e400",
                                              "5e-324",
                                              "9223372036854775807",
                                              "-9223372036854775808",
                                              "99999999999999999999",
                                              "0x7fffffffffffffff",
                                              "\"\"",
                                              "[]",
                                              "[[]]",
                                              "{}",
                                              "true",
                                              "2026-11-21",
                                              "\"1e400 mm\"",
                                              "\"mm\"",
                                              "1_000_000",
                                              "0.1e"};
    const std::size_t begin = text.find_first_of("0123456789", below(text.size()));
    if (begin == std::string::npos) return text;
    const std::size_t end = std::min(text.find_first_not_of("0123456789.e-+", begin), text.size());
    return text.substr(0, begin) + odd[below(odd.size())] + text.substr(end);
  }
  std::pair<std::size_t, std::size_t> line(const std::string& text) {
    const std::size_t at = below(text.size()), before = text.rfind('\n', at == 0 ? 0 : at - 1);
    const std::size_t begin = before == std::string::npos ? 0 : before + 1;
    return {begin, std::min(text.find('\n', begin), text.size() - 1) + 1 - begin};
  }
  std::string without_a_line(std::string text) {
    const auto [begin, size] = line(text);
    return text.erase(begin, size);
  }
  std::string with_a_line_twice(std::string text) {
    const auto [begin, size] = line(text);
    const std::string copy = text.substr(begin, size);
    return text.insert(line(text).first, copy);
  }
  std::string with_odd_ends(const std::string& text) {
    std::string out;
    const std::size_t kind = below(3);
    if (kind == 0) {
      for (const char c : text) out += c == '\n' ? std::string("\r\n") : std::string(1, c);
      return out;
    }
    out = text;
    return out.insert(below(text.size()), std::string(1 + below(5), kind == 1 ? '\0' : '\r'));
  }

  std::mt19937_64 dice_;
};

std::size_t mutants() {
  const char* asked = std::getenv("POLYBED_MUTANTS");
  return asked != nullptr ? std::size_t(std::strtoull(asked, nullptr, 10)) : 4000;
}

TEST(CaseMutants, AreReadOrRefusedWithAReason) {
  const std::vector<Role> roles;  // laws of [effects] belong to the models: whatever stands there is refused here
  const std::vector<std::string> texts = seeds();
  Mutator mutator(20261121);
  std::size_t read = 0, refused = 0;
  for (std::size_t n = 0; n < mutants(); ++n) {
    std::string text = texts[n % texts.size()];
    const std::size_t effects = text.find("[effects]");  // half without, so that some are read
    if (n % 2 == 0 && effects != std::string::npos)
      text.erase(effects, std::min(text.find("\n[", effects + 1), text.size()) - effects);
    for (std::size_t k = 1 + mutator.below(3); k-- > 0;) text = mutator.changed(text);
    try {
      const Scene scene = parse_case(text, "case.toml", {}, roles, {});
      const std::string whole = resolved_case(scene);
      EXPECT_EQ(resolved_case(parse_case(whole, "case.toml", {}, roles, {})), whole) << "mutant " << n << "\n" << text;
      ++read;
    } catch (const CaseError& error) {
      EXPECT_NE(std::string(error.what()), "") << "mutant " << n;
      ++refused;
    } catch (const FileError&) {  // a list of particles that is not there
      ++refused;
    }
  }
  RecordProperty("read", fmt::format("{}", read));
  RecordProperty("refused", fmt::format("{}", refused));
  fmt::print("{} read, {} refused\n", read, refused);
  EXPECT_GT(read, mutants() / 100) << "the changes leave nothing to read";
  EXPECT_GT(refused, mutants() / 4) << "the changes hardly change anything";
}

}  // namespace
}  // namespace polybed::core
