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
    Scope(Term* term, std::uint64_t weight)
        : term_(term), weight_(weight), begin_(term != nullptr ? cpu_seconds() : 0) {}
    ~Scope() {
      if (term_ == nullptr) return;
      term_->seconds += double(weight_) * (cpu_seconds() - begin_);
      term_->calls += weight_;
    }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Term* term_;
    std::uint64_t weight_;
    double begin_;
  };

  Timers() { terms_.reserve(most_terms); }
  Timers(const Timers&) = delete;
  Timers& operator=(const Timers&) = delete;

  /// Starts timing a term; creates it at its first use, in the order of first uses.
  /// \param weight  number of calls that this one represents; 0: not timed, as reading the clock is a system call
  [[nodiscard]] Scope scope(std::string_view name, std::uint64_t weight = 1) {
    return Scope(weight > 0 ? &term(name) : nullptr, weight);
  }
  [[nodiscard]] const std::vector<Term>& terms() const { return terms_; }
  /// CPU time of a term so far, s; 0 if it has not been timed.
  [[nodiscard]] double seconds(std::string_view name) const;

 private:
  static constexpr std::size_t most_terms = 64;  ///< fixed, so that terms never move while a scope points to one
  Term& term(std::string_view name);
  std::vector<Term> terms_;
};

}  // namespace polybed::core
