#include "output/temporary_file.h"

#include <fcntl.h>
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

constexpr std::array ending_signals = {SIGINT, SIGTERM, SIGHUP};

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

// Only calls that are safe in a handler.
void remove_temporary_files(int signal) {
  for (TemporaryFile::Slot* slot = TemporaryFile::Slot::first.load(); slot; slot = slot->next) {
    if (slot->exists.load()) ::unlink(slot->path);
  }
  ::raise(signal);  // the handler is no longer set: the process ends as by the signal itself
}

void remove_temporary_files_on_signals() {
  for (const int signal : ending_signals) {
    struct sigaction now {};
    if (::sigaction(signal, nullptr, &now) != 0 || now.sa_handler == SIG_IGN) continue;
    struct sigaction then {};
    then.sa_handler = remove_temporary_files;
    then.sa_flags = static_cast<int>(SA_RESETHAND);
    ::sigemptyset(&then.sa_mask);
    ::sigaction(signal, &then, nullptr);
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
