#include "dynalin/model.h"

#include "base/read_file.h"
#include "elements/catalogue.h"
#include "library/inside.h"

namespace dynalin::library {

namespace {

[[noreturn]] void refuse(const Diagnostics& problems) { throw Error(render(problems), remarks_of(problems)); }

}  // namespace

Model Model::read(const std::string& path, const ReadingOptions& options) {
  auto text = read_file(path);
  if (!text) {
    const std::string message = path + " cannot be read: " + text.error();
    throw Error(message, {{Remark::Severity::error, "unreadable-file", message, "", path}});
  }
  return from_text(std::move(*text), path, options);
}

Model Model::from_text(std::string dataset, std::string name, const ReadingOptions& options) {
  auto parsed = parse_dataset(std::make_shared<const SourceText>(std::move(name), std::move(dataset)));
  Diagnostics diagnostics = std::move(parsed.diagnostics);
  const bool read = !diagnostics.has_errors();
  const auto written = std::make_shared<Dataset>(std::move(parsed.value));
  auto built = build_model(written, catalogue(), {.user_value = options.user_value, .read_once = written});
  if (built.value->dataset == written) written->release_arguments();
  // Statements that could not be read leave gaps that the model would only complain about again.
  if (read || built.diagnostics.has_errors()) diagnostics.append(std::move(built.diagnostics));
  if (diagnostics.has_errors()) refuse(diagnostics);
  const auto system =
      System::make(std::move(built.value), {options.pade_delays ? DelayReading::pade : DelayReading::first_order});
  if (!system) refuse(system.error());
  auto inside = std::make_shared<Inside>(Inside{*system, remarks_of(diagnostics)});
  append(inside->remarks, remarks_of(remarks_on(**system)));
  return Model(std::move(inside));
}

const std::string& Model::title() const { return inside_->system->model().title; }
const Units& Model::units() const { return inside_->system->model().units; }
const std::vector<Remark>& Model::remarks() const { return inside_->remarks; }

std::vector<ElementId> Model::elements() const {
  std::vector<ElementId> list;
  for (const Statement& s : inside_->system->model().dataset->statements) {
    if (s.id) list.push_back({std::string(s.name), *s.id});
  }
  return list;
}

}  // namespace dynalin::library
