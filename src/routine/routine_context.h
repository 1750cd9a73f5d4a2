// What a compiled routine is asked at this moment, in this thread: the utilities that it calls look here.
#pragma once

#include <cfenv>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dynalin/user_routine.h"
#include "routine/measures.h"

namespace dynalin {

struct RoutineData;

// By SYSFNC, or by SYSARY and GTARAY.
enum class Quantity : std::uint8_t { number, list };

// Something that a routine asked for, and which of its inputs that is.
struct RoutineRequest {
  std::string name;
  Quantity quantity = Quantity::list;
  std::vector<int> ids;
  std::vector<std::int32_t> inputs;
};

// What a routine reads, in the order in which it asked first. The first two are TIME and MODE.
struct RoutineRequests {
  std::vector<Atom> inputs;
  std::vector<RoutineRequest> list;
};

class RoutineContext {
 public:
  enum class Phase : std::uint8_t { asking, evaluating };

  Phase phase = Phase::evaluating;
  RoutineRequests* asked = nullptr;           // while asking: to be added to
  const RoutineRequests* requests = nullptr;  // while evaluating
  const SizeOfList* size_of = nullptr;
  const sAdamsGSE* gse = nullptr;  // of a routine that is called for one
  const RoutineData* data = nullptr;
  std::span<const double> inputs;
  std::size_t values = 1;
  // Partial derivatives of all values with respect to all inputs, [value * inputs + input], and which inputs have them.
  std::span<double> partials;
  std::span<char> given;
  std::string failure;
  std::string miscount;  // of partial derivatives, which are not taken then

  bool wants_partials() const { return !partials.empty(); }
  // Null, with the failure noted, if there is no such quantity or it was not asked for in time.
  const RoutineRequest* request(std::string_view name, std::span<const int> ids, Quantity);
  // The same without a failure, for partial derivatives.
  const RoutineRequest* known(std::string_view name, std::span<const int> ids, Quantity) const;
  void fail(std::string reason) {
    if (failure.empty()) failure = std::move(reason);
  }

  // The one at work in this thread, null if none is: a utility that a routine calls from a thread of its own. Those at
  // work anywhere then fail for it when they are done.
  static RoutineContext* current();
  // "the routine sfosub of friction.so, called for SFORCE/3", empty if none is.
  static std::string_view what();
  // Says who is at work as long as it lives, where a library runs before any routine of it.
  class Named {
   public:
    explicit Named(const char* what);
    ~Named();
    Named(const Named&) = delete;
    Named& operator=(const Named&) = delete;

   private:
    const char* before_;
  };
  // Makes one current as long as it lives. `what` names statement and routine if the process dies in it; it must
  // outlive this. Rounding and traps of floating-point numbers are afterwards what they were before. Only then all is
  // known that has failed.
  class Scope {
   public:
    Scope(RoutineContext&, const char* what);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    RoutineContext& context_;
    RoutineContext* before_;
    const char* what_before_;
    std::fenv_t numbers_before_;
  };

 private:
  const RoutineRequest* ask(std::string_view name, std::span<const int> ids, Quantity);
  mutable std::size_t next_ = 0;  // routines ask in the same order each time
};

// In a handler of any exception: "it threw an exception", and what that says.
std::string caught_exception();

// From now on a signal that kills the process in a routine says first which one that was, on the standard error
// output, and a routine that ends the process by itself counts as one that crashed. For programs; a library leaves
// signals and exits alone.
void name_routine_of_crash();

}  // namespace dynalin
