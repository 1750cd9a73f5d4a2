#include "command/progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <iostream>
#include <utility>

#include "base/signals_held_back.h"

namespace dynalin {

namespace {

constexpr const char* to_line_end = "\033[K";  // clears what is left of the line

std::ostream* if_terminal(std::ostream* out) {
  return out && out->rdbuf() == std::cout.rdbuf() && ::isatty(STDOUT_FILENO) != 0 ? out : nullptr;
}

}  // namespace

ProgressLine::ProgressLine(std::ostream* out) : out_(if_terminal(out)) {
  if (!out_) return;
  const SignalsHeldBack by_the_watcher;
  watcher_ = std::thread([this] { watch(); });
}

ProgressLine::~ProgressLine() {
  clear();
  if (!watcher_.joinable()) return;
  {
    const std::scoped_lock lock(mutex_);
    ended_ = true;
  }
  end_.notify_one();
  watcher_.join();
}

void ProgressLine::say(std::string text) {
  if (!out_) return;
  const std::scoped_lock lock(mutex_);
  said_ = std::move(text);
  since_ = Clock::now();
}

Progress ProgressLine::progress() {
  return out_ ? Progress([this](std::string text) { say(std::move(text)); }) : Progress();
}

void ProgressLine::clear() {
  if (!out_) return;
  const std::scoped_lock lock(mutex_);
  said_.clear();
  if (!std::exchange(shown_, {}).empty()) *out_ << '\r' << to_line_end << std::flush;
}

void ProgressLine::watch() {
  std::unique_lock lock(mutex_);
  while (!end_.wait_for(lock, interval, [this] { return ended_; })) {
    if (said_.empty()) continue;
    const auto lasted = std::chrono::duration_cast<std::chrono::seconds>(Clock::now() - since_).count();
    std::string line = lasted > 0 ? fmt::format("{} ({} s)", said_, lasted) : said_;
    if (line == shown_) continue;
    *out_ << '\r' << line << to_line_end << std::flush;
    shown_ = std::move(line);
  }
}

}  // namespace dynalin
