// CVCV/id, IFLOAT=, ICURVE=, IRM=, JFLOAT=, JCURVE=, JRM= [, IDISP= [, IICM=]] [, JDISP= [, JICM=]] [, IVEL=] [, JVEL=]
//
// Two plane curves, in the x-y planes of the markers IRM and JRM that carry them, touch: they have a point and the
// direction of their tangent there in common. With p and R the pose of IRM from JRM and u, v the parameters of the
// points of contact, coordinates both,
//
//     p + R a(u) − b(v) = 0,     z·(R a′(u) × b′(v)) = 0          a: ICURVE, b: JCURVE, z: of JRM
//
// Removes 2 degrees of freedom. The reaction is a force across the tangent; a component along the tangent or a torque
// would do work on u and v. It acts on I at the point of contact, where the floating markers are, and the opposite on
// J.
#include "elements/families/curve_contact.h"
#include "elements/families/markers.h"

namespace dynalin {

namespace {

struct CurveOnCurve {
  static constexpr StateType state_type = StateType::cvcv;
  static constexpr std::array<std::string_view, 2> parameter_names = {"Curve parameter ALPHA(I)",
                                                                      "Curve parameter ALPHA(J)"};
  static constexpr std::array<StartArguments, 2> starts = {{{"IDISP", "IVEL"}, {"JDISP", "JVEL"}}};
  static constexpr std::array<std::string_view, 4> row_names = {"DX", "DY", "DZ", "tangent"};
  std::array<std::shared_ptr<const ParametricCurve>, 2> curves;

  template <class T>
  std::array<T, 4> rows(const RelativeFrame<T>& I, const std::array<T, 2>& u) const {
    const Vec3<T> b = curves[1]->at(u[1]), s = curves[1]->at(u[1], 1), t = turned(I, curves[0]->at(u[0], 1));
    const Vec3<T> gap = I.p + point(I, u) - b;
    const double unit = 1 / (curves[0]->least_speed() * curves[1]->least_speed());
    return {gap.x, gap.y, gap.z, (t.x * s.y - t.y * s.x) * unit};
  }
  template <class T>
  Vec3<T> point(const RelativeFrame<T>& I, const std::array<T, 2>& u) const {
    return turned(I, curves[0]->at(u[0]));
  }
  // The contact follows the poses where ∂(distance along the tangent, tangent)/∂(u, v) is regular. It is not where the
  // curves osculate: they could slide along each other with the poses unchanged.
  std::string undetermined(const RelativeFrame<double>& I, const std::array<double, 2>& u) const {
    const Vector t = turned(I, curves[0]->at(u[0], 1)), t2 = turned(I, curves[0]->at(u[0], 2));
    const Vector s = curves[1]->at(u[1], 1), s2 = curves[1]->at(u[1], 2);
    const auto curvature = [](const Vector& d, const Vector& dd) {
      return (d.x * dd.y - d.y * dd.x) / std::pow(std::hypot(d.x, d.y), 3);
    };
    const double a = curvature(t, t2) * (t.x * s.x + t.y * s.y < 0 ? -1 : 1), b = curvature(s, s2);
    const double flat = 1e-9 / std::max(norm(t), norm(s));  // a radius far beyond the size of the curves
    if (std::abs(a - b) > std::max(flat, 1e-9 * std::abs(b))) return {};
    return fmt::format(
        " has no definite point of contact: its curves have the same curvature {:.6g} where they touch, at the "
        "parameters {:.6g} and {:.6g}",
        std::abs(b) > flat ? b : 0.0, u[0], u[1]);
  }

  std::array<double, 2> nearest(const RelativeFrame<double>& I) const;

 private:
  // From the x-y plane of I into the axes of J.
  template <class T>
  static Vec3<T> turned(const RelativeFrame<T>& I, const Vec3<T>& v) {
    return I.x * v.x + I.y * v.y;
  }
};

// The parameters where the curves come closest to touching: small distance, and tangents that agree.
class NearestContact {
 public:
  NearestContact(const RelativeFrame<double>& I, const CurveOnCurve& e) : I_(I), e_(e) {}

