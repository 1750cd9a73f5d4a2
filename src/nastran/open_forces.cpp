#include "nastran/open_forces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "dataset/characters.h"
#include "mechanics/wrench_source.h"
#include "nastran/named_elements.h"
#include "nastran/names.h"

namespace dynalin::nastran {

OpenForces::OpenForces(const System& system, const Motion& motion, const OpenDeck& open)
    : system_(system), motion_(motion), open_(open) {}

// --- names of matrices -----------------------------------------------------------------------------------------------

// Eight characters, of which one or, of symmetric and antisymmetric parts, two come first.
std::size_t OpenForces::longest_suffix() const {
  return open_.options.split_dmigs && open_.options.solution_number == 108 ? 6 : 7;
}

StudyResult<void> OpenForces::refuse(std::string message, Diagnostics& remarks) const {
  if (!open_.options.ignore_errors) return tl::unexpected(StudyFailure({"export", std::move(message), {}}));
  remarks.warning("export-left-out", {}, message + "; the export goes on without it");
  return {};
}

StudyResult<void> OpenForces::take_suffix(const Editable& wanted, std::string_view type, Diagnostics& remarks) {
  const std::string statement = upper_case(type);
  const std::string name = wanted.id ? fmt::format("{}/{}", statement, *wanted.id) : wanted.name;
  std::int64_t id = wanted.id.value_or(0);
  if (!wanted.id) {
    const auto label = element_of_name(system_.model(), statement, wanted.name);
    if (!label) return refuse(label.error().message, remarks);
    id = (*label)->id;
  }
  const ElementLabel* found = nullptr;
  for (const auto& set : system_.model().sets) {
    if (set->kind().statement != statement || !set->active) continue;
    const auto label = std::ranges::find(set->labels, id, &ElementLabel::id);
    if (label != set->labels.end()) found = &*label;
  }
  if (!found) return refuse(fmt::format("{} does not exist", name), remarks);
  const bool plain = !wanted.suffix.empty() && std::ranges::all_of(wanted.suffix, [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0;
  });
  if (!plain || wanted.suffix.size() > longest_suffix()) {
    return refuse(fmt::format("{}: names of matrices end in up to {} letters and digits, not in \"{}\"", name,
                              longest_suffix(), wanted.suffix),
                  remarks);
  }
  for (const auto& [label, suffix] : suffix_) {
    if (suffix == upper_case(wanted.suffix) && !same_element(*label, *found))
      return refuse(fmt::format("{} and {} both have the suffix {}", label->text(), name, wanted.suffix), remarks);
  }
  if (taken_.contains(upper_case(wanted.suffix)) && !suffix_.contains(found))
    return refuse(fmt::format("{}: other matrices have the suffix {} already", name, wanted.suffix), remarks);
  suffix_[found] = upper_case(wanted.suffix);
  taken_.insert(upper_case(wanted.suffix));
  return {};
}

// The beginning of the statement and the id, or a number that nobody has.
std::string OpenForces::automatic_suffix(const ElementLabel& label) {
  const std::string id = std::to_string(label.id);
  std::string suffix, letters(label.statement);
  std::erase(letters, '_');
  if (label.id >= 0 && id.size() < 6) suffix = letters.substr(0, 6 - id.size()) + id;
  for (int k = 1; suffix.empty() || !taken_.insert(suffix).second; ++k) suffix = fmt::format("F{:05d}", k);
  return suffix;
}

StudyResult<void> OpenForces::choose_suffixes(const std::vector<Contribution>& elements, Diagnostics& remarks) {
  taken_ = {open_.options.forces_dmig_name, open_.options.differentials_dmig_name};
  for (const Editable& e : open_.options.force_editable) {
    if (auto done = take_suffix(e, e.type, remarks); !done) return done;
  }
  for (const Editable& e : open_.options.flexbody_editable) {
    if (auto done = take_suffix(e, "flex_body", remarks); !done) return done;
  }
  // By the labels of the contributions from here on.
  std::map<const ElementLabel*, std::string> of_contributions;
  std::map<std::pair<std::string_view, std::int64_t>, std::string> stated;
  for (const auto& [label, suffix] : suffix_) stated[{label->statement, label->id}] = suffix;
  for (const Contribution& c : elements) {
    const bool body = c.of == Contribution::Of::changing_body;
    if (c.of != Contribution::Of::force && !body) continue;
    const auto found = stated.find({c.element->statement, c.element->id});
    if (found != stated.end())
      of_contributions[c.element] = found->second;
    else if (body ? open_.options.all_flexbodies_editable : open_.options.all_forces_editable)
      of_contributions[c.element] = automatic_suffix(*c.element);
  }
  suffix_ = std::move(of_contributions);
  return {};
}

// --- bushes ----------------------------------------------------------------------------------------------------------

bool OpenForces::find_place(const ElementLabel& label, Place& place) {
  const ReportedWrench* reported = open_.wrenches.of(label);
  if (!reported) return false;
  const WrenchSource& source = *reported->source;
  MarkerWrench wrench;
  source.wrench(motion_, reported->which, Partials::yes, wrench);
  const MarkerId I = source.marker_I(reported->which), J = source.marker_J(reported->which);
  const bool J_fixed = J.valid() && !system_.model().marker(J).floating;
  if (!I.valid() || system_.model().marker(I).floating || !wrench.force.acts_on_J()) return false;
  if (!J_fixed && !wrench.J_follows_I) return false;
  if (wrench.pair.shapes_I || wrench.pair.shapes_J) return false;
  place.body_I = wrench.pair.body_I, place.body_J = wrench.pair.body_J;
  if (place.body_I == place.body_J) return false;
  place.I = motion_.point(system_.layout().marker(I));
  place.J = J_fixed ? motion_.point(system_.layout().marker(J)) : place.I;

  const MarkerId of_axes = source.marker_of_axes(reported->which);
  const bool known_axes = of_axes.valid() && !system_.model().marker(of_axes).floating;
  place.along_line = wrench.force.reaction == Reaction::at_J;
  const Vector line = place.I - place.J;
  if (place.along_line) {
    if (!(norm(line) > 1e-9 * system_.length())) return false;
    const Vector x = normalized(line);
    const Vector beside = std::abs(x.x) < 0.7 ? Vector{1, 0, 0} : Vector{0, 1, 0};
    const Vector z = normalized(cross(x, beside));
    place.axes = {x, cross(z, x), z};
    CoordinateSystem s;
    s.name = fmt::format("line of {}", name_of(label, open_.options));
    s.id = place.system = open_.ids.take(IdSpace::coordinate_system, open_.options.cord2r_offset);
    s.origin = place.J, s.axes = place.axes;
    open_.deck.systems.push_back(std::move(s));
  } else if (known_axes) {
    place.axes = motion_.axes(system_.layout().marker(of_axes));
    place.system = open_.markers.system_of(of_axes);
  } else {
    place.axes = Matrix3::identity();
  }
  place.grid_I = open_.markers.grid_of(I, Axes::local);
  place.grid_J = J_fixed ? open_.markers.grid_of(J, Axes::local)
                         : open_.points.add_riding_grid(
                               place.body_J, fmt::format("{}, J", name_of(label, open_.options)), place.J, 0, 0);
  return true;
}

OpenForces::AtPoint OpenForces::at_point(const std::vector<MatrixEntry>& entries, MatrixKind kind, BodyId body,
                                         const Vector& at, const Matrix3& axes) const {
  const BodyBlock& block = system_.layout().body(body);
  Matrix3 part[2][2];  // [force, moment] by [translation, rotation], at the mass centre
  for (const MatrixEntry& e : entries) {
    const std::int32_t r = e.row - block.offset, c = e.column - block.offset;
    if (e.kind != kind || r < 0 || c < 0 || r >= block.count || c >= block.count) continue;
    part[r / 3][c / 3](static_cast<std::size_t>(r % 3), static_cast<std::size_t>(c % 3)) += e.value;
  }
  // With a from the mass centre to the point, δr_C = δp + a × δθ and M_p = M_C − a × F.
  const Matrix3 a = skew(at - open_.points.centre(body));
  const Matrix3 force_by_turn = part[0][0] * a + part[0][1];
  const Matrix3 moment_by_turn = part[1][0] * a + part[1][1] - a * force_by_turn;
  const auto largest = [](const Matrix3& m) {
    double size = 0;
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) size = std::max(size, std::abs(m(r, c)));
    }
    return size;
  };
  const double arm = norm(at - open_.points.centre(body)), force = largest(part[0][0]);
  const double couplings = largest(part[0][1]) + largest(part[1][0]);
  return {transpose(axes) * part[0][0] * axes, transpose(axes) * moment_by_turn * axes, force,
          std::max({largest(part[1][1]), arm * couplings, arm * arm * force})};
}

