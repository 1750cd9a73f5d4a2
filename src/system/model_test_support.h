// A System from the text of a dataset, for the tests of this folder and those above.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "elements/catalogue.h"
#include "model/model.h"
#include "system/system.h"

namespace dynalin::system_test {

// A title, units and ground with the marker 1 at the origin before the text, END behind it.
inline std::shared_ptr<const Model> model_of(const std::string& text, const std::string& units = "SYSTEM=MKS") {
  auto written = parse_dataset(std::make_shared<const SourceText>(
      "test.adm", "Test\nUNITS/" + units + "\nPART/1, GROUND\nMARKER/1\n" + text + "END\n"));
  if (written.diagnostics.has_errors()) throw std::runtime_error(render(written.diagnostics));
  auto built = build_model(std::make_shared<const Dataset>(std::move(written.value)), catalogue());
  if (built.diagnostics.has_errors()) throw std::runtime_error(render(built.diagnostics));
  return std::move(built.value);
}
inline std::shared_ptr<const System> system_of(const std::string& text, const SystemOptions& options = {}) {
  const auto model = model_of(text);  // problems point into its text
  auto made = System::make(model, options);
  if (!made) throw std::runtime_error(render(made.error()));
  return *made;
}
// "code line" of the problems that stand in the way of a System; the text begins on line 5.
inline std::vector<std::string> problems_of(const std::string& text, const SystemOptions& options = {}) {
  const auto model = model_of(text);  // problems point into its text
  const auto made = System::make(model, options);
  std::vector<std::string> list;
  if (made) return list;
  for (const Diagnostic& d : made.error().items())
    list.push_back(std::string(d.code) + " " + std::to_string(d.at.source->place(d.at.offset).line));
  return list;
}

}  // namespace dynalin::system_test
