// One line on a terminal that is rewritten in place, a few times a second: what is being done, and for how long where
// that does not change.
#pragma once

#include <chrono>
#include <condition_variable>
#include <iosfwd>
#include <mutex>
#include <string>
#include <thread>

#include "base/progress.h"

namespace dynalin {

class ProgressLine {
 public:
  // Silent without a stream, and where the stream is not a terminal. Meanwhile nothing else may be written there.
  explicit ProgressLine(std::ostream* out);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  // What is being done from now on. What takes no time shows nothing.
  void say(std::string text);
  // Of what goes by many times a second: `text()` is asked for only when it is due.
  template <class Text>
  void show(const Text& text) {
    if (!out_ || Clock::now() < due_) return;
    due_ = Clock::now() + interval;
    say(text());
  }
  // For whoever tells it; it must not outlive the line.
  Progress progress();
  // Before anything else is written.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr auto interval = std::chrono::milliseconds(200);

  void watch();

  std::ostream* out_;
  Clock::time_point due_ = Clock::now() + interval;
  std::mutex mutex_;  // of all that follows
  std::condition_variable end_;
  bool ended_ = false;
  std::string said_, shown_;
  Clock::time_point since_;
  std::thread watcher_;  // writes the line, however long the one who speaks is silent
};

}  // namespace dynalin
