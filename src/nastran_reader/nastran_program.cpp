#include "nastran_reader/nastran_program.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/cycle.h"
#include "nastran_reader/solve.h"
#include "output/output_file.h"

namespace dynalin::nastran_reader {

namespace {

using Complex = std::complex<double>;
using Json = nlohmann::ordered_json;

enum Status : int { done = 0, wrong_input = 1, failed = 2, wrong_usage = 3 };

std::size_t warnings(const Diagnostics& all) { return all.items().size() - all.error_count(); }

std::string counted(std::size_t n, std::string_view noun) { return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s"); }

void print_summary(const Prepared& p, std::ostream& out) {
  const Deck& d = p.deck;
  const std::size_t points = p.points->all().size();
  fmt::print(out, "{}, {} degrees of freedom, {}", counted(points, "point"), p.points->freedoms(),
             counted(d.text.lines.size(), "line"));
  fmt::print(out, "; {}, of which {} redundant", counted(p.equations.rows.size(), "constraint"),
             p.elimination.redundant.size());
  fmt::print(out, "; {} independent\n", p.elimination.independent.size());
}

double damping_ratio(Complex z) { return z == Complex(0, 0) ? 0 : -z.real() / std::abs(z) + 0.0; }

void print_modes(const ModeSolution& s, std::ostream& out) {
  fmt::print(out, "{} finite eigenvalues of {} degrees of freedom, {} of them independent\n", s.eigenvalues.size(),
             s.degrees_of_freedom, s.independent);
  fmt::print(out, "{:>6} {:>20} {:>20} {:>18} {:>18} {:>12}\n", "", "real", "imaginary", "real", "imaginary",
             "damping");
  fmt::print(out, "{:>6} {:>20} {:>20} {:>18} {:>18} {:>12}\n", "number", "rad/time", "rad/time", "cycles/time",
             "cycles/time", "ratio");
  for (std::size_t k = 0; k < s.eigenvalues.size(); ++k) {
    const Complex z = s.eigenvalues[k];
    fmt::print(out, "{:>6} {:>20.12g} {:>20.12g} {:>18.10g} {:>18.10g} {:>12.6f}\n", k + 1, z.real() + 0.0,
               z.imag() + 0.0, z.real() / cycle + 0.0, z.imag() / cycle + 0.0, damping_ratio(z));
  }
}

// Of a point its components, each with real and imaginary part.
Json components(const Point& p, const Eigen::Ref<const Eigen::VectorXcd>& u) {
  Json list = Json::array();
  for (int c = 0; c < (p.scalar ? 1 : 6); ++c)
    list.push_back({u[p.first + c].real() + 0.0, u[p.first + c].imag() + 0.0});
  return list;
}

Json eigenvalue_json(Complex z) {
  return {{"real", z.real() + 0.0},
          {"imag", z.imag() + 0.0},
          {"real_hz", z.real() / cycle + 0.0},
          {"imag_hz", z.imag() / cycle + 0.0}};
}

Json json_of(const ModeSolution& s) {
  Json list = Json::array();
  for (const Complex& z : s.eigenvalues) list.push_back(eigenvalue_json(z));
  return {{"solution", 107},
          {"eigenvalues", std::move(list)},
          {"finite", s.eigenvalues.size()},
          {"zeros", s.zeros},
          {"degrees_of_freedom", s.degrees_of_freedom},
          {"independent", s.independent}};
}

Json json_of(const Prepared& p, const std::vector<ResponseCase>& cases) {
  Json list = Json::array();
  for (const ResponseCase& c : cases) {
    Json points = Json::array();
    for (const int id : c.points) {
      const Point& point = *p.points->find(id);
      Json values = Json::array();
      for (Eigen::Index f = 0; f < c.displacements.cols(); ++f)
        values.push_back(components(point, c.displacements.col(f)));
      points.push_back({{"id", id}, {"displacements", std::move(values)}});
    }
    list.push_back(
        {{"subcase", c.subcase}, {"label", c.label}, {"frequencies", c.frequencies}, {"points", std::move(points)}});
  }
  return {{"solution", 108}, {"subcases", std::move(list)}, {"degrees_of_freedom", p.points->freedoms()}};
}

void print_shape(const Prepared& p, const Eigen::VectorXcd& u, int number, std::ostream& out) {
  fmt::print(out, "\nmode {}\n", number);
  for (const Point& point : p.points->all()) {
    for (int c = 0; c < (point.scalar ? 1 : 6); ++c) {
      const Complex v = u[point.first + c];
      // Rounding of a shape whose largest component is 1.
      if (std::abs(v) < 1e-12) continue;
      fmt::print(out, "  {:<24} {:>18.10g} {:>18.10g}\n", p.points->name(point.first + c), v.real() + 0.0,
                 v.imag() + 0.0);
    }
  }
}

void print_response(const std::vector<ResponseCase>& cases, const Prepared& p, std::ostream& out) {
  for (const ResponseCase& c : cases) {
    if (c.subcase > 0) fmt::print(out, "subcase {}", c.subcase);
    fmt::print(out, "{}{}: {} frequencies\n", c.subcase > 0 ? " " : "", c.label.empty() ? "response" : c.label,
               c.frequencies.size());
    for (const int id : c.points) {
      const Point& point = *p.points->find(id);
      for (int k = 0; k < (point.scalar ? 1 : 6); ++k) {
        const auto row = c.displacements.row(point.first + k);
        if (row.isZero(0)) continue;
        fmt::print(out, "  {}\n", p.points->name(point.first + k));
        fmt::print(out, "  {:>16} {:>20} {:>20}\n", "cycles/time", "real", "imaginary");
        for (std::size_t f = 0; f < c.frequencies.size(); ++f) {
          const Complex v = row[static_cast<Eigen::Index>(f)];
          fmt::print(out, "  {:>16.10g} {:>20.12g} {:>20.12g}\n", c.frequencies[f], v.real() + 0.0, v.imag() + 0.0);
        }
      }
    }
  }
}

// Before anything is computed.
bool may_write(const std::string& name, const Prepared& p, std::ostream& err) {
  InputFiles inputs;
  for (const SourceRef& source : p.deck.text.sources) inputs.add(source->name());
  const auto destination = find_destination(name);
  const std::string* input = destination ? inputs.replaced_by(*destination) : nullptr;
  if (input) fmt::print(err, "error: --json would overwrite {}, which is read\n", *input);
  return !input;
}

int write_json(const Json& document, const std::string& name, std::ostream& out, std::ostream& err) {
  const auto fail = [&](const std::string& reason) {
    fmt::print(err, "error: {}\n", reason);
    return static_cast<int>(failed);
  };
  auto destination = find_destination(name);
  if (!destination) return fail(fmt::format("{} cannot be written: {}", name, destination.error()));
  auto file = OutputFile::create(*destination);
  if (!file) return fail(file.error());
  (*file)->stream() << document.dump(1) << '\n';
  if (const auto complete = (*file)->complete(); !complete) return fail(complete.error());
  std::vector<std::unique_ptr<OutputFile>> files;
  files.push_back(std::move(*file));
  if (const auto written = commit(files, out); !written) return fail(written.error());
  return done;
}

}  // namespace

int check_deck(const std::string& path, std::ostream& out, std::ostream& err) {
  const Prepared p = prepare(path, Purpose::check);
  err << render(p.diagnostics);
  const std::size_t errors = p.diagnostics.error_count(), warned = warnings(p.diagnostics);
  if (errors > 0) {
    fmt::print(err, "{}, {}\n", counted(errors, "error"), counted(warned, "warning"));
    return wrong_input;
  }
  print_summary(p, out);
  fmt::print(out, "{}: nothing wrong{}\n", path, warned ? fmt::format(", {}", counted(warned, "warning")) : "");
  return done;
}

int solve_deck(const SolveOptions& options, std::ostream& out, std::ostream& err) {
  Prepared p = prepare(options.deck, options.ignore_unknown ? Purpose::solve_what_is_known : Purpose::solve);
  if (p.diagnostics.has_errors()) {
    err << render(p.diagnostics);
    return wrong_input;
  }
  if (!options.json.empty() && !may_write(options.json, p, err)) return wrong_input;
  const auto give_up = [&](const std::string& reason) {
    err << render(p.diagnostics);
    fmt::print(err, "error: {}: {}\n", options.deck, reason);
    return static_cast<int>(failed);
  };
  if (p.deck.control.solution == 108) {
    if (!options.modes.empty()) {
      fmt::print(err, "error: --modes is for SOL 107, and {} is SOL 108\n", options.deck);
      return wrong_usage;
    }
    const auto cases = solve_response(p, p.diagnostics);
    if (!cases) return give_up(cases.error());
    err << render(p.diagnostics);
    if (options.json != "-") print_response(*cases, p, out);
    return options.json.empty() ? done : write_json(json_of(p, *cases), options.json, out, err);
  }
  const auto modes = solve_modes(p, p.diagnostics);
  if (!modes) return give_up(modes.error());
  err << render(p.diagnostics);
  const bool to_terminal = options.json != "-";
  if (to_terminal) print_modes(*modes, out);
  Json document = json_of(*modes);
  for (const int number : options.modes) {
    if (number < 1 || static_cast<std::size_t>(number) > modes->eigenvalues.size()) {
      fmt::print(err, "error: there is no mode {}, but 1 to {}\n", number, modes->eigenvalues.size());
      return wrong_usage;
    }
    const Complex value = modes->eigenvalues[static_cast<std::size_t>(number) - 1];
    const Eigen::VectorXcd shape = mode_shape(p, *modes, value);
    if (to_terminal) print_shape(p, shape, number, out);
    Json points = Json::array();
    for (const Point& point : p.points->all())
      points.push_back({{"id", point.id}, {"displacements", components(point, shape)}});
    document["modes"].push_back(
        {{"number", number}, {"eigenvalue", eigenvalue_json(value)}, {"points", std::move(points)}});
  }
  return options.json.empty() ? done : write_json(document, options.json, out, err);
}

}  // namespace dynalin::nastran_reader
