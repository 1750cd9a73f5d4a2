#include "model/model_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <vector>

#include "base/enumeration.h"

namespace dynalin {

bool is_examined(std::string_view statement) {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> list;
    for (const AtomFunction& f : atom_functions()) {
      if (!f.required_argument.empty()) list.push_back(f.statement);
    }
    return list;
  }();
  return std::ranges::find(names, statement) != names.end();
}

ModelReader::ModelReader(Model& model, const Placement& placement, const ExaminedStatements& examined,
                         const DatasetWithRoutines& routines, ProgramShapes& shapes, const SourceText& source,
                         Diagnostics& diagnostics)
    : ElementReader(*placement.statement, source, diagnostics, placement.set->labels[placement.at()]),
      model_(model),
      placement_(placement),
      examined_(examined),
      routines_(routines),
      shapes_(shapes) {
  assignments.reserve(placement.statement->arguments.size());
  if (placement.variant_argument != Placement::no_variant) {
    const auto& w = placement.statement->arguments[static_cast<std::size_t>(placement.variant_argument)];
    assignments.push_back({placement.set->kind().variant, w.name});
  }
}

std::optional<MarkerId> ModelReader::marker(const WrittenInteger& id, std::string_view) {
  const auto m = model_.find_marker(id.value);
  if (!m || (id.value == 0)) {
    report_missing("MARKER", "unknown-marker", id);
    return std::nullopt;
  }
  return m;
}

std::optional<BodyId> ModelReader::body(std::string_view statement, const WrittenInteger& id) {
  const auto b = model_.find_body(statement, id.value);
  if (!b) {
    error("unknown-body", id.at,
          fmt::format("{} refers to {}/{}, which does not exist", subject(), statement, id.value));
  }
  return b;
}

std::optional<ElementHandle> ModelReader::element(std::string_view statement, const WrittenInteger& id) {
  const auto h = model_.find(statement, id.value);
  if (!h) report_missing(statement, "unknown-element", id);
  return h;
}

std::optional<Expression> ModelReader::expression(const WrittenArgument& written) {
  if (written.damaged) return std::nullopt;  // reported when the text was read
  const std::size_t before = diagnostics().error_count();
  Expression e = written.name.source == routines_.calls.get()
                     ? routine_at(written)
                     : parse_expression(written.value(), *written.name.source, diagnostics(), shapes_);
  if (diagnostics().error_count() == before) check_references(e);
  if (diagnostics().error_count() > before) return std::nullopt;
  return e;
}

std::optional<VectorExpression> ModelReader::vector_expression(const WrittenArgument& written) {
  if (written.damaged) return std::nullopt;
  const std::size_t before = diagnostics().error_count();
  VectorExpression v = parse_vector_expression(written.value(), *written.name.source, diagnostics(), shapes_);
  for (std::size_t k = 0; k < 3 && diagnostics().error_count() == before; ++k) check_references(v.component[k]);
  if (diagnostics().error_count() > before) return std::nullopt;
  return v;
}

std::optional<BodyId> ModelReader::preceding_body() const {
  if (!placement_.preceding_body.valid()) return std::nullopt;
  return placement_.preceding_body;
}

const Expression& ModelReader::routine_at(const WrittenArgument& written) const {
  Diagnostics ignored;
  return routines_.functions[static_cast<std::size_t>(read_integer(written, *written.name.source, ignored)->value)];
}

void ModelReader::report_missing(std::string_view statement, std::string_view code, const WrittenInteger& id) {
  report_once(code, id.at, fmt::format("{} refers to {}/{}, which does not exist", subject(), statement, id.value),
              near_ids(statement, id.value));
}

// What a vector function says of three components, or a rotation of nine, is one thing at one place.
void ModelReader::report_once(std::string_view code, const Span& at, std::string message, std::string hint) {
  constexpr std::size_t together = 32;  // of the same function at most
  const auto& said = diagnostics().items();
  const auto recent = std::span(said).last(std::min(said.size(), together));
  const bool known = std::ranges::any_of(recent, [&](const Diagnostic& d) {
    return d.at.source == at.source && d.at.offset == at.offset && d.message == message;
  });
  if (!known) error(code, at, std::move(message), std::move(hint));
}

