// Tables of all modes: a row for each that is asked for, and what all of them sum up to.
#pragma once

#include <string>
#include <vector>

#include "dynalin/modal_table.h"
#include "study/linearization.h"

namespace dynalin {

// What stands in the text file: rows of modes with others between and below them that are made of theirs.
struct SumsOverModes {
  struct Line {
    std::string label;  // the number of a mode, "perc.", "Sum", "Model"
    std::vector<double> values;
  };
  std::string title;
  std::vector<std::string> columns;
  std::vector<Line> lines;
  std::string below;               // a sentence about the whole, or nothing
  std::vector<std::string> notes;  // about some of the modes
};

struct TablesOfAllModes {
  std::vector<ModalTable> values;  // as results have them
  std::vector<SumsOverModes> texts;
};

// ENERGY_PER_MODE and MASS_PER_MODE of LINEAR (energy_per_mode.h, modal_masses.h).
StudyResult<TablesOfAllModes> energies_of_all(const Linearization&, const EigenSolution&, const ModalTableRequest&);
StudyResult<TablesOfAllModes> masses_of_all(const Linearization&, const EigenSolution&, const ModalTableRequest&);

}  // namespace dynalin
