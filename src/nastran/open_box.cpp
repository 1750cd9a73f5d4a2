#include "nastran/open_box.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <set>

#include "mechanics/pair_blocks.h"
#include "nastran/export_point.h"
#include "nastran/graphics.h"
#include "nastran/marker_grids.h"
#include "nastran/mode_shapes.h"
#include "nastran/names.h"
#include "nastran/open_constraints.h"
#include "nastran/open_forces.h"
#include "perturbation/perturbed_point.h"

namespace dynalin::nastran {

namespace {

class OpenBox {
 public:
  OpenBox(const Linearization& of, const AlgebraicForms& forms, const ExportOptions& options, Diagnostics& remarks)
      : of_(of),
        system_(*of.system),
        at_(*of.linear.at),
        forms_(forms),
        options_(options),
        remarks_(remarks),
        deck_(empty_deck(of)),
        points_(system_, at_.motion, options, ids_, deck_),
        markers_(system_, at_.motion, options, ids_, deck_,
                 [this](Grid& g, MarkerId m, const Matrix3& axes) { tie(g, m, axes); }),
        wrenches_(system_) {}

  StudyResult<Deck> run() {
    add_masses();
    if (auto done = markers_.add_asked(remarks_); !done) return tl::unexpected(done.error());
    if (auto done = markers_.add_channels(remarks_); !done) return tl::unexpected(done.error());
    const OpenDeck open{options_, ids_, deck_, points_, markers_, wrenches_};
    OpenConstraints constraints(system_, at_, open);
    std::vector<MatrixEntry> of_states = constraints.add();
    const Contributions contributions(system_, of_.linear, forms_, points_);
    const std::vector<MatrixEntry> rows = contributions.of_states();
    of_states.insert(of_states.end(), rows.begin(), rows.end());
    OpenForces forces(system_, at_.motion, open);
    auto done = forces.add(contributions.of_elements(), std::move(of_states), remarks_);
    if (!done) return tl::unexpected(done.error());
    markers_.warn_of_numbers(remarks_);
    warn_of_few_digits();
    const bool moving = moves(of_);
    if (options_.export_tic_cards || moving) add_velocities();
    add_graphics(system_.model(), of_.point.poses, options_, ids_, deck_, remarks_);
    if (options_.export_mode_shapes) {
      if (auto added = add_modes(of_, points_, deck_); !added) return tl::unexpected(added.error());
    }
    if (moving) {
      remarks_.warning("export-differs", {},
                       "the model moves or accelerates at this point: eigenvalues of the exported deck, which has its "
                       "forces alone, need not be those of the model");
    }
    return std::move(deck_);
  }

 private:
  static Deck empty_deck(const Linearization& of) {
    Deck deck;
    deck.open = true;
    deck.time = of.linear.model.time;
    deck.states = of.linear.model.states.size();
    return deck;
  }

  void add_masses() {
    const auto& bodies = system_.model().bodies;
    double smallest = std::numeric_limits<double>::infinity();
    for (const dynalin::Body& b : bodies) {
      if (b.kind != BodyKind::ground && b.mass > 0) smallest = std::min(smallest, b.mass);
    }
    const double small = options_.small_mass > 0                              ? options_.small_mass
                         : smallest < std::numeric_limits<double>::infinity() ? 1e-8 * smallest
                                                                              : 1e-8;
    std::vector<std::string> massless;
    for (std::size_t b = 1; b < bodies.size(); ++b) {
      const dynalin::Body& body = bodies[b];
      const BodyId id{static_cast<std::int32_t>(b)};
      if (points_.changes_shape(id)) continue;
      ConcentratedMass m;
      m.body = points_.body_in_deck(id);
      m.name = name_of("mass", body.label, options_);
      m.id = ids_.take(IdSpace::element, options_.conm2_offset + (options_.use_adams_ids ? body.label.id : 0));
      m.grid = points_.grid(id);
      m.mass = body.mass;
      const Matrix3& R = at_.motion.bodies[b].R;
      if (body.kind == BodyKind::part) m.inertia = R * body.J_BC * transpose(R);
      if (body.mass == 0) {
        m.mass = small;
        if (body.kind == BodyKind::part && trace(body.J_BC) == 0)
          m.inertia = Matrix3::diagonal(small * system_.length() * system_.length());
        massless.push_back(body.label.full_text());
      }
      deck_.masses.push_back(std::move(m));
    }
    if (massless.empty()) return;
    constexpr std::size_t most = 6;
    const bool more = massless.size() > most;
    if (more) massless.resize(most);
    remarks_.warning("export-differs", {},
                     fmt::format("a mass of {:g} is given to what has none, {}{}: it adds modes of very high frequency",
                                 small, fmt::join(massless, ", "), more ? " and others" : ""));
  }

