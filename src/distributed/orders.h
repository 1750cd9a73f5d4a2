// What the first process of a team has the others do. An order goes to all of them; then all do their part.
#pragma once

#include <array>
#include <cstdint>

namespace dynalin {

struct Order {
  enum class Kind : std::int32_t {
    end,              // the run is over
    real_factors,     // call MUMPS
    complex_factors,  // the same for complex numbers
    krylov,           // take part in a Krylov iteration
    applied,          // the operator of that iteration has been applied
  };
  Kind kind = Kind::end;
  std::int32_t status = 0;  // of the run that ends; 0 if the operator could not be applied

  // A call of MUMPS: which of its problems, and what the first process has set in it.
  std::uint64_t problem = 0;
  std::int32_t job = 0, symmetry = 0;
  std::array<std::int32_t, 60> icntl{};
  std::array<double, 15> cntl{};

  // A Krylov iteration, as in KrylovTask.
  std::int64_t size = 0, locked = 0, wanted = 0, space = 0, restarts = 0;
  double least = 0;
};

// 1 unless a Team has been joined.
int processes();
void give(Order);
// Takes part in whatever is ordered until this kind of order comes.
Order serve_until(Order::Kind);

void take_part_in_mumps(const Order&);
void take_part_in_krylov(const Order&);

// Ends all processes at once: where one has failed on its own the others would wait for it for ever.
[[noreturn]] void end_all();

}  // namespace dynalin