  std::array<double, 2> find() const {
    constexpr std::size_t most = 400;  // of one curve; the best pair is made exact afterwards
    const std::vector<double> us = e_.curves[0]->samples(most), vs = e_.curves[1]->samples(most);
    double best = std::numeric_limits<double>::infinity();
    std::array<double, 2> found{us.front(), vs.front()};
    for (const double u : us) {
      for (const double v : vs) {
        const double measure = size(residual(std::array{u, v}));
        if (measure < best) best = measure, found = {u, v};
      }
    }
    return refine(found, best);
  }

 private:
  // The gap, and the angle between the tangents as a distance well below the size of the curves.
  template <class T>
  std::array<T, 4> residual(const std::array<T, 2>& u) const {
    RelativeFrame<T> I;
    for (std::size_t k = 0; k < 3; ++k) {
      I.p[k] = T(I_.p[k]), I.x[k] = T(I_.x[k]), I.y[k] = T(I_.y[k]), I.z[k] = T(I_.z[k]);
    }
    std::array<T, 4> r = e_.rows(I, u);
    r[3] = r[3] * (0.05 * std::min(e_.curves[0]->least_speed(), e_.curves[1]->least_speed()));
    return r;
  }
  static double size(const std::array<double, 4>& r) { return r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]; }

  // Gauss and Newton, halving steps that lead away.
  std::array<double, 2> refine(std::array<double, 2> u, double best) const {
    for (int iteration = 0; iteration < 60; ++iteration) {
      const auto r = residual(std::array{Dual<2>(u[0], 0), Dual<2>(u[1], 1)});
      double a = 0, b = 0, c = 0, g = 0, h = 0;
      for (const Dual<2>& x : r) {
        a += x.partial[0] * x.partial[0], b += x.partial[0] * x.partial[1], c += x.partial[1] * x.partial[1];
        g += x.partial[0] * x.value, h += x.partial[1] * x.value;
      }
      const double determinant = a * c - b * b;
      if (!(determinant > 1e-14 * a * c)) break;
      std::array<double, 2> step = {(b * h - c * g) / determinant, (b * g - a * h) / determinant};
      double fraction = 1, measure = best;
      std::array<double, 2> next = u;
      for (; fraction > 1e-3; fraction /= 2) {
        next = {u[0] + fraction * step[0], u[1] + fraction * step[1]};
        measure = size(residual(next));
        if (measure < best && e_.curves[0]->reaches(next[0]) && e_.curves[1]->reaches(next[1])) break;
      }
      if (!(measure < best) || fraction <= 1e-3) break;
      u = next, best = measure;
    }
    return u;
  }

  const RelativeFrame<double>& I_;
  const CurveOnCurve& e_;
};

std::array<double, 2> CurveOnCurve::nearest(const RelativeFrame<double>& I) const {
  return NearestContact(I, *this).find();
}

struct Cvcv {
  MarkerId ifloat, irm, iicm, jfloat, jrm, jicm;
  CurveRef icurve, jcurve;
  std::optional<Vector> idisp, jdisp;
  std::optional<double> ivel, jvel;

  static constexpr std::array<Argument<Cvcv>, 12> arguments = {{
      {.name = "IFLOAT", .slot = &Cvcv::ifloat, .required = true, .help = "floating marker on the body of IRM"},
      {.name = "ICURVE", .slot = &Cvcv::icurve, .required = true, .help = "the first curve"},
      {.name = "IRM", .slot = &Cvcv::irm, .required = true, .help = "marker in whose x-y plane ICURVE lies"},
      {.name = "JFLOAT", .slot = &Cvcv::jfloat, .required = true, .help = "floating marker on the body of JRM"},
      {.name = "JCURVE", .slot = &Cvcv::jcurve, .required = true, .help = "the second curve"},
      {.name = "JRM", .slot = &Cvcv::jrm, .required = true, .help = "marker in whose x-y plane JCURVE lies"},
      {.name = "IDISP",
       .slot = &Cvcv::idisp,
       .unit = unit::length,
       .help = "contact on ICURVE at the start",
       .start = StatedStart::alone},
      {.name = "JDISP",
       .slot = &Cvcv::jdisp,
       .unit = unit::length,
       .help = "contact on JCURVE at the start",
       .start = StatedStart::alone},
      {.name = "IVEL",
       .slot = &Cvcv::ivel,
       .unit = unit::velocity,
       .help = "its speed along ICURVE at the start",
       .start = StatedStart::alone},
      {.name = "JVEL",
       .slot = &Cvcv::jvel,
       .unit = unit::velocity,
       .help = "its speed along JCURVE at the start",
       .start = StatedStart::alone},
      {.name = "IICM", .slot = &Cvcv::iicm, .help = "marker whose axes IDISP is stated in"},
      {.name = "JICM", .slot = &Cvcv::jicm, .help = "marker whose axes JDISP is stated in"},
  }};
};

class CvcvSet final : public CurveContactSet<Cvcv, CurveOnCurve> {
 public:
  using CurveContactSet::CurveContactSet;

