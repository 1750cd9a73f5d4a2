// What the tests of ENERGY_PER_MODE and MASS_PER_MODE share: the tables of a run, row by row.
#pragma once

#include <gtest/gtest.h>

#include <sstream>

#include "cases/dataset_text.h"

namespace dynalin::cases {

class ModalSumCases : public Cases {
 protected:
  // Rows of the table with the title: label and numbers, up to the empty line.
  static std::vector<std::pair<std::string, std::vector<double>>> table(const std::string& text,
                                                                        const std::string& title) {
    std::vector<std::pair<std::string, std::vector<double>>> rows;
    std::size_t at = text.find("  " + title);
    EXPECT_NE(at, std::string::npos) << title;
    if (at == std::string::npos) return rows;
    std::istringstream in(text.substr(at));
    std::string line;
    for (int skip = 0; skip < 3; ++skip) std::getline(in, line);  // title, rule, heads
    while (std::getline(in, line) && line.size() > 10) {
      std::string label = line.substr(2, 8);
      label.erase(0, label.find_first_not_of(' '));
      label.erase(label.find_last_not_of(' ') + 1);
      std::istringstream cells(line.substr(10));
      rows.push_back({label, {}});
      for (double v = 0; cells >> v;) rows.back().second.push_back(v);
    }
    return rows;
  }
  static std::vector<double> row(const std::string& text, const std::string& title, const std::string& label) {
    for (const auto& [l, values] : table(text, title)) {
      if (l == label) return values;
    }
    ADD_FAILURE() << "no row " << label << " in " << title << "\n" << text;
    return std::vector<double>(7, 0.0);
  }
  static std::vector<std::string> labels(const std::string& text, const std::string& title) {
    std::vector<std::string> all;
    for (const auto& r : table(text, title)) all.push_back(r.first);
    return all;
  }
  std::string tables(const std::string& dataset, const std::string& arguments) const {
    const RunResult r = run(dataset, "LINEAR/EIGENSOL, " + arguments + ", TABLE_PRECISION=14\n");
    EXPECT_EQ(r.status, 0) << r.err;
    return r.wrote("model.txt") ? r.text("model.txt") : std::string();
  }
};

}  // namespace dynalin::cases
