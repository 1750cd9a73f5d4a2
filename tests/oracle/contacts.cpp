// Contacts along curves, without coordinates of their own: two conditions that hold wherever the bodies are find the
// points of contact, two distances are the constraint. PTCV: the foot of the point on the curve; how far it is across
// the curve. AXCV: so, and the axes across z along the tangent. PLCV: where the curve runs along the plane; how far it
// is above it. CVCV: tangents that are parallel in
// the plane of J, and no distance along them; the distance across them, and out of the plane.
#include <stdexcept>

#include "evaluation.h"
#include "model.h"

namespace dynalin::oracle {

namespace {

// Of I, in axes of J.
template <class T>
struct Relative {
  Vector3<T> p, x, y, z;
  [[nodiscard]] Vector3<T> turned(const Vector3<T>& v) const { return v.x * x + v.y * y; }
};

template <class T>
struct Trihedron {
  Vector3<T> p;
  std::array<Vector3<T>, 3> axis;
};

template <class View>
auto placed(const View& v) {
  return Trihedron<std::decay_t<decltype(v.p().x)>>{v.p(), {v.axis(0), v.axis(1), v.axis(2)}};
}

template <class View>
auto relative(const View& i, const View& j) {
  const auto seen = [&](const auto& v) {
    auto out = v;
    out.x = dot(v, j.axis[0]), out.y = dot(v, j.axis[1]), out.z = dot(v, j.axis[2]);
    return out;
  };
  return Relative<std::decay_t<decltype(i.p.x)>>{seen(i.p - j.p), seen(i.axis[0]), seen(i.axis[1]), seen(i.axis[2])};
}

// Which two touch: a curve of I, its x-y plane, or its origin, and a curve of J.
struct Touching {
  const CurveShape* a;
  bool plane;
  const CurveShape& b;
};

template <class T>
T cross_z(const Vector3<T>& a, const Vector3<T>& b) {
  return a.x * b.y - a.y * b.x;
}

template <class T>
using Parameters = std::array<T, 2>;

// From the curve of J to what touches it.
template <class T>
Vector3<T> gap_vector(const Touching& t, const Relative<T>& I, const Parameters<T>& u) {
  return (t.a != nullptr ? I.p + I.turned(t.a->at(u[0])) : I.p) - t.b.at(u[1]);
}

template <class T>
Parameters<T> conditions(const Touching& t, const Relative<T>& I, const Parameters<T>& u) {
  const Vector3<T> d = gap_vector(t, I, u), s = t.b.at(u[1], 1);
  if (t.plane) return {u[0], dot(I.z, s)};
  if (t.a == nullptr) return {u[0], dot(d, s)};
  return {cross_z(I.turned(t.a->at(u[0], 1)), s), d.x * s.x + d.y * s.y};
}

using Slopes = std::array<std::array<Real, 2>, 2>;

// Of the parameters by the conditions.
Slopes inverse_slopes(const Touching& t, const Relative<Real>& here, const Parameters<Real>& at) {
  const auto constant = [](const Vec& v) { return Vector3<Jet>{v.x, v.y, v.z}; };
  const Relative<Jet> still{constant(here.p), constant(here.x), constant(here.y), constant(here.z)};
  const auto by_u = conditions<Jet>(t, still, {Jet(at[0], 1, 0), Jet(at[1])});
  const auto by_v = conditions<Jet>(t, still, {Jet(at[0]), Jet(at[1], 1, 0)});
  const Real determinant = by_u[0].d * by_v[1].d - by_v[0].d * by_u[1].d;
  return {{{by_v[1].d / determinant, -by_v[0].d / determinant}, {-by_u[1].d / determinant, by_u[0].d / determinant}}};
}

template <class T>
Parameters<T> improved(const Touching& t, const Slopes& s, const Relative<T>& I, const Parameters<T>& u) {
  const Parameters<T> g = conditions(t, I, u);
  return {u[0] - T(s[0][0]) * g[0] - T(s[0][1]) * g[1], u[1] - T(s[1][0]) * g[0] - T(s[1][1]) * g[1]};
}

// On a curve, global axes: x along it, y away from the centre of curvature.
template <class T, class View>
Trihedron<T> trihedron(const CurveShape& curve, const T& u, const View& carrier) {
  const auto turned = [&](const Vector3<T>& v) {
    return v.x * carrier.axis[0] + v.y * carrier.axis[1] + v.z * carrier.axis[2];
  };
  const Vector3<T> slope = curve.at(u, 1), bend = curve.at(u, 2);
  const Vector3<T> x = (T(1) / norm(slope)) * slope;
  const Vector3<T> inwards = bend - dot(bend, x) * x;
  const Vector3<T> y = (T(-1) / norm(inwards)) * inwards;
  return {carrier.p + turned(curve.at(u)), {turned(x), turned(y), turned(cross(x, y))}};
}

Vector3<Jet> differentiated(const Vector3<Jet>& v) {
  return {{v.x.d, v.x.dd, unknown()}, {v.y.d, v.y.dd, unknown()}, {v.z.d, v.z.dd, unknown()}};
}

}  // namespace

void Model::read_contacts() {
  for (const Curve& c : mechanism_.curves) curves_.emplace(c.id, CurveShape(c, number_matrix(c.matrix)));
  for (std::size_t k = 0; k < mechanism_.contacts.size(); ++k) {
    const Contact& c = mechanism_.contacts[k];
    ContactData data{c.two_curves, c.plane, marker_index(c.i), marker_index(c.j), c.icurve, c.jcurve, {}, {}, {}};
    const Vec along = curves_.at(c.jcurve).at(c.v, 1);
    const Vec aside = std::fabs(along.x) > std::fabs(along.z) ? Vec{0, 0, 1} : Vec{1, 0, 0};
    data.across[0] = cross(along, aside);
    data.across[0] = (1 / norm(data.across[0])) * data.across[0];
    data.across[1] = (1 / norm(along)) * cross(along, data.across[0]);
    contact_data_.push_back(data);
    for (const bool on_i : {false, true}) {
      if (on_i && !c.floats_on_i()) continue;
      MarkerData& floating = marker_data_[static_cast<std::size_t>(marker_index(on_i ? c.ifloat : c.jfloat))];
      floating.contact = static_cast<int>(k), floating.on_i = on_i && !c.plane;
    }
    for (int r = 0; r < c.equations(); ++r) {
      Row row{Row::Type::expression};
      row.function = contact_gap(static_cast<int>(k), r);
      rows.push_back(row);
    }
  }
}

void Model::solve_contacts() {
  for (std::size_t k = 0; k < contact_data_.size(); ++k) {
    ContactData& c = contact_data_[k];
    const Touching touching{c.two_curves ? &curves_.at(c.icurve) : nullptr, c.plane, curves_.at(c.jcurve)};
    const auto I = relative(markers_[static_cast<std::size_t>(c.i)], markers_[static_cast<std::size_t>(c.j)]);
    c.parameter = {mechanism_.contacts[k].u, mechanism_.contacts[k].v};
    if (!c.two_curves) c.parameter[0] = 0;
    Real step = 1;
    for (int iteration = 0; iteration < 40 && step > 1e-17L; ++iteration) {
      c.slopes = inverse_slopes(touching, I, c.parameter);
      const auto next = improved<Real>(touching, c.slopes, I, c.parameter);
      step = std::fabs(next[0] - c.parameter[0]) + std::fabs(next[1] - c.parameter[1]);
      c.parameter = next;
      if (iteration > 10 && step < 1e-14L) break;
    }
    if (!(step < 1e-14L)) throw std::runtime_error("a point of contact is lost");
    for (const bool on_i : {false, true}) {
      const Contact& contact = mechanism_.contacts[k];
      if (on_i && !contact.floats_on_i()) continue;
      MarkerMotion& floating = markers_[static_cast<std::size_t>(marker_index(on_i ? contact.ifloat : contact.jfloat))];
      const bool along_i = on_i && c.two_curves;
      const Trihedron<Real> at = trihedron(curves_.at(along_i ? c.icurve : c.jcurve), c.parameter[along_i ? 0 : 1],
                                           markers_[static_cast<std::size_t>(along_i ? c.i : c.j)]);
      floating.p = at.p, floating.axis = at.axis;
    }
  }
}

bool Model::touches(std::size_t contact, int body) const {
  const ContactData& c = contact_data_[contact];
  return marker_data_[static_cast<std::size_t>(c.i)].body == body ||
         marker_data_[static_cast<std::size_t>(c.j)].body == body;
}

Vec Model::contact_point(std::size_t k) const {
  const ContactData& c = contact_data_[k];
  const MarkerMotion& i = markers_[static_cast<std::size_t>(c.i)];
  if (c.plane) {
    const MarkerMotion& j = markers_[static_cast<std::size_t>(c.j)];
    const Vec at = curves_.at(c.jcurve).at(c.parameter[1]);
    return j.p + at.x * j.axis[0] + at.y * j.axis[1] + at.z * j.axis[2];
  }
  if (!c.two_curves) return i.p;
  const Vec at = curves_.at(c.icurve).at(c.parameter[0]);
  return i.p + at.x * i.axis[0] + at.y * i.axis[1];
}

Wrench Model::contact_wrench(std::size_t k) const {
  const auto b = static_cast<std::size_t>(marker_data_[static_cast<std::size_t>(contact_data_[k].i)].body);
  Wrench sum;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (!rows[r].function.node || rows[r].function.node->op != Op::gap) continue;
    if (rows[r].function.node->ids[0] != static_cast<int>(k)) continue;
    const Wrench& on_body = gradient_of(rows[r])[b];
    sum.f += lambda[r] * on_body.f;
    sum.t += lambda[r] * on_body.t;
  }
  sum.t = sum.t - cross(contact_point(k) - motion[b].p, sum.f);
  return sum;
}