  void read(std::size_t k, ElementReader& reader) override {
    const Cvcv& e = elements[k];
    if (!read_arguments(elements[k], reader)) return;
    check_start_point(reader, e.iicm.valid(), e.idisp.has_value(), "IICM", "IDISP");
    check_start_point(reader, e.jicm.valid(), e.jdisp.has_value(), "JICM", "JDISP");
  }

  void finish(Model& model, Diagnostics& diagnostics) override {
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const Cvcv& e = elements[k];
      const ElementLabel& label = labels[k];
      const Curve *a = model.get<Curve>(e.icurve), *b = model.get<Curve>(e.jcurve);
      if (!check_pair(model, label, e.irm, e.jrm, {.rotation_of_I = true, .rotation_of_J = true}, diagnostics) ||
          !check_contact_marker(model, label, e.ifloat, "IFLOAT", e.irm, diagnostics) ||
          !check_contact_marker(model, label, e.jfloat, "JFLOAT", e.jrm, diagnostics) ||
          !check_start_axes(model, label, e.iicm, "IICM", e.irm, diagnostics) ||
          !check_start_axes(model, label, e.jicm, "JICM", e.jrm, diagnostics) || !a->shape || !b->shape ||
          !check_plane(model, label, e.icurve, "ICURVE", diagnostics) ||
          !check_plane(model, label, e.jcurve, "JCURVE", diagnostics)) {
        continue;
      }
      const CurveOnCurve element{{a->shape, b->shape}};
      contacts_.push_back({element,
                           e.irm,
                           e.jrm,
                           e.ifloat,
                           e.jfloat,
                           {{e.ifloat, e.irm, 0}, {e.jfloat, e.jrm, 1}},
                           start(model, e, *a, *b, element)});
    }
  }

 private:
  static bool check_plane(const Model& model, const ElementLabel& label, CurveRef ref, std::string_view argument,
                          Diagnostics& diagnostics) {
    const ParametricCurve& curve = *model.get<Curve>(ref)->shape;
    double height = 0, size = 0;
    for (const double u : curve.samples(std::numeric_limits<std::size_t>::max())) {
      const Vector p = curve.at(u);
      height = std::max(height, std::abs(p.z)), size = std::max(size, norm(p));
    }
    if (height <= 1e-9 * size) return true;
    diagnostics.error("curve-data", label.at,
                      fmt::format("{} of {}, {}, leaves the x-y plane by {:.6g}", argument, label.text(),
                                  model.label(ref).text(), height),
                      "the z of its points must be zero");
    return false;
  }

  static std::array<ContactStart, 2> start(const Model& model, const Cvcv& e, const Curve& a, const Curve& b,
                                           const CurveOnCurve& element) {
    const RelativeFrame<double> I = drawn_frame(model, e.irm, e.jrm);
    std::array<double, 2> u = element.nearest(I);
    // A stated point on one curve leaves the point next to it on the other.
    if (e.idisp) {
      u[0] = stated_parameter(model, a, *e.idisp, e.irm, e.iicm);
      u[1] = b.shape->nearest(I.p + element.point(I, u));
    }
    if (e.jdisp) {
      u[1] = stated_parameter(model, b, *e.jdisp, e.jrm, e.jicm);
      const Vector d = b.shape->at(u[1]) - I.p;
      if (!e.idisp) u[0] = a.shape->nearest({dot(I.x, d), dot(I.y, d), dot(I.z, d)});
    }
    return {{{u[0], e.idisp.has_value(), e.ivel}, {u[1], e.jdisp.has_value(), e.jvel}}};
  }
};

}  // namespace

extern constinit const Kind cvcv = curve_contact<CvcvSet, Cvcv>("CVCV", "Two plane curves touch.");

}  // namespace dynalin
