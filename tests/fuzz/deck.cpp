// Any bytes as a Nastran deck: messages at their places, and of a deck without mistakes an answer of finite numbers or
// a reason.
#include <cmath>

#include "nastran_reader/solve.h"
#include "target.h"

namespace dynalin::fuzz {
namespace {

using namespace nastran_reader;

// Beyond this the time goes into matrices, which other tests know.
constexpr int largest = 80;
constexpr std::size_t most_frequencies = 50;

void demand_sound_modes(const Prepared& p, Diagnostics& diagnostics) {
  const auto modes = solve_modes(p, diagnostics);
  if (!modes) return demand(!modes.error().empty(), "no modes and no reason");
  demand(modes->eigenvalues.size() <= 2 * static_cast<std::size_t>(modes->independent),
         "more eigenvalues than unknowns");
  std::complex<double> sum = 0;
  for (const auto& z : modes->eigenvalues) sum += z;
  demand(!std::isnan(sum.real()), "an eigenvalue that is no number");
  if (!modes->eigenvalues.empty()) mode_shape(p, *modes, modes->eigenvalues[0]);
}

void demand_sound_response(const Prepared& p, Diagnostics& diagnostics) {
  const auto cases = solve_response(p, diagnostics);
  if (!cases) return demand(!cases.error().empty(), "no response and no reason");
  for (const ResponseCase& c : *cases) {
    demand(c.displacements.cols() == static_cast<Eigen::Index>(c.frequencies.size()), "frequencies without response");
  }
}

void solve(const Prepared& p) {
  Diagnostics diagnostics;
  demand(p.assembled(), "a right deck that is not assembled");
  if (p.points->freedoms() > largest) return;
  std::size_t frequencies = 0;
  for (const Frequencies& f : p.deck.frequencies) frequencies += f.values.size();
  if (p.deck.control.solution != 108) {
    demand_sound_modes(p, diagnostics);
  } else if (frequencies <= most_frequencies && p.deck.control.subcases.size() < 10) {
    demand_sound_response(p, diagnostics);
  }
  demand_sound(diagnostics);
}

}  // namespace
}  // namespace dynalin::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  using namespace dynalin;
  using namespace dynalin::nastran_reader;
  const fuzz::TimeLimit limit;
  const std::string text = fuzz::text_of(bytes, count);
  for (const Purpose purpose : {Purpose::check, Purpose::solve_what_is_known}) {
    Diagnostics reading;
    Deck deck = deck_of_text("fuzz.bdf", text, reading);
    const Prepared p = prepare(std::move(deck), std::move(reading), purpose);
    fuzz::demand_sound(p.diagnostics);
    if (purpose != Purpose::check && !p.diagnostics.has_errors()) fuzz::solve(p);
  }
  return 0;
}
