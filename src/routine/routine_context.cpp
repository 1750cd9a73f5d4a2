#include "routine/routine_context.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <mutex>
#include <utility>

namespace dynalin {

namespace {

thread_local RoutineContext* at_work = nullptr;
thread_local const char* volatile what_is_at_work = nullptr;

// Of all threads, each with what went wrong beside it: a thread that a routine has started does not say whose it is.
class AllAtWork {
 public:
  void enter(RoutineContext& context, const char* what) {
    const std::lock_guard lock(mutex_);
    list_.push_back({&context, what, {}});
  }
  // What was noted meanwhile.
  std::string leave(RoutineContext& context) {
    const std::lock_guard lock(mutex_);
    const auto at = std::ranges::find(list_, &context, &Entry::context);
    std::string noted = std::move(at->noted);
    list_.erase(at);
    return noted;
  }
  void note_call_from_elsewhere() {
    const std::lock_guard lock(mutex_);
    for (Entry& entry : list_) {
      if (!entry.noted.empty()) continue;
      std::string others;
      for (const Entry& other : list_) {
        if (&other != &entry) others += (others.empty() ? "" : ", ") + std::string(other.what);
      }
      entry.noted = fmt::format(
          "it{} calls a utility from a thread of its own; utilities may be called only from the thread that called the "
          "routine",
          others.empty() ? "" : fmt::format(", or another one at work at the time ({}),", others));
    }
  }

 private:
  struct Entry {
    RoutineContext* context;
    const char* what;
    std::string noted;
  };
  std::mutex mutex_;
  std::vector<Entry> list_;
};
AllAtWork& all_at_work() {
  static AllAtWork all;
  return all;
}

bool same_name(std::string_view a, std::string_view b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](char x, char y) {
           const auto upper = [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; };
           return upper(x) == upper(y);
         });
}

bool is_it(const RoutineRequest& r, std::string_view name, std::span<const int> ids, Quantity quantity) {
  return r.quantity == quantity && std::ranges::equal(r.ids, ids) && same_name(r.name, name);
}

void write_all(std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = ::write(STDERR_FILENO, text.data(), text.size());
    if (n <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(n));
  }
}

constexpr std::array crashes = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
std::array<struct sigaction, crashes.size()> before_crash{};  // what handles them else

// Nothing but what a signal handler may do.
void on_crash(int signal) {
  if (const char* what = what_is_at_work) {
    write_all("dynalin: a signal ended the program in ");
    write_all(std::string_view(what, std::strlen(what)));
    write_all("\n");
  }
  for (std::size_t k = 0; k < crashes.size(); ++k) {
    if (crashes[k] == signal) ::sigaction(signal, &before_crash[k], nullptr);
  }
  ::raise(signal);
}

// STOP of Fortran, exit or quick_exit: nothing of what was asked for is done, whatever status it gives.
void on_exit_in_routine() {
  const char* what = std::exchange(what_is_at_work, nullptr);
  if (!what) return;
  write_all("dynalin: the program was told to end by ");
  write_all(std::string_view(what, std::strlen(what)));
  write_all("\n");
  ::raise(SIGABRT);
}

}  // namespace

RoutineContext* RoutineContext::current() {
  // A library that is being loaded has no routine at work either.
  if (!at_work && !what_is_at_work) all_at_work().note_call_from_elsewhere();
  return at_work;
}
std::string_view RoutineContext::what() {
  const char* what = what_is_at_work;
  return what ? what : "";
}

RoutineContext::Named::Named(const char* what) : before_(what_is_at_work) { what_is_at_work = what; }
RoutineContext::Named::~Named() { what_is_at_work = before_; }

std::string caught_exception() {
  try {
    throw;
  } catch (const std::exception& e) {
    return fmt::format("it threw an exception: {}", e.what());
  } catch (...) {
    return "it threw an exception";
  }
}

RoutineContext::Scope::Scope(RoutineContext& context, const char* what)
    : context_(context), before_(at_work), what_before_(what_is_at_work) {
  all_at_work().enter(context, what);
  at_work = &context;
  what_is_at_work = what;
  std::fegetenv(&numbers_before_);
}
RoutineContext::Scope::~Scope() {
  std::fesetenv(&numbers_before_);
  if (std::string noted = all_at_work().leave(context_); !noted.empty()) context_.fail(std::move(noted));
  at_work = before_;
  what_is_at_work = what_before_;
}

const RoutineRequest* RoutineContext::known(std::string_view name, std::span<const int> ids, Quantity quantity) const {
  const RoutineRequests* all = phase == Phase::asking ? asked : requests;
  const std::size_t count = all->list.size();
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t at = (next_ + k) % count;
    if (!is_it(all->list[at], name, ids, quantity)) continue;
    next_ = at + 1;
    return &all->list[at];
  }
  return nullptr;
}

const RoutineRequest* RoutineContext::request(std::string_view name, std::span<const int> ids, Quantity quantity) {
  if (const RoutineRequest* r = known(name, ids, quantity)) return r;
  if (phase == Phase::asking) return ask(name, ids, quantity);
  fail(fmt::format("it reads {}({}), for which it did not ask when iflag was 1 or 3", name, fmt::join(ids, ", ")));
  return nullptr;
}

const RoutineRequest* RoutineContext::ask(std::string_view name, std::span<const int> ids, Quantity quantity) {
  std::vector<Atom> atoms;
  if (quantity == Quantity::number) {
    if (const auto atom = single_measure(name, ids)) atoms.push_back(*atom);
  } else if (auto list = measure_list(name, ids, *size_of)) {
    atoms = std::move(*list);
  } else if (const auto atom = single_measure(name, ids)) {
    atoms.push_back(*atom);
  }
  if (atoms.empty()) {
    fail(fmt::format("it asks for {}({}), which is no quantity of the model", name, fmt::join(ids, ", ")));
    return nullptr;
  }
  RoutineRequest r{std::string(name), quantity, {ids.begin(), ids.end()}, {}};
  for (const Atom& a : atoms) {
    const auto found = std::find_if(asked->inputs.begin(), asked->inputs.end(), [&](const Atom& other) {
      return other.function == a.function && other.argument == a.argument;
    });
    r.inputs.push_back(static_cast<std::int32_t>(found - asked->inputs.begin()));
    if (found == asked->inputs.end()) asked->inputs.push_back(a);
  }
  asked->list.push_back(std::move(r));
  return &asked->list.back();
}

void name_routine_of_crash() {
  std::atexit(on_exit_in_routine);
  std::at_quick_exit(on_exit_in_routine);
  // A routine that runs out of stack needs another one to say so.
  static std::array<char, 65536> spare;
  stack_t stack{};
  stack.ss_sp = spare.data();
  stack.ss_size = spare.size();
  ::sigaltstack(&stack, nullptr);
  for (std::size_t k = 0; k < crashes.size(); ++k) {
    if (::sigaction(crashes[k], nullptr, &before_crash[k]) != 0 || before_crash[k].sa_handler == SIG_IGN) continue;
    struct sigaction action {};
    action.sa_handler = on_crash;
    action.sa_flags = static_cast<int>(SA_ONSTACK | SA_NODEFER);
    ::sigaction(crashes[k], &action, nullptr);
  }
}

}  // namespace dynalin
