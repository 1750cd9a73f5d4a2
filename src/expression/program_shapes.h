// What reading one expression leaves for the next: shapes that others may have as well, and memory to make programs in.
#pragma once

#include <cstddef>
#include <memory>
#include <unordered_map>

#include "expression/program_draft.h"
#include "expression/program_shape.h"

namespace dynalin {

class ProgramShapes {
 public:
  // An empty one to be filled, in memory that is used again.
  ProgramShape& blank();
  // The one that is equal to this.
  std::shared_ptr<const ProgramShape> shared(const ProgramShape&);

  // An empty draft in the memory of one that was given back, if there is any.
  ProgramDraft take_draft();
  void give_back(ProgramDraft);

 private:
  static constexpr std::size_t most = 4096;  // so that a model of unlike expressions keeps no second list of them
  std::unordered_multimap<std::size_t, std::shared_ptr<const ProgramShape>> by_hash_;
  ProgramShape blank_;
  ProgramDraft spare_;
};

}  // namespace dynalin