template <class T>
std::array<T, 2> Evaluator<T>::contact_parameters(std::size_t k) const {
  const auto& c = model_.contact_data_[k];
  Parameters<T> u{T(c.parameter[0]), T(c.parameter[1])};
  if constexpr (std::is_same_v<T, Jet>) {
    const Touching touching{c.two_curves ? &model_.curves_.at(c.icurve) : nullptr, c.plane,
                            model_.curves_.at(c.jcurve)};
    const Contact& contact = model_.mechanism_.contacts[k];
    const Relative<T> I = relative(placed(view(contact.i)), placed(view(contact.j)));
    // Each step makes one more derivative exact.
    for (int order = 0; order < 2; ++order) u = improved<T>(touching, c.slopes, I, u);
  }
  return u;
}

template <class T>
T Evaluator<T>::gap(const Node& n) const {
  const auto k = static_cast<std::size_t>(n.ids[0]);
  const auto& c = model_.contact_data_[k];
  const Touching touching{c.two_curves ? &model_.curves_.at(c.icurve) : nullptr, c.plane, model_.curves_.at(c.jcurve)};
  const Contact& contact = model_.mechanism_.contacts[k];
  const Relative<T> I = relative(placed(view(contact.i)), placed(view(contact.j)));
  const Parameters<T> u = contact_parameters(k);
  if (n.ids[1] > 1) return dot(n.ids[1] == 2 ? I.x : I.y, touching.b.at(u[1], 1));
  const Vector3<T> d = gap_vector(touching, I, u);
  if (c.plane) return dot(I.z, d);
  if (!c.two_curves) {
    const Vec& e = c.across[static_cast<std::size_t>(n.ids[1])];
    return dot(d, Vector3<T>{T(e.x), T(e.y), T(e.z)});
  }
  if (n.ids[1] == 0) return d.z;
  const Vector3<T> s = touching.b.at(u[1], 1);
  using std::sqrt;
  return cross_z(s, d) / sqrt(s.x * s.x + s.y * s.y);
}

