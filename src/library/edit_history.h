// How a model came out of others by edits, and what they stated anew about the start.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "model/restated.h"
#include "system/system.h"

namespace dynalin::library {

class EditHistory {
 public:
  // That of a model which comes out of `from` by one edit more.
  EditHistory after(const std::shared_ptr<const System>& from, Restated) const;
  // By all edits that led from that model to this one; by all there were, if that one is none of those it came out of.
  Restated restated_since(const std::shared_ptr<const System>&) const;

  // How many edits are told apart: each with the model it began with, which there still is.
  std::size_t told_apart() const { return edits_.size(); }

 private:
  struct Edit {
    std::weak_ptr<const System> from;
    Restated restated;  // by this edit and those of models that are gone after it: nobody has a point of these
  };
  Restated earlier_;  // before the first of them
  std::vector<Edit> edits_;
};

}  // namespace dynalin::library
