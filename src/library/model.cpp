#include "dynalin/model.h"

#include <fmt/format.h>

#include <sstream>

#include "base/read_file.h"
#include "elements/catalogue.h"
#include "library/inside.h"
#include "library/stated_elements.h"
#include "model/parameter.h"

namespace dynalin::library {

namespace {

constexpr std::string_view activate = "ACTIVATE", deactivate = "DEACTIVATE";

[[noreturn]] void refuse(const Diagnostics& problems) { throw Error(render(problems), remarks_of(problems)); }
[[noreturn]] void refuse(const Diagnostic& problem) { throw Error(render(problem), {remark_of(problem)}); }

// A dataset whose arguments nobody needs but the model.
std::shared_ptr<const Model::Inside> read_as(Parsed<Dataset> parsed, const ReadingOptions& options) {
  if (!parsed.value.source) refuse(parsed.diagnostics);
  auto made = made_model(std::move(parsed), Statements::released, model_options(options));
  if (made.diagnostics.has_errors()) refuse(made.diagnostics);
  made.diagnostics.append(remarks_on(*made.value.system));
  return std::make_shared<const Model::Inside>(std::move(made.value), remarks_of(made.diagnostics), options,
                                               Statements::released);
}

std::shared_ptr<const Model::Inside> rebuilt(const Model::Inside& before, Parsed<EditedDataset> edit,
                                             const std::vector<std::string>& changes) {
  auto made = edited_model(before, std::move(edit), model_options(before.options));
  if (made.diagnostics.has_errors()) refuse(made.diagnostics);
  made.diagnostics.append(new_remarks(remarks_on(*made.value.system), remarks_on(*before.system)));
  EditHistory edits = before.edits.after(before.system, std::move(made.value.restated));
  std::vector<std::string> all = before.changes;
  all.insert(all.end(), changes.begin(), changes.end());
  return std::make_shared<const Model::Inside>(std::move(made.value), remarks_of(made.diagnostics), before.options,
                                               Statements::kept, std::move(edits), std::move(all));
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (!line.empty()) lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace

ModelOptions model_options(const ReadingOptions& options) {
  return {options.user_value, {options.user_libraries, options.difference_user_routines}, options.pade_delays};
}

Model::Inside::Inside(MadeModel made, std::vector<Remark> said, const ReadingOptions& read, Statements statements,
                      EditHistory history, std::vector<std::string> stated)
    : MadeModel(std::move(made)),
      remarks(std::move(said)),
      options(read),
      edits(std::move(history)),
      changes(std::move(stated)),
      statements_(statements == Statements::kept ? dataset : nullptr) {}

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
  std::vector<std::string> changes;
  for (const ParameterChange& change : values)
    changes.push_back(fmt::format("{}={:.17g}", change.parameter.text(), change.value));
  return Model(rebuilt(*inside_, {std::move(*dataset), {}}, changes));
}

Model Model::edited(const std::string& commands) const {
  static const auto names = [] {
    std::vector<std::string_view> list{activate, deactivate};
    for (const auto& statements : {redefinable_statements(), setting_statements()})
      list.insert(list.end(), statements.begin(), statements.end());
    return list;
  }();
  auto parsed = parse_statements(std::make_shared<const SourceText>("edits", commands), names);
  Parsed<EditedDataset> edit{{}, std::move(parsed.diagnostics)};
  const auto written = std::make_shared<const Dataset>(std::move(parsed.value));
  DatasetEditor editor(inside_->statements(), written, catalogue(), edit.diagnostics);
  for (const Statement& s : written->statements) {
    if (s.name == activate || s.name == deactivate)
      editor.switch_elements(s, s.name == deactivate, deactivatable_statements());
    else if (!s.name.empty())
      editor.redefine(s);
  }
  if (edit.diagnostics.has_errors()) refuse(edit.diagnostics);
  edit.value = std::move(editor).finish();
  return Model(rebuilt(*inside_, std::move(edit), lines_of(commands)));
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
