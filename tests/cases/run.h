// Runs the program's session on dataset and command text in a folder of its own and reads back what it wrote.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <complex>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "command/session.h"
#include "places/source_tree.h"

namespace dynalin::cases {

inline std::string read_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

struct RunResult {
  int status = -1;
  std::string out, err, message;
  nlohmann::json json;
  std::filesystem::path folder;

  const nlohmann::json& result(std::size_t k) const { return json.at("results").at(k); }
  // All eigenvalues of result k in printed order, cycles per unit time.
  std::vector<std::complex<double>> eigenvalues(std::size_t k) const {
    std::vector<std::complex<double>> values;
    for (const auto& e : result(k).at("eigenvalues")) values.emplace_back(e.at("real_hz"), e.at("imag_hz"));
    return values;
  }
  std::vector<std::vector<double>> matrix(std::size_t k, const std::string& name) const {
    return result(k).at(name).get<std::vector<std::vector<double>>>();
  }
  std::vector<std::string> labels(std::size_t k) const {
    std::vector<std::string> list;
    for (const auto& s : result(k).at("states")) list.push_back(s.at("label"));
    return list;
  }
  bool wrote(const std::string& name) const { return std::filesystem::exists(folder / name); }
  std::string text(const std::string& name) const { return read_file(folder / name); }
};

class Cases : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::temp_directory_path() / ("dynalin_" + std::to_string(::getpid()) + "_" +
                                                  ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }

  RunResult run_file(const std::string& file, SessionOptions options = {}) const {
    options.file = (folder_ / file).string();
    options.json = (folder_ / "results.json").string();
    std::ostringstream out, err;
    RunResult r;
    r.status = run_session(options, out, err);
    r.out = out.str(), r.err = err.str(), r.folder = folder_;
    if (std::filesystem::exists(options.json)) r.json = nlohmann::json::parse(read_file(options.json));
    const auto message = (folder_ / file).replace_extension(".msg");
    if (std::filesystem::exists(message)) r.message = read_file(message);
    return r;
  }
  // A dataset and the commands behind the two lines that name it.
  RunResult run(const std::string& dataset, const std::string& commands, SessionOptions options = {}) const {
    write("model.adm", dataset);
    write("model.acf", "model\nmodel\n" + commands);
    return run_file("model.acf", std::move(options));
  }
  RunResult run_example(const std::string& folder, const std::string& file) const {
    std::filesystem::copy(examples_folder() / folder, folder_, std::filesystem::copy_options::recursive);
    return run_file(file);
  }

  std::filesystem::path folder_;
};

// Relative difference; where the reference is exactly zero an absolute one.
inline void expect_close(double value, double reference, double relative, double absolute = 1e-12) {
  EXPECT_NEAR(value, reference, reference == 0.0 ? absolute : relative * std::abs(reference));
}

// Printed order: reals, then each pair twice. `expected` holds one entry a pair.
inline void expect_eigenvalues(const std::vector<std::complex<double>>& values,
                               const std::vector<std::complex<double>>& expected, double relative = 1e-11) {
  std::vector<std::complex<double>> all;
  for (const auto& e : expected) {
    all.push_back(e);
    if (e.imag() != 0) all.push_back(std::conj(e));
  }
  ASSERT_EQ(values.size(), all.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    const double tolerance = std::abs(all[k]) == 0 ? 1e-12 : relative * std::abs(all[k]);
    EXPECT_LE(std::abs(values[k] - all[k]), tolerance)
        << "eigenvalue " << k + 1 << ": " << values[k] << " instead of " << all[k];
  }
}

}  // namespace dynalin::cases
