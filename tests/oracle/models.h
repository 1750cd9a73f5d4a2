// Models that are tested as they are: the datasets of the examples and of the manual's pages, and generated mechanisms.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "elements/catalogue.h"
#include "oracle/mechanism.h"
#include "places/examples.h"
#include "system/system.h"

namespace dynalin::oracle {

struct NamedModel {
  std::string name, text;  // the name of a file beside which others may stand
};

inline std::shared_ptr<const System> system_of(const NamedModel& m) {
  auto dataset = parse_dataset(std::make_shared<const SourceText>(m.name, m.text));
  EXPECT_FALSE(dataset.diagnostics.has_errors()) << render(dataset.diagnostics);
  auto model = build_model(std::make_shared<const Dataset>(std::move(dataset.value)), catalogue());
  EXPECT_FALSE(model.diagnostics.has_errors()) << render(model.diagnostics);
  return System::make(std::move(model.value)).value();
}

inline std::string contents_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

// Every dataset of the examples and every one in the fences of a page.
inline std::vector<NamedModel> shipped_models() {
  std::vector<NamedModel> models;
  for (const auto& file : files_of_examples(examples_folder(), ".adm")) models.push_back({file, contents_of(file)});
  const std::string fence = "```", opening = "\n```adm\n";
  for (const auto& entry : std::filesystem::directory_iterator(element_pages())) {
    const std::string page = contents_of(entry.path());
    for (auto at = page.find(opening); at != std::string::npos; at = page.find(opening, at)) {
      at += opening.size();
      models.push_back({entry.path(), page.substr(at, page.find(fence, at) - at)});
    }
  }
  std::sort(models.begin(), models.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return models;
}

inline NamedModel generated_model(std::uint64_t seed) {
  return {"generated_" + std::to_string(seed) + ".adm", dataset_text(random_mechanism(seed))};
}

// The same with every DELAY(e, tau, history) replaced by its history, the value that it has at the start.
inline std::string without_delays(std::string text) {
  const std::string name = "DELAY(";
  for (auto at = text.find(name); at != std::string::npos; at = text.find(name)) {
    std::size_t end = at + name.size(), history = end;
    for (int depth = 1; depth > 0; ++end) {
      depth += text[end] == '(' ? 1 : text[end] == ')' ? -1 : 0;
      if (depth == 1 && text[end] == ',') history = end + 1;
    }
    text.replace(at, end - at, "(" + text.substr(history, end - history));
  }
  return text;
}

}  // namespace dynalin::oracle
