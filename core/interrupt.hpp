// The user's wish to stop: Ctrl-C, a termination request or a closed terminal, noted and asked for between steps.
#pragma once

#include <vector>

namespace polybed::core {

/// The signals that ask a run to stop: SIGINT, SIGTERM, SIGUSR1, which mpirun passes on without a time limit, and
/// SIGHUP unless this process was started to outlive its terminal, as by nohup.
[[nodiscard]] std::vector<int> stop_signals();

/// Notes the signals that ask to stop while it lives; a second one ends the program at once. One at a time: a signal
/// handler has no other place for its note than a global.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;
  [[nodiscard]] bool wanted() const;

 private:
  std::vector<int> noted_;
};

/// Throws Stopped if the user wants to stop: for long work before the first step. Without an Interrupt nobody does.
/// \param doing  what is not finished, for the message
void stop_if_wanted(const char* doing);

}  // namespace polybed::core
