// What one call of a compiled routine costs: n forces of one law, evaluated as values and with all partial derivatives,
// the law as an expression and as a routine in each of the ways that give derivatives; processor time for each force
// and pass.
//
//     routine 1000
#include <fmt/format.h>

#include <ctime>

#include "base/read_file.h"
#include "elements/catalogue.h"
#include "model/routine_options.h"
#include "system/system.h"

namespace {

using namespace dynalin;

constexpr double long_enough = 0.5;  // [s] of one measurement

std::string row_of_forces(int n, const std::string& function, const std::string& routine) {
  std::string text =
      "forces\nUNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=METER, TIME=SECOND\nPART/1, GROUND\nMARKER/1, PART=1\n";
  for (int k = 2; k < n + 2; ++k) {
    const int marker = 10 * k;
    text += fmt::format("PART/{0}, MASS=2, CM={1}, IP=1,2,3, QG={0},0,0\nMARKER/{1}, PART={0}\n", k, marker);
    text += fmt::format("SFORCE/{}, TRANSLATION, I={}, J=1, FUNCTION=", k, marker);
    text += fmt::vformat(function, fmt::make_format_args(marker)) + routine + "\n";
  }
  return text + "END\n";
}

template <class Pass>
double microseconds(int n, const Pass& pass) {
  pass();  // records patterns
  const auto now = [] { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; };
  int passes = 0;
  const double begun = now();
  double spent = 0;
  while ((spent = now() - begun) < long_enough) pass(), ++passes;
  return 1e6 * spent / passes / n;
}

int measure(int n, const char* name, const std::string& function, const std::string& routine) {
  const auto source = std::make_shared<const SourceText>("forces.adm", row_of_forces(n, function, routine));
  auto parsed = parse_dataset(source);
  auto built = build_model(std::make_shared<const Dataset>(std::move(parsed.value)), catalogue(), {},
                           RoutineOptions{.libraries = {ROUTINE_LAWS}});
  if (parsed.diagnostics.has_errors() || built.diagnostics.has_errors()) {
    fmt::print(stderr, "{}{}", render(parsed.diagnostics, 3), render(built.diagnostics, 3));
    return 1;
  }
  const auto made = System::make(std::move(built.value));
  if (!made) return fmt::print(stderr, "{}", render(made.error(), 3)), 1;
  const System& system = **made;
  Motion motion = system.motion(system.drawn());
  ConstraintRows rows;
  rows.resize(system.layout());
  system.constraints(motion, rows);
  Equations eq;
  eq.resize(system.layout());
  // What was called last is remembered, so that the time goes on.
  const double values = microseconds(n, [&] {
    motion.time += 1e-6;
    system.equations(motion, rows, eq, {});
  });
  const double partials = microseconds(n, [&] {
    motion.time += 1e-6;
    system.equations(motion, rows, eq, {PartialBy::position, PartialBy::damping, PartialBy::algebraic});
  });
  fmt::print("{:<28} {:8.2f} µs {:8.2f} µs\n", name, values, partials);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const int n = argc > 1 ? std::stoi(argv[1]) : 1000;
  fmt::print("{:<28} {:>11} {:>11}\n", "a force and pass", "values", "partials");
  const std::string called = "USER({},1,50,30,2)";
  return measure(n, "expression", "-(50*DX({0},1,1)+30*DX({0},1,1)**3+2*VX({0},1,1,1))", "") +
         measure(n, "c_syspar", called, ", ROUTINE=::by_syspar") +
         measure(n, "formula of the header", called, ", ROUTINE=::by_formula") +
         measure(n, "differences", called, ", ROUTINE=::by_nothing");
}
