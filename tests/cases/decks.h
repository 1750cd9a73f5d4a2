// Runs of which the linear models are exported as well: the roots of each deck, read and solved on a path of its own,
// are the eigenvalues that the program prints.
#pragma once

#include <fmt/format.h>

#include <numbers>
#include <regex>

#include "cases/selections.h"
#include "deck_roots.h"

namespace dynalin::cases {

class ProgramLibraryAndDecks : public ProgramLibraryAndSelections {
 protected:
  static std::vector<ExpectedRoot> roots_of(const nlohmann::json& result) {
    constexpr double cycle = 2 * std::numbers::pi;
    std::vector<ExpectedRoot> list;
    for (const auto& mode : result.at("modes")) {
      const auto& bound = mode.at("error_bound_hz");
      const std::complex<double> value(mode.at("real_hz"), mode.at("imag_hz"));
      // Entries of a deck carry a few roundings more than those of the program.
      const double uncertain = cycle * 1e3 * (bound.is_null() ? 0 : bound.get<double>());
      list.push_back({cycle * value, uncertain});
      if (value.imag() != 0) list.push_back({cycle * std::conj(value), uncertain});
    }
    return list;
  }

  RunResult run_file(const std::string& file) const {
    return exported(file, ProgramLibraryAndSelections::run_file(file));
  }
  RunResult run(const std::string& dataset, const std::string& commands) const {
    return exported("model.acf", ProgramLibraryAndSelections::run(dataset, commands));
  }
  RunResult run_example(const std::string& folder, const std::string& file) const {
    return exported(file, ProgramLibraryAndSelections::run_example(folder, file));
  }

 private:
  static bool at_rest(const nlohmann::json& point) {
    double most = 0;
    for (const auto& body : point.at("bodies")) {
      for (const char* name : {"velocity", "angular_velocity", "acceleration", "angular_acceleration"}) {
        for (const auto& v : body.at(name)) most = std::max(most, std::abs(v.get<double>()));
      }
    }
    return most < 1e-9;
  }

  // The same commands, each EIGENSOL followed by decks of its model; its coordinates are left to the program there.
  RunResult exported(const std::string& file, RunResult r) const {
    if (r.status != 0) return r;
    const std::string undamped_line = "use_damping = no\n";
    const std::string few_digits = "use_long_format = no\nuse_dmig_long_format = no\n";
    write("undamped.cfg", undamped_line);
    write("short.cfg", few_digits);
    write("undamped_short.cfg", few_digits + undamped_line);
    std::istringstream in(read_file(folder_ / file));
    std::string commands;
    int decks = 0, line_number = 0;
    for (std::string line; std::getline(in, line);) {
      std::string upper = line;
      for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
      const bool solves = ++line_number > 2 && upper.starts_with("LIN") && upper.find("EIG") != std::string::npos;
      if (!solves) {
        commands += line + "\n";
        continue;
      }
      const bool undamped = upper.find("NODAMP") != std::string::npos;
      commands += fmt::format(
          "LINEAR/EIGENSOL{0}\nLINEAR/EXPORT, TYPE=CLOSEDBOX, FILE=closed{1}{2}\n"
          "LINEAR/EXPORT, TYPE=OPENBOX, FILE=open{1}{2}\n"
          "LINEAR/EXPORT, TYPE=OPENBOX, FILE=short{1}, CONFIG={3}\n",
          undamped ? ", NODAMPIN" : "", ++decks, undamped ? ", CONFIG=undamped.cfg" : "",
          undamped ? "undamped_short.cfg" : "short.cfg");
    }
    if (decks == 0) return r;
    write("decks.acf", commands);
    RunResult with = Cases::run_file("decks.acf");
    const bool closed = with.err.find("OPENBOX, not as CLOSEDBOX") == std::string::npos;  // nothing can move
    if (!closed) {
      write("decks.acf", std::regex_replace(commands, std::regex("LINEAR/EXPORT, TYPE=CLOSEDBOX[^\n]*\n"), ""));
      with = Cases::run_file("decks.acf");
    }
    EXPECT_EQ(with.status, 0) << with.err;
    if (with.status != 0) return r;
    int deck = 0;
    for (const auto& result : with.json.at("results")) {
      if (!result.contains("eigenvalues")) continue;
      const std::vector<ExpectedRoot> expected = roots_of(result);
      const std::string number = std::to_string(++deck);
      if (closed) expect_roots((folder_ / ("closed" + number + ".dat")).string(), expected, 1e-8);
      if (!at_rest(result.at("operating_point"))) continue;
      expect_roots((folder_ / ("open" + number + ".dat")).string(), expected, 1e-8);
      // Three digits of the stiffness of a body that bends leave nothing of its being free to move as it stands.
      const std::string point = result.at("operating_point").dump();
      if (point.find("FE_PART") == std::string::npos && point.find("FLEX_BODY") == std::string::npos)
        expect_roots((folder_ / ("short" + number + ".dat")).string(), expected, 1e-3);
    }
    EXPECT_EQ(deck, decks);
    return r;
  }
};

}  // namespace dynalin::cases
