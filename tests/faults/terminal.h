// The program as a user has it: with a terminal of its own, keys in and a screen out.
#pragma once

#include <gmock/gmock.h>
#include <poll.h>
#include <pty.h>

#include <array>
#include <chrono>
#include <string>
#include <vector>

#include "program.h"

namespace dynalin::faults {

class Terminal {
 public:
  Terminal(const fs::path& folder, const std::vector<std::string>& arguments) {
    child_ = ::forkpty(&screen_, nullptr, nullptr, nullptr);
    if (child_ != 0) return;
    if (::chdir(folder.c_str()) != 0) ::_exit(99);
    ::setenv("DYNALIN_HISTORY", (folder / "history").c_str(), 1);
    ::setenv("TERM", "dumb", 1);
    ::setenv("OPENBLAS_NUM_THREADS", "1", 1);
    ::alarm(50);
    become_program(arguments);
  }
  ~Terminal() {
    ::close(screen_);
    if (child_ > 0) ::kill(child_, SIGKILL), ::waitpid(child_, nullptr, 0);
  }

  void type(const std::string& keys) const {
    ASSERT_EQ(::write(screen_, keys.data(), keys.size()), ssize_t(keys.size()));
  }
  // What the screen shows up to a text that is awaited; all that came where it does not.
  std::string until(const std::string& awaited) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(15);
    std::size_t at = 0;
    while ((at = unread_.find(awaited)) == std::string::npos && std::chrono::steady_clock::now() < end) {
      pollfd ready{screen_, POLLIN, 0};
      if (::poll(&ready, 1, 100) <= 0) continue;
      std::array<char, 4096> bytes{};
      const ssize_t count = ::read(screen_, bytes.data(), bytes.size());
      if (count <= 0) break;
      unread_.append(bytes.data(), static_cast<std::size_t>(count));
    }
    EXPECT_THAT(unread_, ::testing::HasSubstr(awaited));
    const std::size_t length = at == std::string::npos ? unread_.size() : at + awaited.size();
    const std::string shown = unread_.substr(0, length);
    unread_.erase(0, length);
    return shown;
  }
  // All that it shows until its end.
  std::string rest() {
    std::array<char, 4096> bytes{};
    for (ssize_t count = 0; (count = ::read(screen_, bytes.data(), bytes.size())) > 0;)
      unread_.append(bytes.data(), static_cast<std::size_t>(count));
    return std::exchange(unread_, {});
  }
  // The status of its exit, or minus the signal that ended it.
  int wait() {
    int status = 0;
    rest();
    ::waitpid(child_, &status, 0);
    child_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

 private:
  std::string unread_;
  int screen_ = -1;
  pid_t child_ = -1;
};

}  // namespace dynalin::faults
