// The user's request to stop (Ctrl-C, a termination request or a closed terminal), noted and checked between steps.
#pragma once

#include <vector>

namespace polybed::core {

/// The signals that request a stop: SIGINT, SIGTERM, SIGUSR1, which mpirun passes on without a time limit, and SIGHUP
/// unless this process was started to outlive its terminal, for example with nohup.
[[nodiscard]] std::vector<int> stop_signals();

/// Notes the signals that request a stop while it exists; a second signal ends the program at once. Only one object at
/// a time, since a signal handler can only write to a global.
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

/// Throws Stopped if the user has requested a stop, for long work before the first step. Needs an Interrupt to work.
/// \param doing  the unfinished work, for the message
void stop_if_wanted(const char* doing);

}  // namespace polybed::core
