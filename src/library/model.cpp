#include "dynalin/model.h"

#include "base/read_file.h"
#include "elements/catalogue.h"
#include "library/inside.h"
#include "library/stated_elements.h"
#include "model/parameter.h"
#include "model/routine_options.h"

namespace dynalin::library {

namespace {

constexpr std::string_view activate = "ACTIVATE", deactivate = "DEACTIVATE";

[[noreturn]] void refuse(const Diagnostics& problems) { throw Error(render(problems), remarks_of(problems)); }
[[noreturn]] void refuse(const Diagnostic& problem) { throw Error(render(problem), {remark_of(problem)}); }

std::shared_ptr<const Model::Inside> made(std::unique_ptr<dynalin::Model> model, Diagnostics diagnostics,
                                          const ReadingOptions& options, std::shared_ptr<const Dataset> statements = {},
                                          EditHistory edits = {}, const System* before = nullptr) {
  if (diagnostics.has_errors()) refuse(diagnostics);
  const std::vector<SourceRef> texts = model->further_sources;  // that messages point into
  const auto system =
      System::make(std::move(model), {options.pade_delays ? DelayReading::pade : DelayReading::first_order,
                                      before ? angle_names(before->layout()) : std::vector<AngleName>()});
  if (!system) refuse(system.error());
  auto remarks = remarks_of(diagnostics);
  append(remarks, remarks_of(remarks_on(**system)));
  return std::make_shared<const Model::Inside>(*system, std::move(remarks), options, std::move(statements),
                                               std::move(edits));
}

RoutineOptions routine_options(const ReadingOptions& options) {
  return {options.user_libraries, options.difference_user_routines};
}

// A dataset whose arguments nobody needs but the model.
std::shared_ptr<const Model::Inside> read_as(Parsed<Dataset> parsed, const ReadingOptions& options) {
  Diagnostics diagnostics = std::move(parsed.diagnostics);
  if (!parsed.value.source) refuse(diagnostics);
  const bool read = !diagnostics.has_errors();
  const auto written = std::make_shared<Dataset>(std::move(parsed.value));
  auto built = build_model(written, catalogue(), {.user_value = options.user_value, .read_once = written},
                           routine_options(options));
  if (built.value->dataset == written) written->release_arguments();
  // Statements that could not be read leave gaps that the model would only complain about again.
  if (read || built.diagnostics.has_errors()) diagnostics.append(std::move(built.diagnostics));
  return made(std::move(built.value), std::move(diagnostics), options);
}

std::shared_ptr<const Model::Inside> rebuilt(const Model::Inside& before, EditedDataset edit,
                                             Diagnostics diagnostics = {}) {
  auto built = build_model(edit.dataset, catalogue(), {.user_value = before.options.user_value},
                           routine_options(before.options));
  diagnostics.append(std::move(built.diagnostics));
  return made(std::move(built.value), std::move(diagnostics), before.options, std::move(edit.dataset),
              before.edits.after(before.system, std::move(edit.restated)), before.system.get());
}

}  // namespace

Model::Inside::Inside(std::shared_ptr<const System> made, std::vector<Remark> said, const ReadingOptions& read,
                      std::shared_ptr<const Dataset> statements, EditHistory history)
    : system(std::move(made)),
      remarks(std::move(said)),
      options(read),
      edits(std::move(history)),
      statements_(std::move(statements)) {}

std::shared_ptr<const Dataset> Model::Inside::statements() const {
  std::call_once(read_, [this] {
    if (!statements_)
      statements_ = std::make_shared<const Dataset>(parse_dataset(system->model().dataset->source).value);
  });
  return statements_;
}

Model Model::read(const std::string& path, const ReadingOptions& options) {
  auto text = read_file(path);
  if (!text) {
    const std::string message = path + " cannot be read: " + text.error();
    throw Error(message, {{Remark::Severity::error, "unreadable-file", message, "", path}});
  }
  return from_text(std::move(*text), path, options);
}

Model Model::from_text(std::string dataset, std::string name, const ReadingOptions& options) {
  return Model(
      read_as(parse_dataset(std::make_shared<const SourceText>(std::move(name), std::move(dataset))), options));
}

Model Model::build(const std::string& title, const std::vector<StatedElement>& elements,
                   const ReadingOptions& options) {
  return Model(read_as(dataset_of(title, elements), options));
}

Model Model::with(const std::vector<ParameterChange>& values) const {
  auto dataset = with_parameters(inside_->statements(), values, catalogue());
  if (!dataset) refuse(dataset.error());
  return Model(rebuilt(*inside_, std::move(*dataset)));
}

Model Model::edited(const std::string& commands) const {
  static const auto names = [] {
    std::vector<std::string_view> list{activate, deactivate};
    for (const auto& statements : {redefinable_statements(), setting_statements()})
      list.insert(list.end(), statements.begin(), statements.end());
    return list;
  }();
  auto parsed = parse_statements(std::make_shared<const SourceText>("edits", commands), names);
  Diagnostics diagnostics = std::move(parsed.diagnostics);
  const auto written = std::make_shared<const Dataset>(std::move(parsed.value));
  DatasetEditor editor(inside_->statements(), written, catalogue(), diagnostics);
  for (const Statement& s : written->statements) {
    if (s.name == activate || s.name == deactivate)
      editor.switch_elements(s, s.name == deactivate, deactivatable_statements());
    else if (!s.name.empty())
      editor.redefine(s);
  }
  if (diagnostics.has_errors()) refuse(diagnostics);
  return Model(rebuilt(*inside_, std::move(editor).finish(), std::move(diagnostics)));
}

double Model::value(const ParameterRef& parameter) const {
  const auto found = dynalin::parameter(*inside_->statements(), parameter, catalogue());
  if (!found) refuse(found.error());
  return *found;
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
