// CURVE/id, {OPEN | CLOSED}, MATRIX= [, CURVE_POINTS | , CONTROL_POINTS[=n]] [, ORDER=k]
//
// A curve in space for PTCV, CVCV and the function CURVE: c(u), −1 ≤ u ≤ 1, a B-spline of order k (degree k − 1, 4
// unless stated; 2 is the polygon) through the points that the rows of the MATRIX hold, or along them as its control
// points (expression/parametric_curve.h). A closed one states its first point again as the last.
#include "elements/constraints/curve.h"

#include <fmt/format.h>

#include <algorithm>

#include "elements/controls/matrix.h"
#include "model/model.h"
#include "model/schema.h"
#include "routine/routine_data.h"

namespace dynalin {

namespace {

constexpr std::int64_t polygon = 2, cubic = 4, highest_order = 16;

struct WrittenCurve {
  bool open = false, closed = false, points = false;
  MatrixRef matrix;
  WordOrCount controls;
  std::optional<std::int64_t> order;
  UserSubroutine function{"CURSUB"};
  std::optional<double> minimum, maximum;
  Span at, controls_at, order_at;

  static constexpr std::array<Argument<WrittenCurve>, 9> arguments = {{
      {.name = "OPEN", .slot = &WrittenCurve::open, .help = "the ends may differ", .ends = "CLOSED"},
      {.name = "CLOSED", .slot = &WrittenCurve::closed, .help = "the last point is the first", .ends = "OPEN"},
      {.name = "MATRIX", .slot = &WrittenCurve::matrix, .help = "a row x, y, z for each point, at least 4"},
      {.name = "CURVE_POINTS",
       .slot = &WrittenCurve::points,
       .help = "the curve passes the points (default)",
       .ends = "CONTROL_POINTS"},
      {.name = "CONTROL_POINTS",
       .slot = &WrittenCurve::controls,
       .help = "the points control the curve",
       .ends = "CURVE_POINTS"},
      {.name = "ORDER", .slot = &WrittenCurve::order, .help = "degree + 1 of the pieces, 4 unless stated"},
      {.name = "FUNCTION", .slot = &WrittenCurve::function, .help = "USER(…): not available"},
      {.name = "MINPAR", .slot = &WrittenCurve::minimum, .help = "goes with FUNCTION"},
      {.name = "MAXPAR", .slot = &WrittenCurve::maximum, .help = "goes with FUNCTION"},
  }};
};

class CurveSet final : public TypedSet<Curve> {
 public:
  using TypedSet::TypedSet;

  void make(std::size_t k) override {
    TypedSet::make(k);
    written_.resize(k + 1);
  }

  void read(std::size_t k, ElementReader& reader) override {
    WrittenCurve& w = written_[k];
    if (!read_arguments(w, reader)) return;
    const std::string name = reader.label().text();
    w.at = reader.at("MATRIX"), w.controls_at = reader.at("CONTROL_POINTS"), w.order_at = reader.at("ORDER");
    if (w.open == w.closed) {
      reader.error(w.open ? "excluded-arguments" : "missing-argument",
                   w.open ? reader.at("CLOSED") : reader.statement().at,
                   fmt::format("{} is either OPEN or CLOSED", name));
    }
    if (!w.matrix.valid()) {
      reader.error("missing-argument", reader.statement().at, fmt::format("{} needs MATRIX", name));
    }
    if (w.points && w.controls.given) {
      reader.error("excluded-arguments", reader.at("CONTROL_POINTS"),
                   fmt::format("{} takes CURVE_POINTS or CONTROL_POINTS, not both", name));
    }
    for (const auto word : {"MINPAR", "MAXPAR"}) {
      if (!reader.given(word)) continue;
      reader.error("unexpected-argument", reader.at(word),
                   fmt::format("{} goes with FUNCTION; the parameter of {} runs from -1 to 1", word, name));
    }
    if (w.order && *w.order < polygon) {
      reader.error("value-out-of-range", w.order_at,
                   fmt::format("ORDER of {} is {}, it must be at least {}", name, *w.order, polygon));
    } else if (w.order && *w.order < cubic) {
      reader.warning("rough-curve", w.order_at,
                     fmt::format("{} of order {} has {} where its pieces meet", name, *w.order,
                                 *w.order == polygon ? "corners" : "jumps in its curvature"),
                     "a linear model holds for the piece it is taken on");
    }
  }

  void finish(Model& model, Diagnostics& diagnostics) override {
    for (std::size_t k = 0; k < elements.size(); ++k) {
      make(k, model, diagnostics);
      if (model.routine_data) model.routine_data->curves[static_cast<int>(labels[k].id)] = elements[k].shape;
    }
  }

 private:
  void make(std::size_t k, const Model& model, Diagnostics& diagnostics) {
    const WrittenCurve& w = written_[k];
    const Matrix& m = *model.get<Matrix>(w.matrix);
    const std::string name = labels[k].text(), matrix = model.label(w.matrix).text();
    if (m.columns != 3) {
      diagnostics.error("wrong-size", w.at,
                        fmt::format("{} of {} must have 3 columns, x, y and z, it has {}", matrix, name, m.columns));
      return;
    }
    if (m.rows < 4) {
      diagnostics.error("curve-data", w.at, fmt::format("{} has {} points, it needs at least 4", name, m.rows));
      return;
    }
    const std::int64_t order = w.order.value_or(cubic);
    if (order > highest_order) {
      diagnostics.error("value-out-of-range", w.order_at,
                        fmt::format("ORDER of {} is {}, it must be at most {}", name, order, highest_order),
                        "high orders swing between the points");
      return;
    }
    if (static_cast<std::size_t>(order) > m.rows) {
      diagnostics.error("value-out-of-range", w.order_at,
                        fmt::format("ORDER of {} is {}, more than its {} points allow", name, order, m.rows));
      return;
    }
    if (w.controls.count && static_cast<std::size_t>(*w.controls.count) != m.rows) {
      diagnostics.error("argument-not-built", w.controls_at,
                        fmt::format("{} has {} points and asks for {} control points; a curve that fits its points "
                                    "with another number of control points is not available",
                                    name, m.rows, *w.controls.count));
      return;
    }
    ParametricCurve::Points points;
    double extent = 0;
    for (std::size_t r = 0; r < m.rows; ++r) {
      points.push_back({m(r, 0), m(r, 1), m(r, 2)});
      extent = std::max(extent, norm(points.back() - points.front()));
    }
    if (extent == 0) {
      diagnostics.error("curve-data", w.at, fmt::format("all points of {} are the same", name));
      return;
    }
    if (const double gap = norm(points.back() - points.front()); w.closed && gap > 1e-9 * extent) {
      diagnostics.error("curve-data", w.at,
                        fmt::format("{} is CLOSED, but its last point is {:.6g} away from its first", name, gap),
                        "the first point stands once more at the end");
      return;
    }
    elements[k].shape = std::make_shared<const ParametricCurve>(
        points, w.closed ? ParametricCurve::Shape::closed : ParametricCurve::Shape::open,
        w.controls.given ? ParametricCurve::Data::control_points : ParametricCurve::Data::points,
        static_cast<int>(order));
  }

  std::vector<WrittenCurve> written_;
};

}  // namespace

extern constinit const Kind curve = {
    "CURVE",
    "",
    "A curve in space, through points or along control points.",
    Kind::Role::element,
    detail::argument_infos<WrittenCurve>,
    [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<CurveSet>(kind); }};

}  // namespace dynalin
