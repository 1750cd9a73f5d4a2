// Statements that a linear model does not need and whose arguments are not looked at.
#include "elements/families/kept_as_text.h"

namespace dynalin {

namespace {

constexpr Kind inert(std::string_view statement, std::string_view summary) {
  return kept_as_text(statement, summary, Kind::Role::inert).for_good();
}

}  // namespace

extern constinit const Kind femdata = inert("FEMDATA", "Output of loads for finite-element programs.");
extern constinit const Kind section = inert("SECTION", "A section of a beam, for who draws or edits it.");
extern constinit const Kind fe_node = inert("FE_NODE", "A node of a beam, for who draws or edits it.");
extern constinit const Kind timgraphics = inert("TIMGRAPHICS", "Graphics over time.");

}  // namespace dynalin
