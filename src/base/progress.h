// How far a long computation has come, in words, for whoever watches it. Nobody has to.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace dynalin {

class Progress {
 public:
  using Show = std::function<void(std::string)>;

  Progress() = default;  // unwatched
  explicit Progress(Show show) : show_(std::move(show)) {}

  // What is being done from now on; `text()` is made only where somebody watches.
  template <class Text>
  void tell(const Text& text) const {
    if (!show_) return;
    if constexpr (std::is_invocable_v<const Text&>) {
      show_(text());
    } else {
      show_(std::string(text));
    }
  }

  // Of a part of the whole, whose name stands before what it tells: "saddles: iteration 3".
  Progress of(std::string_view part) const {
    if (!show_) return {};
    return Progress([show = show_, name = std::string(part) + ": "](const std::string& text) { show(name + text); });
  }

 private:
  Show show_;
};

}  // namespace dynalin
