// A sparse matrix in the hands of MUMPS, real or complex, general or symmetric: its pattern, the order of elimination,
// its factors. Who holds one asks it what it is for: determinants, signs of pivots, null pivots.
#pragma once

#include <cstdint>
#include <mutex>
#include <new>
#include <optional>
#include <vector>

#include "distributed/mumps_call.h"

namespace dynalin {

enum class MumpsSymmetry : int { none = 0, symmetric = 2 };
enum class Transposed : bool { no, yes };

template <class Problem>
class MumpsMatrix {
 public:
  // `room` for pivots that have to be delayed, percent.
  MumpsMatrix(MumpsSymmetry symmetry, int room) {
    id_.par = 1, id_.sym = static_cast<int>(symmetry);
    call(-1);
    for (const int k : {1, 2, 3, 4}) control(k) = 0;  // no printing
    control(14) = room;
  }
  ~MumpsMatrix() { call(-2); }
  MumpsMatrix(const MumpsMatrix&) = delete;
  MumpsMatrix& operator=(const MumpsMatrix&) = delete;

  // ICNTL and CNTL of its manual, counted from 1.
  int& control(int k) { return id_.icntl[k - 1]; }
  double& real_control(int k) { return id_.cntl[k - 1]; }
  const Problem& problem() const { return id_; }
  // Pivots that are nothing but rounding of the scaled matrix are counted in INFOG(28), not divided by.
  void count_null_pivots() {
    constexpr double least_pivot = 1e-14;
    control(24) = 1;
    real_control(3) = -least_pivot;  // negative: as it stands, not relative to the norm
  }

  // Rows and columns are counted from 0; of a symmetric matrix one triangle.
  void add_place(std::int32_t row, std::int32_t column) { row_.push_back(row + 1), column_.push_back(column + 1); }
  // The place of each unknown in the order of elimination, where one is known to be good: MUMPS sees every unknown for
  // itself, which takes it several times as long.
  void eliminate_in(const std::optional<std::vector<std::int32_t>>& place) {
    constexpr int as_given = 1, automatic = 7;
    control(7) = place ? as_given : automatic;
    if (!place) return;
    for (const std::int32_t p : *place) place_.push_back(p + 1);
    id_.perm_in = place_.data();
  }
  void eliminate_by_metis() { control(7) = 5; }

  // Of `n` rows with these values of the places in their order, which stay with the caller. The pattern is analysed
  // once. Returns INFOG(1), 0 where all is well.
  template <class Value>
  int factor(std::int32_t n, Value* values) {
    id_.n = n;
    id_.nnz = static_cast<MUMPS_INT8>(row_.size());
    id_.irn = row_.data(), id_.jcn = column_.data();
    id_.a = reinterpret_cast<decltype(id_.a)>(values);
    constexpr int analyse_and_factor = 4, factor_again = 2, allocation_failed = -13;
    for (int tries = 0; tries < 4; ++tries) {
      call(analysed_ ? factor_again : analyse_and_factor);
      // The working space was too small for the pivots that had to be delayed.
      const bool too_small = id_.infog[0] == -8 || id_.infog[0] == -9;
      analysed_ = analysed_ || id_.infog[0] >= 0 || too_small;
      if (!too_small) break;
      control(14) *= 3;
    }
    if (id_.infog[0] == allocation_failed) throw std::bad_alloc();
    return id_.infog[0];
  }
  // In place, `at_once` of the columns together (ICNTL(27)); threads wait for each other.
  template <class Value>
  void solve(Value* x, int columns, Transposed transposed = Transposed::no, int at_once = 0) {
    const std::lock_guard lock(solving_);
    if (at_once > 0) control(27) = at_once;
    id_.rhs = reinterpret_cast<decltype(id_.rhs)>(x), id_.nrhs = columns, id_.lrhs = id_.n;
    control(9) = transposed == Transposed::yes ? 0 : 1;
    call(3);
  }

 private:
  void call(int job) {
    id_.job = job;
    call_mumps(id_);
  }

  Problem id_{};
  std::vector<int> row_, column_, place_;
  bool analysed_ = false;
  std::mutex solving_;
};

}  // namespace dynalin
