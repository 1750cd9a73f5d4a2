// Identification numbers of a deck. Nastran wants them unique over all kinds of cards that share a space of numbers,
// while the documented offsets of those kinds coincide: each number is the first free one from where it is wanted.
#pragma once

#include <array>
#include <cstdint>
#include <map>

namespace dynalin::nastran {

enum class IdSpace : std::uint8_t {
  point,              // GRID and SPOINT
  element,            // CONM2, RJOINT, RBE2, CBUSH, CQUAD4, CTRIA3, CROD and PLOTEL
  property,           // PBUSH, PSHELL and PROD
  coordinate_system,  // CORD2R
  material,           // MAT1
  set,                // SET of case control
  dynamic_load,       // DLOAD and RLOAD1
  static_load,        // FORCE and MOMENT
  phase,              // DPHASE
  table,              // TABLED1
};

class Ids {
 public:
  static constexpr std::int64_t largest = 99'999'999;  // eight digits: more does not fit into a field

  // `wanted`, an offset or an offset plus the id in the dataset, or the first number after it that nobody has. What
  // wants the same offset again gets the next one, so that a family that is numbered in one go is without gaps. A
  // number above `largest` is the caller's to refuse; writing it fails.
  std::int64_t take(IdSpace space, std::int64_t wanted);
  bool is_free(IdSpace space, std::int64_t id) const;

 private:
  using Runs = std::map<std::int64_t, std::int64_t>;  // first of a run of taken numbers to the last of it
  static Runs::const_iterator run_with(const Runs&, std::int64_t id);
  std::array<Runs, 10> taken_;
};

}  // namespace dynalin::nastran
