// What compiled routines are found to do while a model is linearized: what the linear model cannot show.
#pragma once

#include <set>
#include <string>

namespace dynalin {

struct RoutineFindings {
  bool differenced = false;              // slopes in the linear model are differences
  std::set<std::string> kinks;           // sentences: slopes that differ from side to side, of which the mean is taken
  std::set<std::string> wrong_partials;  // sentences: derivatives that differences contradict

  void add(const RoutineFindings&);

  // Of the linear model that is made in this thread, null where none is.
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
