// When a Krylov iteration for the largest values of an operator ends, whoever iterates: one process or a team, with
// single vectors or blocks.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <optional>

namespace dynalin {

class KrylovProgress {
 public:
  // Of an eigenvalue of the operator within the space: its size, and the norm of what is left over beside the space.
  struct Value {
    double size = 0, rest = 0;
  };

  // |rest| against the value: what is left is measured in long double later.
  static constexpr double tolerance = 1e-11;
  // Or as little as the largest value leaves by rounding.
  static bool is_found(const Value&, double largest);

  // Of a space in which so many values are searched for.
  static Eigen::Index vectors_for(Eigen::Index wanted) { return std::max(2 * wanted + 6, wanted + 20); }

  // It ends when `wanted` values are found, or one that is smaller than `least`.
  KrylovProgress(Eigen::Index wanted, double least) : wanted_(wanted), least_(least) {}

  // After a restart that has found the first `found` values of `all` in the space: the size of the last of these, and
  // the first of those that are to come.
  void look(Eigen::Index found, Eigen::Index all, double last, const std::optional<Value>& next);
  bool has_reached_its_end() const { return reached_; }
  // The first that is to come moves no longer: rounding has the last word.
  bool stands_still() const { return idle_ >= 12; }

 private:
  const Eigen::Index wanted_;
  const double least_;
  std::optional<double> share_before_;  // rest / size of the first that was to come
  int idle_ = 0;                        // restarts in a row that have not changed it
  bool reached_ = false;
};

}  // namespace dynalin
