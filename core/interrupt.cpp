#include "core/interrupt.hpp"

#include <array>
#include <csignal>
#include <string>

#include "core/error.hpp"

namespace polybed::core {

namespace {

volatile std::sig_atomic_t asked = 0;
constexpr std::array wishes{SIGINT, SIGTERM, SIGUSR1};

void note(int signal) {
  asked = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

Interrupt::Interrupt() {
  asked = 0;
  for (const int signal : wishes) std::signal(signal, note);
}

Interrupt::~Interrupt() {
  asked = 0;
  for (const int signal : wishes) std::signal(signal, SIG_DFL);
}

bool Interrupt::wanted() const { return asked != 0; }

void stop_if_wanted(const char* doing) {
  if (asked != 0) throw Stopped(std::string("stopped by the user while ") + doing + ": the run has not begun");
}

}  // namespace polybed::core
