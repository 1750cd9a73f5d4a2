// Data of a model that compiled routines read by utilities of their own. They stay what they are while the model moves.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "base/vec3.h"
#include "expression/parametric_curve.h"
#include "expression/spline.h"

namespace dynalin {

class CurveRoutine;
class DampingRoutine;

struct RoutineData {
  static constexpr std::size_t longest_text = 1024;  // routines have room for so many characters

  struct Spline {
    std::shared_ptr<const SplineCurves> akima, cubic;
  };
  struct Modes {
    std::vector<int> number;
    std::vector<double> frequency;  // [cycles/s]
    std::size_t cases = 0;          // modal loads
    std::vector<double> loads;      // 6 + modes numbers for each
  };
  struct Numbers {
    std::size_t rows = 0, columns = 0;
    bool by_entries = false;         // SPARSE
    std::span<const double> values;  // column by column, of the model
  };
  // By ids of statements. They are known before the model is read, and what they hold when it is; texts at once.
  std::map<int, Spline> splines;
  std::map<int, std::shared_ptr<const ParametricCurve>> curves;
  std::map<int, std::string> strings;
  std::map<int, Numbers> matrices;
  std::map<int, Modes> flexible_bodies;
  std::map<int, std::shared_ptr<const DampingRoutine>> damping;      // of flexible bodies whose CRATIO calls a routine
  std::map<int, std::shared_ptr<const CurveRoutine>> called_curves;  // of CURVEs whose FUNCTION calls one
  std::set<int> modes_read;                                          // ids of flexible bodies whose Q or QDOT are read
  Vec3<double> gravity{};                                            // [length/time²], global axes
  bool is_read = false;
};

}  // namespace dynalin
