// SPDX-License-Identifier: Apache-2.0
#include "app/signals.hpp"

#include <array>
#include <csignal>

namespace scree {

namespace {

constexpr std::array<int, 5> handled = {SIGINT, SIGTERM, SIGHUP, SIGXFSZ, SIGPIPE};

volatile sig_atomic_t last_signal = 0;
std::array<struct sigaction, handled.size()> former;

void note(int signal) { last_signal = signal; }

}  // namespace

StopSignals::StopSignals() {
  last_signal = 0;
  for (std::size_t i = 0; i < handled.size(); ++i) {
    struct sigaction action {};
    sigemptyset(&action.sa_mask);
    const bool stops = handled[i] != SIGXFSZ && handled[i] != SIGPIPE;
    action.sa_handler = stops ? note : SIG_IGN;
    action.sa_flags = SA_RESTART;
    sigaction(handled[i], &action, &former[i]);
    // A run under nohup survives the end of its terminal.
    if (handled[i] == SIGHUP && former[i].sa_handler == SIG_IGN) {
      sigaction(SIGHUP, &former[i], nullptr);
    }
  }
}

StopSignals::~StopSignals() {
  for (std::size_t i = 0; i < handled.size(); ++i) sigaction(handled[i], &former[i], nullptr);
}

int StopSignals::received() { return last_signal; }

}  // namespace scree
