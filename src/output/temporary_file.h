// A file under a name that nobody can guess, which is gone when the process ends, whatever ends it.
#pragma once

#include <csignal>
#include <string>
#include <tl/expected.hpp>

namespace dynalin {

class TemporaryFile {
 public:
  // In this folder, open for writing, readable by its owner only. The error is an errno.
  static tl::expected<TemporaryFile, int> create(const std::string& folder);
  TemporaryFile(TemporaryFile&& other) noexcept;
  TemporaryFile& operator=(TemporaryFile&&) = delete;
  ~TemporaryFile();  // closes and removes it

  int descriptor() const { return descriptor_; }
  const char* path() const;
  // 0, or an errno: writing may fail as late as here.
  int close();
  // Its name is now that of a file to be kept.
  void keep();

 private:
  struct Slot;
  TemporaryFile(Slot* slot, int descriptor) : slot_(slot), descriptor_(descriptor) {}
  friend void remove_temporary_files(int signal);

  Slot* slot_;
  int descriptor_;
};

// In a handler of this signal: takes the temporary files with it and ends the process.
void remove_temporary_files(int signal);
// Signals that end the process, but for those that are ignored or handled, take the temporary files with them. To be
// called by the thread that makes all of these.
void remove_temporary_files_on_signals();

// While it lives this thread is not interrupted by those signals.
class WithoutSignals {
 public:
  WithoutSignals();
  ~WithoutSignals();
  WithoutSignals(const WithoutSignals&) = delete;
  WithoutSignals& operator=(const WithoutSignals&) = delete;

 private:
  sigset_t before_;
};

}  // namespace dynalin
