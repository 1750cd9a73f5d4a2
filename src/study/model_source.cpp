#include "study/model_source.h"

#include <algorithm>

#include "elements/catalogue.h"

namespace dynalin {

namespace {

// Turns of angles that `before` counts go on being counted.
void add_system(Parsed<MadeModel>& made, const ModelOptions& options, const System* before = nullptr) {
  auto system = System::make(made.value.model, {options.pade ? DelayReading::pade : DelayReading::first_order,
                                                before ? angle_names(before->layout()) : std::vector<AngleName>()});
  if (system)
    made.value.system = std::move(*system);
  else
    made.diagnostics.append(std::move(system.error()));
}

bool is_among(const Diagnostics& list, const Diagnostic& d) {
  return std::ranges::any_of(list.items(), [&](const Diagnostic& other) {
    return other.code == d.code && other.message == d.message && other.at.source == d.at.source &&
           other.at.offset == d.at.offset;
  });
}

void note_warning(MadeModel& made, const Diagnostic& d) {
  repeat(d, d.at, made.warned);
  const auto& texts = made.model->further_sources;
  const auto text = std::ranges::find_if(texts, [&](const SourceRef& t) { return t.get() == d.at.source; });
  if (text != texts.end()) made.warned_in.push_back(*text);
}

}  // namespace

Parsed<MadeModel> made_model(Parsed<Dataset> parsed, Statements statements, const ModelOptions& options) {
  Parsed<MadeModel> made{{}, std::move(parsed.diagnostics)};
  const bool read = !made.diagnostics.has_errors();
  const auto dataset = std::make_shared<Dataset>(std::move(parsed.value));
  const bool kept = statements == Statements::kept;
  auto built = build_model(dataset, catalogue(),
                           {.user_value = options.user_value, .read_once = kept ? nullptr : dataset}, options.routines);
  made.value.dataset = dataset, made.value.model = std::move(built.value);
  if (!kept) dataset->release_arguments();
  for (const Diagnostic& d : built.diagnostics.items()) {
    if (d.severity != Severity::error) note_warning(made.value, d);
  }
  // Statements that could not be read leave gaps that the model would only complain about again.
  if (read || built.diagnostics.has_errors()) made.diagnostics.append(std::move(built.diagnostics));
  if (!made.diagnostics.has_errors()) add_system(made, options);
  return made;
}

Parsed<MadeModel> edited_model(const MadeModel& before, Parsed<EditedDataset> edit, const ModelOptions& options) {
  Parsed<MadeModel> made{{}, std::move(edit.diagnostics)};
  // Files that it names may have changed meanwhile.
  if (edit.value.dataset == before.dataset && before.system && before.model->input_files.empty()) {
    made.value = before;
    made.value.restated = {};
    return made;
  }
  auto built = build_model(edit.value.dataset, catalogue(), {.user_value = options.user_value, .edited = true},
                           options.routines);
  made.value.dataset = std::move(edit.value.dataset), made.value.model = std::move(built.value);
  made.value.restated = std::move(edit.value.restated);
  made.value.warned = before.warned, made.value.warned_in = before.warned_in;
  for (const Diagnostic& d : built.diagnostics.items()) {
    if (is_among(before.warned, d)) continue;
    repeat(d, d.at, made.diagnostics);
    if (d.severity != Severity::error) note_warning(made.value, d);
  }
  if (!made.diagnostics.has_errors()) add_system(made, options, before.system.get());
  return made;
}

Diagnostic& repeat(const Diagnostic& d, const Span& at, Diagnostics& to) {
  Diagnostic& added = d.severity == Severity::error ? to.error(d.code, at, d.message, d.hint)
                                                    : to.warning(d.code, at, d.message, d.hint);
  added.notes = d.notes;
  return added;
}

}  // namespace dynalin
