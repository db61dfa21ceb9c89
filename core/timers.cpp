#include "core/timers.hpp"

#include <ctime>
#include <stdexcept>

namespace polybed::core {

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

Timers::Term& Timers::term(std::string_view name) {
  for (Term& t : terms_)
    if (t.name == name) return t;
  if (terms_.size() == most_terms) throw std::length_error("too many timed terms");
  terms_.push_back({std::string(name), 0, 0});
  return terms_.back();
}

double Timers::seconds(std::string_view name) const {
  for (const Term& t : terms_)
    if (t.name == name) return t.seconds;
  return 0;
}

}  // namespace polybed::core
