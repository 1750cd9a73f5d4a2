#include "expression/function_manual.h"

#include "expression/expression.h"
#include "expression/functions.h"
#include "expression/vector_functions.h"

namespace dynalin {

namespace {

// IF has a colon among its arguments, so that the parser itself knows it.
constexpr FunctionText if_text = {
    "c : a, b, d", "a where c < 0, b where c = 0, d where c > 0", "as a, b, d",
    "c        what decides; a colon stands behind it\n"
    "a, b, d  only the one that is chosen is evaluated and differentiated: IF(DX(1,2) : 0, 0, -100*DX(1,2))"};

// What a statement reads where it may call a routine; no expression has it.
constexpr FunctionText user_text = {
    "p1 [, p2, …]", "what a compiled routine gives: the whole of FUNCTION, and no part of an expression",
    "of what the statement needs",
    "p1, …  numbers for the routine\n"
    "ROUTINE=library::name beside FUNCTION says which one is meant, --user-library where libraries are.\n"
    "Expressions read VARVAL(id) of a VARIABLE/id, FUNCTION=USER(…)"};

std::string_view group_of(const AtomFunction& f) {
  switch (f.family) {
    case AtomFamily::marker_measure:
      return "measures of markers";
    case AtomFamily::marker_force:
    case AtomFamily::element_force:
      return "forces and reactions";
    case AtomFamily::time:
    case AtomFamily::data:
    case AtomFamily::delay:
      break;
  }
  return "time and values of other statements";
}

// Names with a dot are combinations that the parser makes itself.
bool in_language(const AtomFunction& f) { return f.name.find('.') == std::string_view::npos; }

std::vector<FunctionEntry> gathered() {
  std::vector<FunctionEntry> all;
  for (const AtomFamily family : {AtomFamily::marker_measure, AtomFamily::marker_force, AtomFamily::element_force,
                                  AtomFamily::time, AtomFamily::data, AtomFamily::delay}) {
    for (const AtomFunction& f : atom_functions()) {
      if (f.family == family && in_language(f))
        all.push_back({f.name, group_of(f), f.text, f.minimum_arguments, f.maximum_arguments, f.built});
    }
  }
  for (const NamedConstant& c : named_constants()) all.push_back({c.name, "mathematics", c.text});
  for (const Function& f : elementary_functions())
    all.push_back({f.name, "mathematics", f.text, f.minimum_arguments, f.maximum_arguments});
  all.push_back({"IF", "mathematics", if_text, 4, 4});
  for (const auto& family : {contact_functions(), series_functions()}) {
    for (const Function& f : family)
      all.push_back({f.name, "steps, stops and series", f.text, f.minimum_arguments, f.maximum_arguments});
  }
  // Vectors of atoms take what their components take.
  for (const VectorAtom& v : vector_atoms()) {
    const AtomFunction* component = find_atom_function(v.components[0]);
    all.push_back({v.name, "vectors", v.text, component->minimum_arguments, component->maximum_arguments});
  }
  for (const bool vectors : {true, false}) {
    for (const SpecialFunction& f : special_functions()) {
      if (f.takes_vector() == vectors)
        all.push_back({f.name, vectors ? "vectors" : "splines, signals and orientation", f.text, f.minimum_arguments,
                       f.maximum_arguments});
    }
  }
  constexpr std::string_view user = "USER";
  all.push_back({user, "compiled routines", user_text, 1, 30});
  for (const auto& names : {functions_not_built(), names_not_built()}) {
    for (const std::string_view name : names) {
      if (name != user) all.push_back({name, "not available yet", {}, 0, 0, false});
    }
  }
  return all;
}

}  // namespace

const std::vector<FunctionEntry>& function_manual() {
  static const std::vector<FunctionEntry> manual = gathered();
  return manual;
}

}  // namespace dynalin