std::string ModelReader::near_ids(std::string_view statement, std::int64_t id) const {
  const std::string wanted = std::to_string(id);
  std::vector<std::string> near;
  const auto consider = [&](const std::string& digits) {
    constexpr std::size_t most_digits = 10;
    if (digits.empty() || digits.size() > most_digits || digits.front() == '0' || digits == wanted) return;
    const std::int64_t candidate = std::stoll(digits);
    const bool exists = statement == "MARKER" ? model_.find_marker(candidate).has_value()
                                              : model_.find(statement, candidate).has_value();
    if (exists) near.push_back(fmt::format("{}/{}", statement, candidate));
  };
  if (wanted.front() == '-') return {};
  for (std::size_t k = 0; k <= wanted.size(); ++k) {
    const std::string before = wanted.substr(0, k), here = wanted.substr(k, 1),
                      after = wanted.substr(std::min(k + 1, wanted.size()));
    if (!here.empty()) consider(before + after);
    for (char digit = '0'; digit <= '9'; ++digit) {
      if (!here.empty()) consider(before + digit + after);
      consider(before + digit + here + after);
    }
  }
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  if (near.size() > 3) near.resize(3);
  if (near.empty()) return {};
  return fmt::format("{} {}", enumeration(near), near.size() == 1 ? "exists" : "exist");
}

void ModelReader::check_id(const Atom& atom, std::size_t k, std::string_view statement) {
  const std::int64_t id = atom.argument[k];
  const bool is_marker = statement == "MARKER";
  if (is_marker && id == 0) return;
  if (is_marker ? model_.find_marker(id).has_value() : model_.find(statement, id).has_value()) return;
  report_missing(statement, is_marker ? "unknown-marker" : "unknown-element", {id, atom.argument_at(k)});
}

void ModelReader::check_required_argument(const Atom& atom) {
  const AtomFunction& f = *atom.function;
  if (f.required_argument.empty()) return;
  const auto found = examined_.find({f.statement, atom.argument[0]});
  if (found == examined_.end()) return;
  const auto& arguments = found->second->arguments;
  const bool given = std::any_of(arguments.begin(), arguments.end(), [&](const WrittenArgument& w) {
    return find_keyword(w.name.text(), std::span(&f.required_argument, 1)).has_value();
  });
  if (given) return;
  report_once(
      "missing-argument", atom.argument_at(0),
      fmt::format("{} reads {} of {}/{}, which has none", f.name, f.required_argument, f.statement, atom.argument[0]));
}

void ModelReader::check_references(const Expression& e) {
  for (const Atom& atom : e.atoms()) check_atom(atom);
  for (const SplineUse& use : e.splines()) {
    const std::string_view statement = use.statement();
    if (use.spectrum && (model_.spectra.empty() || model_.spectra.back().id_at.offset != use.id_at.offset)) {
      model_.spectra.push_back(use);  // once, where a vector reads it three times
    }
    if (!model_.find(statement, use.id)) report_missing(statement, "unknown-element", {use.id, use.id_at});
  }
}

void ModelReader::check_atom(const Atom& atom) {
  const AtomFunction& f = *atom.function;
  switch (f.family) {
    case AtomFamily::time:
      return;
    case AtomFamily::marker_measure:
    case AtomFamily::marker_force:
      for (std::size_t k = 0; k < atom.argument_count; ++k) check_id(atom, k, "MARKER");
      return;
    case AtomFamily::data:
      if (f.statement.empty() || f.reads == DataSource::unknown) return;  // those name unknowns, and no statements
      check_id(atom, 0, f.statement);
      check_required_argument(atom);
      if (atom.argument_count > 1 && atom.argument[1] < 1) {
        report_once("value-out-of-range", atom.argument_at(1),
                    fmt::format("the second argument of {} counts from 1", f.name));
      }
      return;
    case AtomFamily::delay:
      check_references(atom.delayed->value);
      check_references(atom.delayed->lag);
      check_references(atom.delayed->history);
      if (atom.delayed->array > 0 && !model_.find("ARRAY", atom.delayed->array))
        report_missing("ARRAY", "unknown-element", {atom.delayed->array, atom.delayed->array_at});
      return;
    case AtomFamily::element_force:
      check_id(atom, 0, f.statement);
      if (atom.argument[1] != 0 && atom.argument[1] != 1) {
        report_once("value-out-of-range", atom.argument_at(1),
                    fmt::format("the second argument of {} is 0 (force on I) or 1 (force on J)", f.name));
      }
      if (atom.argument[2] < 1 || atom.argument[2] > 8) {
        report_once("value-out-of-range", atom.argument_at(2),
                    fmt::format("the third argument of {} is a component, 1 to 8: FM FX FY FZ TM TX TY TZ", f.name));
      }
      if (atom.argument_count > 3) check_id(atom, 3, "MARKER");
      return;
  }
}

}  // namespace dynalin
