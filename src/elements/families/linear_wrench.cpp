#include "elements/families/linear_wrench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "elements/families/common_frame.h"
#include "mechanics/noted_laws.h"

namespace dynalin {

namespace {

// What a routine reads: time, mode, y − LENGTH and y′.
using Read = std::array<double, 14>;

Read read_by_routine(const LinearWrench& law, const RelativeDisplacement& d, const Motion& motion) {
  Read read{motion.time, static_cast<double>(motion.mode)};
  for (std::size_t k = 0; k < 6; ++k) read[2 + k] = d.y[k] - law.length[k], read[8 + k] = d.rate[k];
  return read;
}

RoutineInputs<double> inputs(const Read& read) {
  static constexpr std::array<std::int32_t, 14> order = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13};
  return {read, order};
}

void add_routine(const LinearWrench& law, const RelativeDisplacement& d, const Motion& motion, Partials wanted,
                 Array6& load, RelativeWrench& w) {
  const Read read = read_by_routine(law, d, motion);
  for (std::size_t r = 0; r < 6; ++r) {
    load[r] = law.routine->value(inputs(read), r);
    if (wanted == Partials::no) continue;
    const std::span<const double> slope = law.routine->partials(inputs(read), r);
    for (std::size_t c = 0; c < 6; ++c) {
      for (std::size_t k = 0; k < 6; ++k) {
        w.on_pose[r][k] += slope[2 + c] * d.on_pose[c][k] + slope[8 + c] * d.rate_on_pose[c][k];
        w.on_rate[r][k] += slope[8 + c] * d.rate_on_rate[c][k];
      }
    }
  }
}

}  // namespace

LinearWrench::LinearWrench(const LinearLaw& law)
    : i(law.i), j(law.j), length(law.length), force(law.force), routine(law.routine) {
  for (std::uint8_t r = 0; r < 6; ++r) {
    for (std::uint8_t c = 0; c < 6; ++c) {
      if (law.K[r][c] != 0 || law.C[r][c] != 0) couplings.push_back({r, c, law.K[r][c], law.C[r][c]});
    }
  }
  couplings.shrink_to_fit();
}

bool LinearWrench::turns() const {
  return routine || std::any_of(force.begin() + 3, force.end(), [](double f) { return f != 0; }) ||
         std::any_of(couplings.begin(), couplings.end(), [](const Coupling& k) { return k.row >= 3 || k.column >= 3; });
}

AnglesRead LinearWrench::reads_angles() const {
  AnglesRead reads{};
  for (std::size_t k = 0; k < 3; ++k) {
    reads[k] =
        routine || std::ranges::any_of(couplings, [&](const Coupling& c) { return c.column == 3 + k && c.K != 0; });
  }
  return reads;
}

bool LinearWrench::is_central() const {
  if (routine) return false;
  const auto is_zero = [](double x) { return x == 0; };
  if (!std::all_of(force.begin(), force.begin() + 3, is_zero) ||
      !std::all_of(length.begin(), length.begin() + 3, is_zero))
    return false;
  const auto alike = [&](const Coupling& c) {
    return c.row == c.column && c.K == couplings.front().K && c.C == couplings.front().C;
  };
  return couplings.empty() || (couplings.size() == 3 && std::all_of(couplings.begin(), couplings.end(), alike));
}

namespace {

// Whether the markers are at one point as drawn and bear nothing there: the moment begins with the square of the
// motion.
bool begins_at_nothing(const Model& model, const LinearWrench& law) {
  const auto is_zero = [](double x) { return x == 0; };
  if (law.routine || !std::ranges::all_of(law.force, is_zero) || !std::ranges::all_of(law.length, is_zero))
    return false;
  const MarkerPlace& J = model.marker(law.j).place;
  return norm(drawn_frame(model, law.i, law.j).p) <=
         rounding_of_places * (norm(model.body(J.body).pose.r) + norm(J.p_BM));
}

}  // namespace

void check_moment_on_J(const Model& model, const ElementLabel& label, const LinearWrench& law,
                       Diagnostics& diagnostics) {
  const Marker& J = model.marker(law.j);
  const Body& body = model.body(J.place.body);
  if (body.kind != BodyKind::point_mass) return;
  const bool central = law.is_central();
  if (!central && !begins_at_nothing(model, law)) {
    diagnostics.error("rotation-of-point-mass", label.at,
                      fmt::format("{} acts by {} on the rotation of {}, which has none: the opposite of its force acts "
                                  "at the origin of {}",
                                  label.text(), J.label->text(), body.label.text(), model.marker(law.i).label->text()),
                      "let the marker of the point mass be I, or stiffness and damping the same in all directions");
  } else if (!central || std::ranges::any_of(law.couplings, [](const auto& c) { return c.C != 0; })) {
    diagnostics.warning(
        "moment-on-point-mass", label.at,
        fmt::format("{} has a moment about {} where {} moves away from it, and {} cannot turn: the "
                    "moment is lost",
                    label.text(), J.label->text(), model.marker(law.i).label->text(), body.label.text()),
        "let the marker of the point mass be I");
  }
}

LinearWrenchKernel::LinearWrenchKernel(const std::vector<LinearWrench>& laws, const std::vector<ElementLabel>& labels,
                                       Layout& layout)
    : labels_(&labels) {
  laws_.reserve(laws.size());
  for (std::size_t k = 0; k < laws.size(); ++k) {
    const LinearWrench& law = laws[k];
    laws_.push_back(
        {&law, &layout.marker(law.i), &layout.marker(law.j), CountedAngles(layout, law.i, law.j, law.reads_angles())});
  }
}

