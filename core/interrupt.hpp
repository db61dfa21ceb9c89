// The user's wish to stop: Ctrl-C or a termination request, noted and asked for between steps.
#pragma once

namespace polybed::core {

/// Notes SIGINT, SIGTERM and SIGUSR1, which mpirun passes on without a time limit, while it lives; a second signal ends
/// the program at once. One at a time: a signal
/// handler has no other place for its note than a global.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;
  [[nodiscard]] bool wanted() const;
};

/// Throws Stopped if the user wants to stop: for long work before the first step. Without an Interrupt nobody does.
/// \param doing  what is not finished, for the message
void stop_if_wanted(const char* doing);

}  // namespace polybed::core
