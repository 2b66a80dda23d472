#include "incognita/app/console/interrupt.hpp"

#include <csignal>
#include <initializer_list>

namespace incognita {
namespace {

volatile std::sig_atomic_t was_interrupted = 0;
void interrupt(int) { was_interrupted = 1; }

}  // namespace

void catch_interrupts() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    if (std::signal(signal, interrupt) == SIG_IGN && signal == SIGHUP) std::signal(signal, SIG_IGN);
}

bool interrupted() { return was_interrupted != 0; }

}  // namespace incognita
