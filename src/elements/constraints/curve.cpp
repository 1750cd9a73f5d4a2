// CURVE/id, {OPEN | CLOSED}, {MATRIX= [, CURVE_POINTS | , CONTROL_POINTS[=n]] [, ORDER=k] |
//     FUNCTION=USER(…) [, MINPAR=] [, MAXPAR=]}
//
// A curve in space for what moves along it (PTCV, CVCV, PLCV, AXCV) and the function CURVE: c(u), −1 ≤ u ≤ 1, a
// B-spline of order k (degree k − 1, 4 unless stated; 2 is the polygon) through the points that the rows of the MATRIX
// hold, or along them as its control points (expression/parametric_curve.h). A closed one states its first point again
// as the last.
//
// FUNCTION calls a compiled routine of the user for the point and its derivatives. Between MINPAR and MAXPAR, −1 and 1
// unless stated, a contact is looked for and the curve is drawn; a closed one repeats with that period, an open one has
// no ends.
#include "elements/families/curve.h"

#include <fmt/format.h>

#include <algorithm>

#include "elements/controls/matrix.h"
#include "model/model.h"
#include "model/schema.h"
#include "model/told_beforehand.h"
#include "routine/curve_routine.h"
#include "routine/routine_data.h"
#include "routine/statement_words.h"

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
  Span at, controls_at, order_at, minimum_at, maximum_at;

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
      {.name = "FUNCTION",
       .slot = &WrittenCurve::function,
       .help = "USER(…): a compiled routine gives the points",
       .ends = "MATRIX CURVE_POINTS CONTROL_POINTS"},
      {.name = "MINPAR", .slot = &WrittenCurve::minimum, .help = "of FUNCTION: the first parameter, -1 unless stated"},
      {.name = "MAXPAR", .slot = &WrittenCurve::maximum, .help = "of FUNCTION: the last parameter, 1 unless stated"},
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
    w.minimum_at = reader.at("MINPAR"), w.maximum_at = reader.at("MAXPAR");
    if (w.open == w.closed) {
      reader.error(w.open ? "excluded-arguments" : "missing-argument",
                   w.open ? reader.at("CLOSED") : reader.statement().at,
                   fmt::format("{} is either OPEN or CLOSED", name));
    }
    if (w.points && w.controls.given) {
      reader.error("excluded-arguments", reader.at("CONTROL_POINTS"),
                   fmt::format("{} takes CURVE_POINTS or CONTROL_POINTS, not both", name));
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
      const auto called = routine_of(labels[k], model);
      if (called)
        make_called(k, called, diagnostics);
      else if (check_unstated(k, diagnostics))
        make(k, model, diagnostics);
      if (model.routine_data) model.routine_data->curves[static_cast<int>(labels[k].id)] = elements[k].shape;
    }
  }

 private:
  static std::shared_ptr<const CurveRoutine> routine_of(const ElementLabel& label, const Model& model) {
    if (!model.routine_data) return nullptr;
    const auto found = model.routine_data->called_curves.find(static_cast<int>(label.id));
    return found == model.routine_data->called_curves.end() ? nullptr : found->second;
  }

  bool check_unstated(std::size_t k, Diagnostics& diagnostics) const {
    const WrittenCurve& w = written_[k];
    const std::string name = labels[k].text();
    if (!w.matrix.valid()) {
      diagnostics.error("missing-argument", labels[k].at, fmt::format("{} needs MATRIX", name));
      return false;
    }
    for (const auto& [given, at] : {std::pair{w.minimum, w.minimum_at}, {w.maximum, w.maximum_at}}) {
      if (!given) continue;
      diagnostics.error("unexpected-argument", at,
                        fmt::format("{} goes with FUNCTION; the parameter of {} runs from -1 to 1", at.text(), name));
      return false;
    }
    return true;
  }

  void make_called(std::size_t k, const std::shared_ptr<const CurveRoutine>& called, Diagnostics& diagnostics) {
    const WrittenCurve& w = written_[k];
    const std::string name = labels[k].text();
    if (w.matrix.valid() || w.points || w.controls.given) {
      diagnostics.error("excluded-arguments", w.matrix.valid() ? w.at : labels[k].at,
                        fmt::format("{} is made of points or by a routine, not both", name));
      return;
    }
    const double first = called->statement().first, last = called->statement().last;
    if (!(first < last)) {
      diagnostics.error("value-out-of-range", w.minimum ? w.minimum_at : w.maximum_at,
                        fmt::format("MINPAR of {}, {:g}, must be below its MAXPAR, {:g}", name, first, last));
      return;
    }
    constexpr int places = 11;
    for (int at = 0; at <= places; ++at) {
      const double u = first + (last - first) * at / places;
      if (std::string reason = called->reason_of_value(u); !reason.empty()) {
        diagnostics.error("routine-failed", labels[k].at, fmt::format("{} cannot be used: {}", name, reason));
        return;
      }
      const std::string wrong = called->wrong_derivative(u);
      if (wrong.empty()) continue;
      diagnostics.warning("wrong-derivative", labels[k].at, wrong);
      break;
    }
    if (w.closed && !closes(*called, k, diagnostics)) return;
    elements[k].shape = std::make_shared<const ParametricCurve>(
        called, w.closed ? ParametricCurve::Shape::closed : ParametricCurve::Shape::open, first, last);
    if (elements[k].shape->least_speed() > 0) return;
    diagnostics.error("curve-data", labels[k].at, fmt::format("all points of {} are the same", name));
    elements[k].shape = nullptr;
  }

  // With its first two derivatives.
  bool closes(const CurveRoutine& called, std::size_t k, Diagnostics& diagnostics) const {
    constexpr double largest_gap = 1e-6;
    const double first = called.statement().first, last = called.statement().last;
    for (int order = 0; order < 3; ++order) {
      const Vec3<double> a = called.derivative(first, order), b = called.derivative(last, order);
      const double size = std::max(norm(called.derivative(first, 1)) * (last - first), norm(a));
      if (norm(b - a) <= largest_gap * size) continue;
      diagnostics.error(
          "curve-data", labels[k].at,
          fmt::format("{} is CLOSED, but {} at its last parameter, {:g}, is {:.6g} away from that at its first",
                      labels[k].text(), order == 0 ? "its point" : fmt::format("its derivative {}", order), last,
                      norm(b - a)),
          "MINPAR and MAXPAR are a period apart");
      return false;
    }
    return true;
  }

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

constexpr std::array<RoutineKind, 1> routines_of_curve = {
    {{.routine = "cursub", .values = 3, .arguments = RoutineArguments::curve}}};

}  // namespace

namespace {

constexpr ToldBeforehand told_of_curve = {
    .data = [](const StatementWords& s, RoutineData& data) { data.curves[s.id()]; }};

}  // namespace

extern constinit const Kind curve =
    Kind{"CURVE",
         "",
         "A curve in space, through points or along control points.",
         Kind::Role::element,
         detail::argument_infos<WrittenCurve>,
         [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<CurveSet>(kind); }}
        .calling(routines_of_curve)
        .telling(told_of_curve);

}  // namespace dynalin
