// Tables of modes: what moves in a mode, and where its energy is (docs/linear.md, Modal tables).
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dynalin/element_id.h"
#include "dynalin/remark.h"
#include "dynalin/results.h"

namespace dynalin {

// Modes by their numbers, or complex ones by their frequency.
struct ModeRange {
  std::int64_t first = 0, last = 0;      // counted from 1; 0: none
  double lowest_hz = 0, highest_hz = 0;  // of the imaginary part [cycles per unit time]; 0: none

  static ModeRange all() { return {1, std::numeric_limits<std::int64_t>::max()}; }
  bool any() const { return first > 0 || highest_hz > 0; }
  // Whether it holds this mode, which has this number from 1: by its frequency where frequencies are stated, which real
  // eigenvalues have none of, else by its number.
  bool has(std::size_t number, const EigenMode&) const;
};

struct ModalTableRequest {
  // By name: COORDS, KINETIC, STRAIN, DISSIPAT, MRANGE, ENERGY_PER_MODE, MASS_PER_MODE.
  std::map<std::string, ModeRange> modes;
  std::vector<std::int64_t> markers;       // of MRANGE: ids
  std::optional<std::int64_t> modal_rm{};  // of MASS_PER_MODE: marker whose origin and axes it is about

  ModeRange of(const std::string& name) const {
    const auto found = modes.find(name);
    return found == modes.end() ? ModeRange{} : found->second;
  }
  bool any() const {
    for (const auto& [name, range] : modes) {
      if (range.any()) return true;
    }
    return false;
  }
};

struct ModalTable {
  struct Row {
    ElementId element;      // what the row is about; empty in tables of all modes
    std::int64_t part = 0;  // the marker or the state of it, where it has a row for each; or else the number of a mode
    std::string name;       // view name of the element, empty if there is none
    std::vector<double> values;     // a missing one is NaN
    std::vector<double> imaginary;  // of a shape; else empty
    std::string full_name = {};     // `name` with those of the model and of the part it is on: "car.wheel.cm"
  };
  std::string name;      // "KINETIC"; "MODE" for what stands above the tables of a mode
  std::size_t mode = 0;  // counted from 1; 0: all modes, a row each
  std::vector<std::string> columns;
  std::vector<Row> rows;
};

struct ModalTables {
  EquationsMark of_equations = 0;
  std::vector<ModalTable> tables;  // mode by mode, then those of all modes
  std::vector<Remark> remarks;     // modes that are asked for and not there
};

}  // namespace dynalin
