#include "core/interrupt.hpp"

#include <csignal>
#include <string>

#include "core/error.hpp"

namespace polybed::core {

namespace {

volatile std::sig_atomic_t asked = 0;

void note(int signal) {
  asked = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

std::vector<int> stop_signals() {
  std::vector<int> signals{SIGINT, SIGTERM, SIGUSR1};
  struct sigaction hangup;
  ::sigaction(SIGHUP, nullptr, &hangup);
  if (hangup.sa_handler != SIG_IGN) signals.push_back(SIGHUP);
  return signals;
}

Interrupt::Interrupt() : noted_(stop_signals()) {
  asked = 0;
  for (const int signal : noted_) std::signal(signal, note);
}

Interrupt::~Interrupt() {
  asked = 0;
  for (const int signal : noted_) std::signal(signal, SIG_DFL);
}

bool Interrupt::wanted() const { return asked != 0; }

void stop_if_wanted(const char* doing) {
  if (asked != 0) throw Stopped(std::string("stopped by the user while ") + doing + ": the run has not begun");
}

}  // namespace polybed::core
