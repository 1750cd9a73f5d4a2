#include "command/interruption.h"

#include "output/temporary_file.h"

namespace dynalin {

namespace {

volatile std::sig_atomic_t interruption_asked = 0;

// The first one asks, and the next one ends the program as a signal does that nobody waits for.
void note(int signal) {
  if (interruption_asked != 0) return remove_temporary_files(signal);
  interruption_asked = 1;
}

}  // namespace

Interruptible::Interruptible() {
  if (::sigaction(SIGINT, nullptr, &before_) != 0 || before_.sa_handler == SIG_IGN) return;
  struct sigaction now {};
  now.sa_handler = note;
  ::sigemptyset(&now.sa_mask);
  set_ = ::sigaction(SIGINT, &now, nullptr) == 0;
}

Interruptible::~Interruptible() {
  if (set_) ::sigaction(SIGINT, &before_, nullptr);
}

bool interrupted() { return interruption_asked != 0; }
void forget_interruption() { interruption_asked = 0; }

}  // namespace dynalin
