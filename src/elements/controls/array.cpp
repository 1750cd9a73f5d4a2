// ARRAY/id, {IC | U | X | Y} [, SIZE=], {NUMBERS= | VARIABLES=}
//
// A vector: constants (IC, or no type), values of VARIABLEs (U), or the states (X) or outputs (Y) of exactly one
// LSE, GSE or TFSISO. ARYVAL(id, n) reads entry n.
#include "elements/controls/array.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "model/model.h"
#include "model/told_beforehand.h"

namespace dynalin {

namespace {

class ArraySet final : public TypedSet<Array> {
 public:
  using TypedSet::TypedSet;
  void read(std::size_t k, ElementReader& reader) override {
    Array& a = elements[k];
    if (!read_arguments(a, reader)) return;
    const std::string name = reader.label().text();
    if (a.ic + a.u + a.x + a.y > 1) {
      reader.error("two-types", reader.statement().at, fmt::format("{} has more than one type", name),
                   "one of IC, U, X, Y");
      return;
    }
    if (a.u && a.variables.empty()) {
      reader.error("missing-argument", reader.statement().at, fmt::format("{} of type U needs VARIABLES", name));
    }
    if (!a.u && !a.variables.empty()) {
      reader.error("unexpected-argument", reader.at("VARIABLES"), fmt::format("{} is not of type U", name));
    }
    if ((a.u || a.x || a.y) && !a.numbers.empty()) {
      reader.error("unexpected-argument", reader.at("NUMBERS"), fmt::format("{} holds no constants", name));
    }
    if (!a.u && !a.x && !a.y && a.numbers.empty()) {
      reader.error("missing-argument", reader.statement().at, fmt::format("{} needs NUMBERS", name));
    }
    if (a.size && !a.x && !a.y && static_cast<std::size_t>(*a.size) != a.entries()) {
      reader.error("wrong-size", reader.at("SIZE"),
                   fmt::format("SIZE of {} is {}, it has {} entries", name, *a.size, a.entries()));
    }
  }
};

}  // namespace

void claim_array(Model& model, ArrayRef ref, const OwnedEntries& entries, ElementHandle owner,
                 const ElementLabel& owner_label, Diagnostics& diagnostics) {
  const auto& [type, size, argument, first] = entries;
  auto* set = dynamic_cast<TypedSet<Array>*>(model.sets[static_cast<std::size_t>(ref.set)].get());
  if (!set) return;
  Array& a = set->elements[static_cast<std::size_t>(ref.index)];
  const ElementLabel& label = set->labels[static_cast<std::size_t>(ref.index)];
  if (type == 'X' ? !a.x : !a.y) {
    diagnostics
        .error("wrong-array-type", owner_label.at,
               fmt::format("{} of {} must be of type {}, {} is not",
                           argument.empty() ? std::string_view(&type, 1) : argument, owner_label.text(), type,
                           label.text()))
        .notes.push_back({label.at, "it is defined here"});
    return;
  }
  if (a.owner.valid()) {
    diagnostics.error("shared-array", owner_label.at,
                      fmt::format("{} is the {} array of both {} and {}", label.text(), type,
                                  model.label(a.owner).text(), owner_label.text()));
    return;
  }
  if (a.size && static_cast<std::size_t>(*a.size) != size) {
    diagnostics.error("wrong-size", label.at,
                      fmt::format("SIZE of {} is {}, {} needs {}", label.text(), *a.size, owner_label.text(), size));
    return;
  }
  a.owner = owner;
  a.owned_size = size;
  a.owned_first = first;
}

const Array* input_array(const Model& model, ArrayRef ref, const ElementLabel& owner_label, Diagnostics& diagnostics) {
  const Array* a = model.get<Array>(ref);
  if (a && a->u) return a;
  diagnostics.error("wrong-array-type", owner_label.at,
                    fmt::format("U of {} must be of type U, {} is not", owner_label.text(), model.label(ref).text()));
  return nullptr;
}

namespace {

// Of states and outputs the element that has them says more.
std::optional<std::size_t> size_of_array(const StatementWords& s) {
  if (s.has("VARIABLES")) return known_size(s.integers("VARIABLES").size());
  if (s.has("NUMBERS")) return known_size(s.reals("NUMBERS").size());
  return known_size(static_cast<std::size_t>(std::max(s.integer("SIZE"), 0)));
}
constexpr ToldBeforehand told_of_array = {.size = size_of_array,
                                          .is_constant = [](const StatementWords& s) { return s.has("NUMBERS"); }};

}  // namespace

extern constinit const Kind array =
    Kind{"ARRAY",
         "",
         "A vector of constants, inputs, states or outputs.",
         Kind::Role::element,
         detail::argument_infos<Array>,
         [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<ArraySet>(kind); }}
        .telling(told_of_array)
        .with_example("ARRAY/1, NUMBERS=1,2");

}  // namespace dynalin