RelativeWrench LinearWrenchKernel::law_of(const Placed& p, const PairMotion& pair, const Motion& motion,
                                          Partials wanted) {
  const RelativeDisplacement d = relative_displacement(pair, p.angles);
  RelativeWrench w;
  w.depends_on_rate = true;
  Array6 load = p.law->force;
  for (const auto& [r, c, K, C] : p.law->couplings) {
    load[r] -= K * (d.y[c] - p.law->length[c]) + C * d.rate[c];
    for (std::size_t k = 0; k < 6; ++k) {
      w.on_pose[r][k] -= K * d.on_pose[c][k] + C * d.rate_on_pose[c][k];
      w.on_rate[r][k] -= C * d.rate_on_rate[c][k];
    }
  }
  if (p.law->routine) add_routine(*p.law, d, motion, wanted, load, w);
  w.force = {load[0], load[1], load[2]};
  w.torque = {load[3], load[4], load[5]};
  return w;
}

Array6 LinearWrenchKernel::rounding_of(const Placed& p, const PairMotion& pair) {
  const Array6 y = relative_displacement(pair, p.angles).y;
  const double far = lengths_of_places(pair);
  Array6 rounding{};
  for (const auto& [r, c, K, C] : p.law->couplings)
    rounding[r] += std::abs(K) * (std::abs(y[c]) + std::abs(p.law->length[c]) + (c < 3 ? far : 1.0));
  for (std::size_t r = 0; r < 6; ++r) rounding[r] = rounding_of_force(rounding[r], p.law->force[r]);
  return rounding;
}

void LinearWrenchKernel::equations(const Motion& motion, Equations& eq) const {
  for (const std::size_t k : eq.share(laws_.size())) {
    const Placed& p = laws_[k];
    eq.begin_element((*labels_)[k]);
    const PairMotion pair = pair_motion(motion, *p.I, *p.J);
    const RelativeWrench law = law_of(p, pair, motion, eq.wanted_partials());
    if (ElementTrace* trace = eq.noted()) note_law(pair, law, rounding_of(p, pair), eq.layout(), *trace);
    apply(pair, spread(pair, law, eq.wanted_partials()), eq);
  }
}

void LinearWrenchKernel::wrench(const Motion& motion, std::size_t k, Partials wanted, MarkerWrench& out) const {
  out.pair = pair_motion(motion, *laws_[k].I, *laws_[k].J);
  out.force = spread(out.pair, law_of(laws_[k], out.pair, motion, wanted), wanted);
}

void LinearWrenchKernel::undefined_values(const Motion& motion, UndefinedValues& undefined) const {
  const auto finite = [](double x) { return std::isfinite(x); };
  for (std::size_t k = 0; k < laws_.size(); ++k) {
    const Placed& p = laws_[k];
    const PairMotion pair = pair_motion(motion, *p.I, *p.J);
    if (auto angle = undefined_angle((*labels_)[k], p.angles.read(), pair)) {
      undefined.add(std::move(*angle));
      continue;
    }
    if (!p.law->routine) continue;
    const Read read = read_by_routine(*p.law, relative_displacement(pair, p.angles), motion);
    bool has_values = true, has_slopes = true;
    for (std::size_t r = 0; r < 6; ++r) has_values = has_values && finite(p.law->routine->value(inputs(read), r));
    for (std::size_t r = 0; r < 6 && has_values; ++r) {
      has_slopes = has_slopes && std::ranges::all_of(p.law->routine->partials(inputs(read), r).subspan(2), finite);
    }
    if (has_values && has_slopes) continue;
    const std::string reason =
        has_values ? p.law->routine->reason_of_partials(read) : p.law->routine->reason_of_value(read);
    undefined.add(UndefinedValue{&(*labels_)[k], (*labels_)[k].full_text() + ": " + reason, !has_values});
  }
}

template <std::size_t N>
bool take_values(const std::vector<double>& values, std::string_view name, std::array<double, N>& out,
                 ElementReader& reader) {
  if (values.empty()) return true;
  if (values.size() != N) {
    reader.error("wrong-count", reader.at(name),
                 fmt::format("{} of {} takes {} values, here are {}", name, reader.label().text(), N, values.size()));
    return false;
  }
  std::copy(values.begin(), values.end(), out.begin());
  return true;
}
template bool take_values(const std::vector<double>&, std::string_view, std::array<double, 3>&, ElementReader&);
template bool take_values(const std::vector<double>&, std::string_view, std::array<double, 6>&, ElementReader&);
template bool take_values(const std::vector<double>&, std::string_view, std::array<double, 21>&, ElementReader&);
template bool take_values(const std::vector<double>&, std::string_view, std::array<double, 36>&, ElementReader&);

Array66 by_columns(const std::array<double, 36>& values) {
  Array66 m{};
  for (std::size_t c = 0; c < 6; ++c) {
    for (std::size_t r = 0; r < 6; ++r) m[r][c] = values[6 * c + r];
  }
  return m;
}

Array66 scaled(const Array66& m, double factor) {
  Array66 s = m;
  for (Array6& row : s) {
    for (double& v : row) v *= factor;
  }
  return s;
}

}  // namespace dynalin
