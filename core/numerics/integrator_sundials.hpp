// Common parts of the SUNDIALS integrators: context, errors, and exceptions, which must not cross the library.
#pragma once

#include <sundials/sundials_context.h>

#include <exception>
#include <span>
#include <string>

#include "core/numerics/integrator.hpp"

namespace polybed::core {

/// Throws NumericsError if a call returned a negative flag. \param call  its name
void require_success(int flag, const char* call);

/// A SUNDIALS context: one per integrator, so that there is no global state.
class Context {
 public:
  Context() { require_success(SUNContext_Create(nullptr, &context_), "SUNContext_Create"); }
  ~Context() { SUNContext_Free(&context_); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  operator SUNContext() const { return context_; }

 private:
  SUNContext context_ = nullptr;
};

/// Runs a callback's work and stores its exception for the caller, as none may cross the C library.
template <class Work>
int guarded(std::exception_ptr& kept, Work&& work) {
  try {
    return work() == Rate::ok ? 0 : 1;
  } catch (...) {
    kept = std::current_exception();
    return -1;
  }
}

/// Suppresses the library's own messages: its return values become our errors.
void keep_silent(int, const char*, const char*, char*, void*);

/// Adds the weighted local error of the last step to a report: the norm over all ranks, the worst entry on this one.
/// Collective. \param error, weight  for this rank's entries
void report_error(std::span<const double> error, std::span<const double> weight, const Ranks* ranks,
                  StepReport& report);

/// The name of a flag from the library's own function.
[[nodiscard]] std::string flag_name(char* (*name)(long int), int flag);

}  // namespace polybed::core