  // What rounding leaves of the large entries of a stiffness holds the body where nothing held it.
  void warn_of_few_digits() {
    if (options_.use_dmig_long_format) return;
    const auto& bodies = system_.layout().bodies;
    for (std::size_t b = 1; b < bodies.size(); ++b) {
      if (!points_.changes_shape({static_cast<std::int32_t>(b)})) continue;
      remarks_.warning(
          "export-differs", {},
          fmt::format("three digits of the matrices of {}, which bends, do not leave it free to move as it "
                      "stands: low eigenvalues of the exported deck may be far off",
                      bodies[b].label.full_text()),
          "use_dmig_long_format = yes");
      return;
    }
  }

  // A grid at a marker goes with the grid of its body, and on a body that changes its shape with its coordinates.
  void tie(Grid& grid, MarkerId marker, const Matrix3& axes) {
    const MarkerPlace& place = system_.layout().marker(marker);
    if (!place.shapes) {
      points_.tie(grid, place.body, system_.layout().marker_label(marker).id);
      return;
    }
    std::array<std::map<std::int32_t, double>, 6> by;
    for_each_block(at_.motion, place, system_.layout(), [&](const PairBlock& b) {
      const Matrix3 moved = transpose(axes) * b.moves, turned = transpose(axes) * b.turns;
      for (std::size_t k = 0; k < b.count; ++k) {
        points_.by_centres(b.column + static_cast<std::int32_t>(k), [&](std::int32_t u, double along) {
          for (std::size_t c = 0; c < 3; ++c) by[c][u] += along * moved[k][c], by[c + 3][u] += along * turned[k][c];
        });
      }
    });
    for (int c = 0; c < 6; ++c) {
      Relation r;
      r.body = grid.body, r.name = grid.name;
      r.terms.push_back({{grid.id, c + 1}, 1.0});
      for (const auto& [u, v] : by[static_cast<std::size_t>(c)]) {
        if (v != 0.0) r.terms.push_back({points_.dof(u), -v});
      }
      deck_.relations.push_back(std::move(r));
    }
  }

  void add_velocities() {
    const auto& bodies = system_.layout().bodies;
    // A freedom that a relation gives has no initial condition of its own.
    std::set<Dof> dependent;
    for (const Relation& r : deck_.relations) dependent.insert(r.terms.front().dof);
    const auto add = [&](std::int32_t body, const ElementLabel& label, Dof dof, double velocity) {
      if (velocity != 0.0 && !dependent.contains(dof))
        deck_.initial_states.push_back({{body, name_of(label, options_)}, dof, 0, velocity});
    };
    for (std::size_t b = 1; b < bodies.size(); ++b) {
      const BodyMotion& m = at_.motion.bodies[b];
      const Vector v = m.rdot + cross(m.w, points_.arm({static_cast<std::int32_t>(b)}));
      for (std::int32_t k = 0; k < bodies[b].count; ++k) {
        add(static_cast<std::int32_t>(b) - 1, bodies[b].label, points_.dof(bodies[b].offset + k),
            (k < 3 ? v : m.w)[static_cast<std::size_t>(k % 3)]);
      }
    }
    for (const ExtraBlock& e : system_.layout().extras) {
      for (std::int32_t k = 0; k < e.count; ++k) {
        const std::int32_t coordinate = e.offset + k;
        add(-1, e.label, points_.dof(coordinate), at_.motion.extra_rate[system_.layout().extra_index(coordinate)]);
      }
    }
  }

  const Linearization& of_;
  const System& system_;
  const PerturbedPoint& at_;
  const AlgebraicForms& forms_;
  const ExportOptions& options_;
  Diagnostics& remarks_;
  Ids ids_;
  Deck deck_;
  OpenPoints points_;
  MarkerGrids markers_;
  SingleWrenches wrenches_;
};

}  // namespace

StudyResult<Deck> open_box(const Linearization& of, const ExportOptions& options, Diagnostics& remarks) {
  const auto at = linearization_for(of, options);
  if (!at) return tl::unexpected(at.error());
  const auto forms = AlgebraicForms::make(*at->system, at->linear);
  if (!forms) return tl::unexpected(StudyFailure(forms.error()));
  return OpenBox(*at, *forms, options, remarks).run();
}

}  // namespace dynalin::nastran
