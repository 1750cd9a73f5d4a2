// What compiled routines are found to do while a model is linearized or simulated: what the result cannot show.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>

namespace dynalin {

struct RoutineFindings {
  bool of_linear_model = false;          // is made; else the model moves or comes to rest
  bool differenced = false;              // slopes in the linear model are differences
  std::set<std::string> kinks;           // sentences: slopes that differ from side to side, of which the mean is taken
  std::set<std::string> wrong_partials;  // sentences: derivatives that differences contradict
  // Of MOTIONs, by the number of their routine: when the derivatives by time are held against differences again. Each
  // time is half as far again from the first as the one before, so that a long run has few of them.
  struct Times {
    double first, next;
  };
  std::map<std::uint64_t, Times> motions;
  std::set<std::uint64_t> curves;  // those by routines whose derivatives were held against differences

  void add(const RoutineFindings&);

  // Of the linear model or simulation that is made in this thread, null where none is.
  static RoutineFindings* current();
  // Makes findings the current ones as long as it lives.
  class Scope {
   public:
    explicit Scope(RoutineFindings&);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    RoutineFindings* before_;
  };
};

}  // namespace dynalin
