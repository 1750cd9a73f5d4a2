// Runs of which NMODES and BAND ask for a part of the modes as well, without the state matrix: what they find, and say
// to be complete, is what all modes have there.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <regex>

#include "cases/both.h"

namespace dynalin::cases {

class ProgramLibraryAndSelections : public ProgramAndLibrary {
 protected:
  RunResult run_file(const std::string& file) const { return selected(file, ProgramAndLibrary::run_file(file)); }
  RunResult run(const std::string& dataset, const std::string& commands) const {
    return selected("model.acf", ProgramAndLibrary::run(dataset, commands));
  }
  RunResult run_example(const std::string& folder, const std::string& file) const {
    return selected(file, ProgramAndLibrary::run_example(folder, file));
  }

 private:
  struct Mode {
    std::complex<double> value;  // cycles per unit time
    double bound = 0;
    bool zero = false;
  };
  static std::vector<Mode> modes_of(const nlohmann::json& result) {
    std::vector<Mode> list;
    for (const auto& mode : result.at("modes")) {
      const auto& bound = mode.at("error_bound_hz");
      list.push_back({{mode.at("real_hz"), mode.at("imag_hz")},
                      bound.is_null() ? std::numeric_limits<double>::infinity() : bound.get<double>(),
                      mode.at("structural_zero").get<bool>()});
    }
    return list;
  }
  // One for one, to their bounds.
  static void expect_same(std::vector<Mode> found, std::vector<Mode> expected) {
    EXPECT_EQ(found.size(), expected.size());
    for (const Mode& m : found) {
      const auto distance = [&](const Mode& e) { return std::abs(e.value - m.value) - e.bound - m.bound; };
      const auto nearest = std::ranges::min_element(
          expected, {}, [&](const Mode& e) { return std::pair(e.zero != m.zero, distance(e)); });
      if (nearest == expected.end()) return;
      EXPECT_LE(distance(*nearest), 1e-14 * std::abs(m.value)) << m.value << " against " << nearest->value;
      EXPECT_EQ(nearest->zero, m.zero) << m.value;
      expected.erase(nearest);
    }
  }

  // A number of modes and a band drawn for each EIGENSOL, whose results stand in the order of the commands.
  struct Drawn {
    std::size_t count = 0;
    double low = 0, high = 0;
  };
  static Drawn drawn(const std::vector<Mode>& all, std::mt19937_64& random) {
    std::vector<double> moduli;
    for (const Mode& m : all) {
      if (!m.zero) moduli.push_back(std::abs(m.value));
    }
    const auto beside = [&] {
      const double modulus = moduli.empty() ? 1 : moduli[random() % moduli.size()];
      return modulus * (0.5 + std::ldexp(static_cast<double>(random() >> 11U), -53));
    };
    const double one = beside(), other = beside();
    return {1 + random() % std::max<std::size_t>(1, moduli.size()), std::min(one, other), std::max(one, other)};
  }
  // With all that are as far away as the last of them.
  static std::vector<Mode> nearest(std::vector<Mode> all, std::size_t count) {
    std::ranges::stable_sort(all, {}, [](const Mode& m) { return m.zero ? -1 : std::abs(m.value); });
    std::size_t taken = static_cast<std::size_t>(std::ranges::count_if(all, &Mode::zero)) + count;
    const auto as_far = [](const Mode& last, const Mode& next) {
      const double same = 1e-12 * std::abs(last.value);
      return std::abs(next.value) - std::abs(last.value) <= std::max({same, last.bound, next.bound});
    };
    while (taken < all.size() && as_far(all[taken - 1], all[taken])) ++taken;
    all.resize(std::min(all.size(), taken));
    return all;
  }
  static std::vector<Mode> in_band(std::vector<Mode> all, double low, double high) {
    std::erase_if(all, [&](const Mode& m) {
      const double frequency = std::abs(m.value.imag());
      return !m.zero && (frequency < low || frequency > high || std::abs(m.value.real()) > high);
    });
    return all;
  }

  RunResult selected(const std::string& file, RunResult r) const {
    if (r.status != 0) return r;
    std::vector<std::vector<Mode>> all;
    for (const auto& result : r.json.at("results")) {
      if (result.contains("modes") && !result.contains("selected")) all.push_back(modes_of(result));
    }
    static const std::regex solves("lin\\w*/eig(?!.*(band|nmodes))[^&]*", std::regex::icase);
    static const std::regex others("lin\\w*/(?!eig).*", std::regex::icase);  // of which some ask for the state matrix
    std::mt19937_64 random(all.size());
    std::vector<Drawn> selections;
    std::istringstream in(read_file(folder_ / file));
    std::string commands;
    for (std::string line; std::getline(in, line);) {
      if (std::regex_match(line, others)) continue;
      commands += line + "\n";
      if (!std::regex_match(line, solves)) continue;
      if (selections.size() == all.size()) return r;  // not a result a command: one of a loop, or of another file
      const Drawn& d = selections.emplace_back(drawn(all[selections.size()], random));
      commands += fmt::format("{0}, NMODES={1}\n{0}, BAND={2},{3}\n", line, d.count, d.low, d.high);
    }
    if (selections.empty()) return r;
    write("selected.acf", commands);
    SessionOptions options;
    options.dense_up_to = 0;
    const RunResult with = Cases::run_file("selected.acf", options);
    EXPECT_EQ(with.status, 0) << with.err;
    if (with.status != 0) return r;
    std::size_t k = 0;
    for (const auto& result : with.json.at("results")) {
      if (!result.contains("selected")) continue;
      const Drawn& d = selections.at(k / 2);
      const std::vector<Mode>& modes = all.at(k / 2);
      SCOPED_TRACE(result.at("command"));
      EXPECT_TRUE(result.at("selected").at("complete")) << result.at("selected");
      expect_same(modes_of(result), k % 2 == 0 ? nearest(modes, d.count) : in_band(modes, d.low, d.high));
      ++k;
    }
    EXPECT_EQ(k, 2 * selections.size());
    return r;
  }
};

}  // namespace dynalin::cases
