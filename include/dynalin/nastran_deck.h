// The linear model as a Nastran bulk data deck, as LINEAR/EXPORT writes it (docs/nastran.md).
#pragma once

#include <string>
#include <vector>

#include "dynalin/linear_model.h"

namespace dynalin::library {

enum class NastranBox {
  open,    // OPENBOX: element by element
  closed,  // CLOSEDBOX: mass, damping and stiffness of the whole
};

struct NastranDeck {
  struct File {
    std::string name;  // what was given, with what the style of the files puts behind it
    std::string text;
  };
  std::vector<File> files;  // the main file first
  std::vector<Remark> remarks;
};

// The text of a deck; `name` is what the names of its files begin with, and `configuration` the text of a configuration
// file, with its defaults if it is empty. Throws Error with every problem of the configuration, or if the model cannot
// be exported so.
NastranDeck nastran_deck(const LinearModel&, NastranBox, const std::string& name,
                         const std::string& configuration = {});
// The same as files, all of them or after an error none; existing ones are replaced.
NastranDeck export_nastran(const LinearModel&, NastranBox, const std::string& name,
                           const std::string& configuration = {});

}  // namespace dynalin::library