void OpenForces::subtract(const Place& place, MatrixKind kind, const std::array<double, 6>& diagonal,
                          std::vector<MatrixEntry>& entries) const {
  for (std::size_t k = 0; k < 6; ++k) {
    if (diagonal[k] == 0.0) continue;
    const Vector axis = place.axes[k % 3];
    std::vector<std::pair<std::int32_t, double>> row;  // of D
    const auto take = [&](BodyId body, double sign) {
      const BodyBlock& block = system_.layout().body(body);
      const Vector turn = k < 3 ? cross(place.I - open_.points.centre(body), axis) : axis;
      for (std::int32_t i = 0; i < block.count; ++i) {
        const auto c = static_cast<std::size_t>(i % 3);
        const double v = i >= 3 ? turn[c] : k < 3 ? axis[c] : 0.0;
        if (v != 0.0) row.emplace_back(block.offset + i, sign * v);
      }
    };
    take(place.body_I, 1), take(place.body_J, -1);
    for (const auto& [r, a] : row) {
      for (const auto& [c, b] : row) entries.push_back({kind, r, c, -diagonal[k] * a * b});
    }
  }
}

void OpenForces::add_bush(const ElementLabel& label, std::vector<MatrixEntry>& entries, Diagnostics& remarks) {
  constexpr double rounding_of_terms = 1e-13;  // of sums over the terms of a force
  Place place;
  if (!find_place(label, place)) return;
  Bush bush;
  bush.name = name_of(label, open_.options);
  const std::int64_t id = open_.options.use_adams_ids ? label.id : 0;
  bush.id = open_.ids.take(IdSpace::element, open_.options.cbush_offset + id);
  bush.property = open_.ids.take(IdSpace::property, open_.options.pbush_offset + id);
  bush.grid_A = place.grid_J, bush.grid_B = place.grid_I, bush.system = place.system;
  bush.location = 1;
  const bool of_I = place.body_I != ground_body;
  std::string negative;  // fields of the property that would be
  for (const MatrixKind kind : {MatrixKind::K, MatrixKind::B}) {
    const AtPoint at = at_point(entries, kind, of_I ? place.body_I : place.body_J, place.I, place.axes);
    std::array<double, 6>& diagonal = kind == MatrixKind::K ? bush.stiffness : bush.damping;
    for (std::size_t k = 0; k < 6; ++k) {
      if (place.along_line && k != 0) continue;
      const double v = k < 3 ? at.translation(k, k) : at.rotation(k - 3, k - 3);
      const double least = rounding_of_terms * (k < 3 ? at.size_of_translation : at.size_of_rotation);
      diagonal[k] = v > least ? v : 0;
      if (v < -least)
        negative += fmt::format("{}{}{}", negative.empty() ? "" : ", ", "KB"[kind == MatrixKind::B], k + 1);
    }
    subtract(place, kind, diagonal, entries);
  }
  open_.deck.bushes.push_back(std::move(bush));
  if (!open_.options.export_residuals) {
    if (!negative.empty()) {
      remarks.warning(
          "export-left-out", label.at,
          fmt::format("{} is negative along {} of its CBUSH, which has nothing there, and export_residuals = no "
                      "leaves it out of the deck",
                      name_of(label, open_.options), negative));
    }
    entries.clear();
  }
  add_up(entries, rounding_of_terms);
}

