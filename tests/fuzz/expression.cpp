// Any bytes as a function expression: a message, or a program whose value and partial derivatives are finite numbers
// or a fault that names the function.
#include "expression/expression.h"

#include <cmath>
#include <memory>
#include <vector>

#include "base/time_taylor.h"
#include "dataset/lexer.h"
#include "expression/program_shapes.h"
#include "target.h"

namespace dynalin::fuzz {
namespace {

using Taylor = TimeTaylor<double>;

bool is_finite(double x) { return std::isfinite(x); }
bool is_finite(const Taylor& x) {
  return std::isfinite(x.value) && std::isfinite(x.rate) && std::isfinite(x.acceleration);
}

template <class T>
void evaluate_at(const Expression& e, const std::vector<T>& atoms) {
  ExpressionWorkspace<T> workspace;
  std::vector<T> partials(atoms.size());
  const std::span<const T> at(atoms);
  const T value = e.evaluate(at, std::span<T>(partials), workspace);
  const T again = e.evaluate(at, workspace);
  demand(is_finite(value) == is_finite(again), "the value depends on whether partials are wanted");
  bool all = is_finite(value);
  for (const T& p : partials) all = all && is_finite(p);
  const auto found = e.find_undefined(at, UndefinedSearch::value_and_partials);
  demand(found.has_value() == !all, found ? "a fault where all is finite" : "no fault names what is not finite");
  demand(!found || (!found->reason.empty() && !found->function.empty()), "a fault without name or reason");
  demand(e.find_undefined(at, UndefinedSearch::value).has_value() == !is_finite(value), "a fault of the value alone");
}

// Data of four points for every SPLINE and no data for a CURVE, whose value then is a fault.
void attach(SplineUse& use) {
  if (use.component || use.spectrum) return;
  auto data = std::make_shared<SplineData>();
  data->x = {-1, 0, 1, 3};
  data->y = {{2, -1, 0.5, 4}};
  use.curves = std::make_shared<const SplineCurves>(std::move(data), use.method);
}

void evaluate(const Expression& parsed) {
  const Expression e = parsed.with_curves(attach);
  const std::size_t n = e.atoms().size();
  for (const double scale : {0.0, 0.5, -1.0, 3.0, 1e-160, -1e200}) {
    std::vector<double> atoms;
    std::vector<Taylor> moving;
    for (std::size_t k = 0; k < n; ++k) {
      atoms.push_back(scale * (1 + 0.37 * static_cast<double>(k)));
      moving.emplace_back(atoms.back(), 0.3 * scale, -0.2);
    }
    evaluate_at(e, atoms);
    evaluate_at(e, moving);
  }
  e.calls();
}

}  // namespace
}  // namespace dynalin::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  using namespace dynalin;
  const fuzz::TimeLimit limit;
  const SourceText source("fuzz.adm", fuzz::text_of(bytes, count));
  Lexer lexer(source, 0);
  std::vector<Token> tokens;
  lexer.next_statement(tokens);
  Diagnostics diagnostics;
  ProgramShapes shapes;
  const Expression scalar = parse_expression(tokens, source, diagnostics, shapes);
  fuzz::demand_sound(diagnostics);
  fuzz::demand(!diagnostics.has_errors() || scalar.is_constant(), "an expression of wrong text");
  if (!diagnostics.has_errors()) fuzz::evaluate(scalar);
  Diagnostics of_vector;
  const VectorExpression vector = parse_vector_expression(tokens, source, of_vector, shapes);
  fuzz::demand_sound(of_vector);
  if (of_vector.has_errors()) return 0;
  for (const Expression& component : vector.component) fuzz::evaluate(component);
  return 0;
}
