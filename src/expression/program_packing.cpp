// From the draft of a program to the program and back.
#include <algorithm>
#include <cstring>
#include <utility>

#include "expression/program.h"

namespace dynalin {

namespace {

using Kind = ExpressionNode::Kind;

// Whether a shape, of an expression in that text, tells all there is to an atom but for the values of its arguments.
bool fits_shape(const Atom& atom, const SourceText* source) {
  if (atom.delayed || atom.at.source != source) return false;
  for (std::size_t k = atom.argument_count; k < atom.argument.size(); ++k) {
    const Atom::Place& place = atom.argument_place[k];
    if (atom.argument[k] != 0 || place.offset != 0 || place.length != 0) return false;
  }
  return true;
}

bool has_constant(Kind kind) { return kind == Kind::constant || kind == Kind::power; }

}  // namespace

ExpressionProgram::ExpressionProgram(const ProgramDraft& draft, ProgramShapes& shapes) : offset_(draft.at.offset) {
  ProgramShape& shape = shapes.blank();
  const SourceText* const source = shape.source = draft.at.source;
  for (const DraftNode& node : draft.nodes) shape.constants += has_constant(node.kind);
  const bool has_whole_atoms =
      !std::ranges::all_of(draft.atoms, [&](const Atom& atom) { return fits_shape(atom, source); });
  std::size_t arguments = 0;
  for (const Atom& atom : draft.atoms) arguments += has_whole_atoms ? 0 : atom.argument_count;
  numbers_ = std::make_unique_for_overwrite<double[]>(count_of_numbers(shape.constants, arguments));
  double* number = numbers_.get();
  More more{draft.splines, draft.routines, {}, {}};
  const auto from_start = [&](std::uint32_t offset, std::uint32_t length) {
    return ProgramShape::Place{offset - offset_, length};
  };
  shape.length = draft.at.length;
  shape.operands.assign(draft.operands.begin(), draft.operands.end());
  shape.switching = switching_nodes(draft);
  shape.nodes.reserve(draft.nodes.size());
  for (const DraftNode& node : draft.nodes) {
    ExpressionNode& packed = shape.nodes.emplace_back(ExpressionNode{node.kind, 0, node.a, node.b});
    if (has_constant(node.kind)) {
      packed.b = static_cast<std::int32_t>(number - numbers_.get());
      *number++ = node.constant;
    } else if (node.kind == Kind::call) {
      const auto known = std::ranges::find(shape.functions, node.function);
      packed.function = static_cast<std::uint16_t>(known - shape.functions.begin());
      if (known == shape.functions.end()) shape.functions.push_back(node.function);
    }
  }
  if (std::ranges::all_of(draft.places, [&](const Span& place) { return place.source == source; })) {
    shape.places.reserve(draft.places.size());
    for (const Span& place : draft.places) shape.places.push_back(from_start(place.offset, place.length));
  } else {
    more.places = draft.places;
  }
  if (has_whole_atoms) {
    more.atoms = draft.atoms;
  } else {
    auto* argument = reinterpret_cast<std::byte*>(number);
    for (const Atom& atom : draft.atoms) {
      shape.atoms.push_back({atom.function, from_start(atom.at.offset, atom.at.length),
                             static_cast<std::uint32_t>(shape.arguments.size()), atom.argument_count});
      for (std::size_t k = 0; k < atom.argument_count; ++k) {
        shape.arguments.push_back(from_start(atom.argument_place[k].offset, atom.argument_place[k].length));
        std::memcpy(argument, &atom.argument[k], sizeof atom.argument[k]);
        argument += sizeof atom.argument[k];
      }
    }
  }
  shape_ = shapes.shared(shape);
  const bool any = !more.splines.empty() || !more.routines.empty() || !more.atoms.empty() || !more.places.empty();
  if (any) more_ = std::make_unique<const More>(std::move(more));
}

ExpressionProgram::ExpressionProgram(const ExpressionProgram& other, std::vector<SplineUse> splines)
    : shape_(other.shape_), offset_(other.offset_) {
  const std::size_t count = count_of_numbers(shape_->constants, shape_->arguments.size());
  numbers_ = std::make_unique_for_overwrite<double[]>(count);
  std::copy_n(other.numbers_.get(), count, numbers_.get());
  More more = other.more_ ? *other.more_ : More{};
  more.splines = std::move(splines);
  more_ = std::make_unique<const More>(std::move(more));
}

std::span<const SplineUse> ExpressionProgram::splines() const {
  return more_ ? std::span<const SplineUse>(more_->splines) : std::span<const SplineUse>();
}
std::span<const RoutineUse> ExpressionProgram::routines() const {
  return more_ ? std::span<const RoutineUse>(more_->routines) : std::span<const RoutineUse>();
}

Span ExpressionProgram::place(std::size_t node) const {
  if (more_ && !more_->places.empty()) return more_->places[node];
  const ProgramShape::Place& place = shape_->places[node];
  return {shape_->source, offset_ + place.offset, place.length};
}

std::int32_t ExpressionProgram::argument(std::size_t number) const {
  std::int32_t value;
  const auto* const first = reinterpret_cast<const std::byte*>(numbers_.get() + shape_->constants);
  std::memcpy(&value, first + number * sizeof value, sizeof value);
  return value;
}

Atom ExpressionProgram::atom(std::size_t number) const {
  if (has_whole_atoms()) return more_->atoms[number];
  const ProgramShape::ShapeOfAtom& shape = shape_->atoms[number];
  Atom atom;
  atom.function = shape.function;
  atom.argument_count = static_cast<std::uint8_t>(shape.argument_count);
  atom.at = {shape_->source, offset_ + shape.at.offset, shape.at.length};
  for (std::size_t k = 0; k < shape.argument_count; ++k) {
    const std::size_t its_number = shape.first_argument + k;
    const ProgramShape::Place& place = shape_->arguments[its_number];
    atom.argument[k] = argument(its_number);
    atom.argument_place[k] = {offset_ + place.offset, place.length};
  }
  return atom;
}

ProgramDraft ExpressionProgram::draft() const {
  ProgramDraft draft;
  draft.at = at();
  draft.operands = shape_->operands;
  draft.splines.assign(splines().begin(), splines().end());
  draft.routines.assign(routines().begin(), routines().end());
  for (std::size_t k = 0; k < atom_count(); ++k) draft.atoms.push_back(atom(k));
  for (std::size_t k = 0; k < nodes().size(); ++k) {
    const ExpressionNode& packed = nodes()[k];
    DraftNode node{packed.kind, packed.a, packed.b};
    if (has_constant(packed.kind)) node.b = 0, node.constant = constant_of(packed);
    if (packed.kind == Kind::call) node.function = &function_of(packed);
    draft.add(node, place(k));
  }
  return draft;
}

}  // namespace dynalin