// Its velocity is that of the point of contact, its angular velocity that of its axes.
template <>
Evaluator<Jet>::Seen Evaluator<Jet>::contact_view(std::size_t contact, bool on_i) const {
  if (variation_ != nullptr) throw std::logic_error("no constraint may follow a point of contact");
  const auto& c = model_.contact_data_[contact];
  const Contact& written = model_.mechanism_.contacts[contact];
  const Trihedron<Jet> at =
      trihedron(model_.curves_.at(on_i ? c.icurve : c.jcurve), contact_parameters(contact)[on_i ? 0 : 1],
                placed(view(on_i ? written.i : written.j)));
  Seen out{at.p, differentiated(at.p), {}, {}, {}, at.axis};
  out.a = differentiated(out.v);
  for (const Vector3<Jet>& e : at.axis) out.w += Jet(0.5L) * cross(e, differentiated(e));
  out.al = differentiated(out.w);
  return out;
}
template <>
Evaluator<Real>::Seen Evaluator<Real>::contact_view(std::size_t contact, bool on_i) const {
  const auto along = Evaluator<Jet>(model_).contact_view(contact, on_i);
  const auto now = [](const Vector3<Jet>& v) { return Vec{v.x.v, v.y.v, v.z.v}; };
  return {now(along.p), now(along.v),  now(along.a),
          now(along.w), now(along.al), {now(along.axis[0]), now(along.axis[1]), now(along.axis[2])}};
}

std::array<Real, 2> Model::contact_speeds(std::size_t k) const {
  const ContactData& c = contact_data_[k];
  const auto u = Evaluator<Jet>(*this).contact_parameters(k);
  const Real on_i = c.two_curves ? norm(curves_.at(c.icurve).at(c.parameter[0], 1)) : 0;
  return {on_i * u[0].d, norm(curves_.at(c.jcurve).at(c.parameter[1], 1)) * u[1].d};
}

template Real Evaluator<Real>::gap(const Node&) const;
template Jet Evaluator<Jet>::gap(const Node&) const;

}  // namespace dynalin::oracle
