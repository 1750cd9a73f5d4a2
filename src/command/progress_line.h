// One line on a terminal that is rewritten in place, a few times a second.
#pragma once

#include <unistd.h>

#include <chrono>
#include <iostream>

namespace dynalin {

class ProgressLine {
 public:
  // Silent without a stream, and where the stream is not a terminal.
  explicit ProgressLine(std::ostream* out)
      : out_(out && out->rdbuf() == std::cout.rdbuf() && ::isatty(STDOUT_FILENO) != 0 ? out : nullptr) {}
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  // `text()` is asked for only when it is due; what takes no time shows nothing.
  template <class Text>
  void show(Text&& text) {
    const auto now = std::chrono::steady_clock::now();
    if (!out_ || now < due_) return;
    due_ = now + std::chrono::milliseconds(200);
    *out_ << '\r' << text() << to_end << std::flush;
    shown_ = true;
  }
  void clear() {
    if (shown_) *out_ << '\r' << to_end << std::flush;
    shown_ = false;
  }

 private:
  static constexpr const char* to_end = "\033[K";  // clears what is left of the line
  std::ostream* out_;
  std::chrono::steady_clock::time_point due_ = std::chrono::steady_clock::now() + std::chrono::milliseconds(200);
  bool shown_ = false;
};

}  // namespace dynalin
