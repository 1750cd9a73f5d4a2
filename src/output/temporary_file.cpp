#include "output/temporary_file.h"

#include <fcntl.h>
#include <pthread.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace dynalin {

namespace {

// Those that others send, and those that the process brings upon itself.
constexpr std::array ending_signals = {SIGINT,  SIGTERM,   SIGHUP,  SIGQUIT, SIGXCPU,
                                       SIGALRM, SIGVTALRM, SIGPROF, SIGUSR1, SIGUSR2};
constexpr std::array crashes = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

// That makes the files: it alone knows when it is not to be interrupted (WithoutSignals), and a signal may come to any.
pthread_t maker_of_files;

void end_by(int signal) {
  if (::pthread_equal(::pthread_self(), maker_of_files) == 0) {
    ::pthread_kill(maker_of_files, signal);
  } else {
    remove_temporary_files(signal);
  }
}

void handle(int signal, void (*by)(int)) {
  struct sigaction then {};
  then.sa_handler = by;
  ::sigemptyset(&then.sa_mask);
  for (const int other : ending_signals) ::sigaddset(&then.sa_mask, other);
  ::sigaction(signal, &then, nullptr);
}

}  // namespace

// What a signal handler can read: slots are used again and never freed.
struct TemporaryFile::Slot {
  std::atomic<bool> taken = true;    // belongs to a TemporaryFile
  std::atomic<bool> exists = false;  // and its path is a file
  char path[PATH_MAX] = {};
  Slot* next = nullptr;

  static std::atomic<Slot*> first;
  static Slot* take() {
    for (Slot* slot = first.load(); slot; slot = slot->next) {
      bool free = false;
      if (slot->taken.compare_exchange_strong(free, true)) return slot;
    }
    Slot* slot = new Slot;
    slot->next = first.load();
    while (!first.compare_exchange_weak(slot->next, slot)) {
    }
    return slot;
  }
};
std::atomic<TemporaryFile::Slot*> TemporaryFile::Slot::first = nullptr;

tl::expected<TemporaryFile, int> TemporaryFile::create(const std::string& folder) {
  constexpr std::string_view suffix = ".part";
  const std::string pattern = (folder.empty() ? "." : folder) + "/.dynalin-XXXXXX" + std::string(suffix);
  if (pattern.size() >= PATH_MAX) return tl::unexpected(ENAMETOOLONG);
  Slot* slot = Slot::take();
  std::memcpy(slot->path, pattern.c_str(), pattern.size() + 1);
  const WithoutSignals uninterrupted;  // no file without its name in the slot
  const int descriptor = ::mkostemps(slot->path, static_cast<int>(suffix.size()), O_CLOEXEC);
  if (descriptor < 0) {
    const int error = errno;
    slot->taken = false;
    return tl::unexpected(error);
  }
  slot->exists = true;
  return TemporaryFile(slot, descriptor);
}

TemporaryFile::TemporaryFile(TemporaryFile&& other) noexcept
    : slot_(std::exchange(other.slot_, nullptr)), descriptor_(std::exchange(other.descriptor_, -1)) {}

TemporaryFile::~TemporaryFile() {
  close();
  if (!slot_) return;
  if (slot_->exists) ::unlink(slot_->path);
  keep();
}

const char* TemporaryFile::path() const { return slot_->path; }

int TemporaryFile::close() {
  if (descriptor_ < 0) return 0;
  return ::close(std::exchange(descriptor_, -1)) == 0 || errno == EINTR ? 0 : errno;
}

void TemporaryFile::keep() {
  slot_->exists = false;
  std::exchange(slot_, nullptr)->taken = false;
}

// Only calls that are safe in a handler. A second signal ends the process by this function as well, and so only when
// all files are gone.
void remove_temporary_files(int signal) {
  for (TemporaryFile::Slot* slot = TemporaryFile::Slot::first.load(); slot; slot = slot->next) {
    if (slot->exists.load()) ::unlink(slot->path);
  }
  // The process ends as by the signal itself.
  struct sigaction by_default {};
  by_default.sa_handler = SIG_DFL;
  ::sigaction(signal, &by_default, nullptr);
  sigset_t this_one;
  ::sigemptyset(&this_one);
  ::sigaddset(&this_one, signal);
  ::pthread_sigmask(SIG_UNBLOCK, &this_one, nullptr);
  ::raise(signal);
}

void remove_temporary_files_on_signals() {
  maker_of_files = ::pthread_self();
  struct sigaction now {};
  for (const int signal : ending_signals) {
    if (::sigaction(signal, nullptr, &now) == 0 && now.sa_handler != SIG_IGN) handle(signal, end_by);
  }
  // Whoever wants to see crashes has a handler.
  for (const int signal : crashes) {
    if (::sigaction(signal, nullptr, &now) == 0 && now.sa_handler == SIG_DFL) handle(signal, remove_temporary_files);
  }
}

WithoutSignals::WithoutSignals() {
  sigset_t blocked;
  ::sigemptyset(&blocked);
  for (const int signal : ending_signals) ::sigaddset(&blocked, signal);
  ::pthread_sigmask(SIG_BLOCK, &blocked, &before_);
}

WithoutSignals::~WithoutSignals() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

}  // namespace dynalin
