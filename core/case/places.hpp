// Positions of keys and tables in a case file, for reports of problems.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace polybed::core {

struct Place {
  std::string file;  ///< file name, or the override on the command line, which has no line
  int line = 0, column = 0;
};

class Places {
 public:
  Places() = default;
  /// \param file  the name of the case in messages
  explicit Places(std::string file) : file_(std::move(file)) {}

  /// Adds a key by its path, "jet.from", or a table by its name. Returns false if an entry of the array has it already.
  /// \param entry  index in an array of tables, else 0
  bool add(const std::string& path, std::size_t entry, Place place);
  [[nodiscard]] bool has(const std::string& path) const { return at_.contains(path); }

  /// A problem at the first of these keys that the case gives, else at the first of their tables, else at the file as a
  /// whole. \param entry  in the first key's array of tables; a key in several entries has a place only with it
  [[nodiscard]] CaseProblem problem(std::span<const std::string> keys, std::string message,
                                    std::optional<std::size_t> entry = {}) const;
  [[nodiscard]] CaseProblem problem(std::initializer_list<std::string> keys, std::string message) const {
    return problem(std::vector<std::string>(keys), std::move(message), {});
  }

 private:
  /// Null if there is none.
  [[nodiscard]] const Place* find(const std::string& path, std::size_t entry) const;
  [[nodiscard]] const Place* of_entry(std::span<const std::string> keys, std::size_t entry) const;
  [[nodiscard]] const Place* of_any(std::span<const std::string> keys) const;

  std::string file_;
  std::map<std::string, std::map<std::size_t, Place>> at_;
};

}  // namespace polybed::core
