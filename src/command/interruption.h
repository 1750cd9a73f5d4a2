// Ctrl-C asks for the end of what is under way, and ends the program if it is asked for again before that.
//
// A command that takes long looks at `interrupted` at places where it can end: what was computed is kept and written.
// Whoever is not within an Interruptible is ended by the signal at once, and leaves nothing behind.
#pragma once

#include <csignal>

namespace dynalin {

// While one lives the first SIGINT is noted. Where the signal was ignored it stays so.
class Interruptible {
 public:
  Interruptible();
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

 private:
  struct sigaction before_ {};
  bool set_ = false;
};

// Whether it was asked for since it was last forgotten.
bool interrupted();
void forget_interruption();

}  // namespace dynalin
