// Runs one of the models of tests/foreign by its own commands, and compares what it gives with an answer worked out
// here.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <functional>

#include "cases/newton_euler.h"
#include "cases/run.h"

namespace dynalin::cases {

class Foreign : public Cases {
 protected:
  // The dataset `name`.adm, its commands `name`.acf, and what else is called so.
  RunResult run_foreign(const std::string& name, SessionOptions options = {}) const {
    for (const auto& file : std::filesystem::directory_iterator(foreign_datasets())) {
      if (file.path().stem() == name) std::filesystem::copy(file.path(), folder_ / file.path().filename());
    }
    return run_file(name + ".acf", std::move(options));
  }
  static std::vector<const nlohmann::json*> all_with(const RunResult& r, const char* what) {
    std::vector<const nlohmann::json*> found;
    for (const auto& result : r.json.at("results")) {
      if (result.contains(what)) found.push_back(&result);
    }
    return found;
  }
  static const nlohmann::json& last_with(const RunResult& r, const char* what) {
    const auto found = all_with(r, what);
    if (found.empty()) throw std::runtime_error(std::string("no result has ") + what);
    return *found.back();
  }
  static Eigen::MatrixXd matrix(const nlohmann::json& result, const char* name) {
    const auto rows = result.at(name).get<std::vector<std::vector<double>>>();
    Eigen::MatrixXd a(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(rows.front().size()));
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      for (Eigen::Index k = 0; k < a.cols(); ++k)
        a(i, k) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
    }
    return a;
  }
  // Of one body at the point of a result.
  static const nlohmann::json& body_of(const nlohmann::json& result, const std::string& element) {
    for (const auto& b : result.at("operating_point").at("bodies")) {
      if (b.at("element") == element) return b;
    }
    throw std::runtime_error("no body " + element);
  }
  static Eigen::Vector3d vector(const nlohmann::json& v) {
    return {v.at(0).get<double>(), v.at(1).get<double>(), v.at(2).get<double>()};
  }

  // Each of one list has its own in the other, whatever their order; `zero` is what zeros of the other may be.
  static void expect_spectrum(const nlohmann::json& result, std::vector<std::complex<double>> expected, double relative,
                              double zero) {
    ASSERT_EQ(result.at("eigenvalues").size(), expected.size());
    for (const auto& e : result.at("eigenvalues")) {
      const std::complex<double> v(e.at("real_hz"), e.at("imag_hz"));
      const auto nearest =
          std::ranges::min_element(expected, {}, [&](const std::complex<double>& x) { return std::abs(x - v); });
      EXPECT_LE(std::abs(*nearest - v), std::abs(v) == 0 ? zero : relative * std::abs(v))
          << v << " beside " << *nearest;
      expected.erase(nearest);
    }
  }
  // Of the matrices of a LINEAR/STATEMAT, entry by entry. What a low frequency leaves of D, nearly all of which it
  // cancels, is no better than derivatives by differences are.
  static void expect_response(const nlohmann::json& result, const std::vector<double>& hz,
                              const std::function<Eigen::MatrixXcd(double)>& expected, double relative) {
    for (const double f : hz) {
      const auto given = [&](const char* name) -> newton_euler::MatX {
        return matrix(result, name).cast<newton_euler::Real>();
      };
      const Eigen::MatrixXcd ours = newton_euler::response(given("A"), given("B"), given("C"), given("D"), f),
                             theirs = expected(f);
      const Eigen::MatrixXd D = matrix(result, "D");
      constexpr double of_cancelled = 1e-8;
      ASSERT_EQ(ours.rows(), theirs.rows());
      ASSERT_EQ(ours.cols(), theirs.cols());
      for (Eigen::Index i = 0; i < ours.rows(); ++i) {
        for (Eigen::Index k = 0; k < ours.cols(); ++k) {
          EXPECT_LE(std::abs(ours(i, k) - theirs(i, k)),
                    relative * std::abs(theirs(i, k)) + of_cancelled * std::abs(D(i, k)))
              << f << " cycles, output " << i << ", input " << k << ": " << ours(i, k) << " beside " << theirs(i, k);
        }
      }
    }
  }
};

}  // namespace dynalin::cases
