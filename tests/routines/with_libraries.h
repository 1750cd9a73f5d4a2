// Runs datasets that call routines of libraries.
#pragma once

#include <complex>
#include <string>
#include <vector>

#include "cases/run.h"

namespace dynalin::cases {

class WithLibraries : public Cases {
 protected:
  RunResult with(const std::string& dataset, const std::vector<std::string>& libraries, bool differences = false,
                 const std::vector<std::string>& commands = {"LINEAR/EIGENSOL"}) const {
    write("model.adm", dataset + (dataset.ends_with("END\n") ? "" : "END\n"));
    std::string lines = "model\nmodel\n";
    for (const std::string& c : commands) lines += c + "\n";
    write("model.acf", lines);
    SessionOptions options;
    options.file = (folder_ / "model.acf").string();
    options.json = (folder_ / "results.json").string();
    options.user_libraries = libraries;
    options.difference_user_routines = differences;
    std::ostringstream out, err;
    RunResult r;
    r.status = run_session(options, out, err);
    r.out = out.str(), r.err = err.str();
    if (std::filesystem::exists(options.json)) r.json = nlohmann::json::parse(read_file(options.json));
    return r;
  }
  // Of the first REQUEST.
  static std::vector<double> requested(const RunResult& r, std::size_t result) {
    EXPECT_EQ(r.status, 0) << r.err;
    if (r.json.is_null()) return {};
    return r.result(result).at("operating_point").at("requests").at(0).at("values").get<std::vector<double>>();
  }
  // Relative to the largest.
  static void expect_same(const RunResult& a, const RunResult& b, double tolerance, std::size_t result = 0) {
    ASSERT_EQ(a.status, 0) << a.err;
    ASSERT_EQ(b.status, 0) << b.err;
    const auto x = a.eigenvalues(result), y = b.eigenvalues(result);
    ASSERT_EQ(x.size(), y.size());
    double largest = 0;
    for (const auto& v : y) largest = std::max(largest, std::abs(v));
    EXPECT_GT(largest, 0);
    for (std::size_t k = 0; k < x.size(); ++k) EXPECT_LE(std::abs(x[k] - y[k]), tolerance * largest) << k;
  }
};

}  // namespace dynalin::cases
