// The errors of the program, one type per exit code, and the place of a problem in a case file.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace polybed::core {

/// Exit codes of the program; scripts rely on them.
enum class ExitCode : int { done = 0, wrong_case = 2, numerics = 3, file = 4, mpi = 5, stopped = 130 };

/// One problem in a case file: its place, and how to correct it.
struct CaseProblem {
  std::string file;     ///< as given on the command line; "--set" for an override; empty: no file was read
  int line = 0;         ///< 1-based; 0 without a place (a missing table)
  int column = 0;       ///< 1-based
  std::string message;  ///< key, value, allowed range with unit, suggestion

  /// file:line:column: message, without the unknown parts.
  [[nodiscard]] std::string text() const {
    std::string place = file;
    if (line > 0) place += ":" + std::to_string(line) + ":" + std::to_string(column);
    return place.empty() ? message : place + ": " + message;
  }
};

/// The case or the command is wrong. Contains all its problems (exit code 2).
class CaseError : public std::runtime_error {
 public:
  explicit CaseError(std::vector<CaseProblem> problems)
      : std::runtime_error(join(problems)), problems_(std::move(problems)) {}
  explicit CaseError(const std::string& message) : std::runtime_error(message) {}
  [[nodiscard]] const std::vector<CaseProblem>& problems() const { return problems_; }

 private:
  static std::string join(const std::vector<CaseProblem>& problems) {
    std::string text;
    for (const auto& p : problems) text += (text.empty() ? "" : "\n") + p.text();
    return text;
  }
  std::vector<CaseProblem> problems_;
};

/// An error in a case that satisfies every rule, found only when the start is made: particles that cannot be packed, a
/// column that cannot be divided, a table or a list that does not fit (exit code 2).
class StartError : public CaseError {
 public:
  using CaseError::CaseError;
};

/// The computation failed: the text contains time, place, values and a hint (exit code 3).
class NumericsError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A conservation law is violated far beyond its limit; a permissive run continues (exit code 3).
class ConservationError : public NumericsError {
  using NumericsError::NumericsError;
};

/// A file could not be read or written (exit code 4).
class FileError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// MPI failed or does not support a request (exit code 5).
class MpiError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The user stopped the run; a checkpoint has been written (exit code 130).
class Stopped : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace polybed::core
