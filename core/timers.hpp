// CPU time by term of the equations. One object per run; no global state.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace polybed::core {

/// CPU time of this process, s.
[[nodiscard]] double cpu_seconds();

class Timers {
 public:
  struct Term {
    std::string name;
    double seconds = 0;
    std::uint64_t calls = 0;
  };

  /// Adds the time until its end to a term.
  class Scope {
   public:
    explicit Scope(Term& term) : term_(term), begin_(cpu_seconds()) {}
    ~Scope() {
      term_.seconds += cpu_seconds() - begin_;
      ++term_.calls;
    }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Term& term_;
    double begin_;
  };

  Timers() { terms_.reserve(most_terms); }
  Timers(const Timers&) = delete;
  Timers& operator=(const Timers&) = delete;

  /// Starts timing a term; made at its first use, in the order of first uses.
  [[nodiscard]] Scope scope(std::string_view name) { return Scope(term(name)); }
  [[nodiscard]] const std::vector<Term>& terms() const { return terms_; }

 private:
  static constexpr std::size_t most_terms = 64;  ///< so that terms never move while a scope holds one
  Term& term(std::string_view name);
  std::vector<Term> terms_;
};

}  // namespace polybed::core
