#include "expression/program_shapes.h"

#include <functional>
#include <initializer_list>
#include <utility>

#include "base/word_hash.h"

namespace dynalin {

namespace {

// Of what tells most expressions apart: switching nodes and functions follow from it but for rare cases.
std::size_t hash_of(const ProgramShape& shape) {
  WordHash hash;
  const auto add_place = [&](const ProgramShape::Place& place) {
    hash.add(std::uint64_t{place.offset} << 32 | place.length);
  };
  hash.add(std::uint64_t{shape.length});
  for (const ExpressionNode& node : shape.nodes) {
    hash.add(static_cast<std::uint64_t>(node.kind) << 16 | node.function);
    hash.add(node.a, node.b);
  }
  for (const ProgramShape::Place& place : shape.places) add_place(place);
  for (const ProgramShape::ShapeOfAtom& atom : shape.atoms) {
    hash.add(std::hash<const AtomFunction*>{}(atom.function));
    add_place(atom.at);
  }
  for (const ProgramShape::Place& place : shape.arguments) add_place(place);
  for (const Function* function : shape.functions) hash.add(std::hash<const Function*>{}(function));
  return static_cast<std::size_t>(hash.value());
}

}  // namespace

ProgramShape& ProgramShapes::blank() {
  blank_.source = nullptr;
  blank_.length = blank_.constants = 0;
  blank_.nodes.clear();
  blank_.operands.clear();
  blank_.switching.clear();
  blank_.functions.clear();
  blank_.places.clear();
  blank_.atoms.clear();
  blank_.arguments.clear();
  return blank_;
}

ProgramDraft ProgramShapes::take_draft() { return std::exchange(spare_, {}); }

void ProgramShapes::give_back(ProgramDraft draft) {
  draft.clear();
  spare_ = std::move(draft);
}

std::shared_ptr<const ProgramShape> ProgramShapes::shared(const ProgramShape& shape) {
  const std::size_t hash = hash_of(shape);
  const auto [first, last] = by_hash_.equal_range(hash);
  for (auto known = first; known != last; ++known) {
    if (*known->second == shape) return known->second;
  }
  if (by_hash_.size() == most) by_hash_.clear();
  return by_hash_.emplace(hash, std::make_shared<const ProgramShape>(shape))->second;
}

}  // namespace dynalin