// --- matrices --------------------------------------------------------------------------------------------------------

void OpenForces::add_matrices(const std::string& name, const std::string& suffix, std::vector<MatrixEntry> entries) {
  add_up(entries);
  for (const MatrixKind kind : {MatrixKind::K, MatrixKind::B, MatrixKind::M}) {
    Matrix m;
    m.name = name;
    m.kind = kind;
    m.suffix = suffix;
    for (const MatrixEntry& e : entries) {
      if (e.kind == kind) m.entries.push_back({open_.points.dof(e.row), open_.points.dof(e.column), e.value});
    }
    if (!m.entries.empty()) open_.deck.matrices.push_back(std::move(m));
  }
}

StudyResult<void> OpenForces::add(std::vector<Contribution> elements, std::vector<MatrixEntry> of_states,
                                  Diagnostics& remarks) {
  if (auto done = choose_suffixes(elements, remarks); !done) return done;
  std::vector<MatrixEntry> in_common;
  for (Contribution& c : elements) {
    if (c.of == Contribution::Of::rigid_body) continue;  // at rest it is its mass and no more
    std::vector<MatrixEntry> own;
    for (const MatrixEntry& e : c.entries) (open_.points.is_coordinate(e.column) ? own : of_states).push_back(e);
    const auto singled_out = suffix_.find(c.element);
    if (singled_out == suffix_.end()) {
      in_common.insert(in_common.end(), own.begin(), own.end());
      continue;
    }
    if (open_.options.export_cbush && c.of == Contribution::Of::force) add_bush(*c.element, own, remarks);
    add_matrices(name_of(*c.element, open_.options), singled_out->second, std::move(own));
  }
  add_matrices("forces", open_.options.forces_dmig_name, std::move(in_common));
  add_matrices("differential states", open_.options.differentials_dmig_name, std::move(of_states));
  return {};
}

}  // namespace dynalin::nastran
