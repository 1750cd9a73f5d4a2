// One thread and many give the same sums, to the last bit.
#include "system/shared_pass.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <random>
#include <stdexcept>
#include <thread>

#include "places/thread_count.h"
#include "system/model_test_support.h"

namespace dynalin::system_test::shared_pass_test {
namespace {

class SharedPass : public ::testing::Test {
  KeepsThreadCount kept_;
};

// Parts on joints in a row, each with forces of several kinds on the one before it.
std::string row_of_parts(int count) {
  std::string s = "MARKER/2\nACCGRAV/KGRAV=-9.81\n";
  for (int k = 1; k <= count; ++k) {
    const int before = k == 1 ? 2 : 10 * (k - 1) + 2;
    s += fmt::format(
        "PART/{0}, MASS={1}, CM={2}0, IP=0.1,0.2,0.3, QG={3},0,0, REULER=0.1,{4},0, VX={4}, WZ=0.3\n"
        "MARKER/{2}0, PART={0}\nMARKER/{2}1, PART={0}, QP=-0.5,0.1,0\nMARKER/{2}2, PART={0}, QP=0.5,0,0\n"
        "JOINT/{2}, REVOLUTE, I={2}1, J={5}\nSPRINGDAMPER/{2}, TRANSLATIONAL, I={2}0, J={5}, K={3}, C=0.7, L=0.3\n"
        "SPRINGDAMPER/{2}0000, ROTATIONAL, I={2}1, J={5}, KT=3, CT=0.1\n"
        "BUSHING/{2}, I={2}2, J={5}, K=1,2,3, KT=4,5,6, C=.1,.2,.3, CT=.4,.5,.6, FORCE=1,2,3\n"
        "SFORCE/{2}, TRANSLATIONAL, I={2}2, J={5}, FUNCTION=-3*DM({2}2,{5})**3-VR({2}2,{5})+FZ({2}2,{5})\n"
        "VFORCE/{2}, I={2}0, JFLOAT={2}9, RM=1, FX=-DX({2}0)\\FY=SIN(TIME)*VY({2}0)\\FZ=0\nMARKER/{2}9, PART=1, "
        "FLOATING\n",
        k + 1, 1 + 0.01 * k, k + 0, k, 0.02 * k, before);
  }
  return s;
}

struct Evaluated {
  std::vector<double> residual, magnitude;
  std::vector<ColumnMatrix> matrices;
};
constexpr std::array families = {PartialBy::position, PartialBy::velocity,  PartialBy::damping, PartialBy::acceleration,
                                 PartialBy::lambda,   PartialBy::algebraic, PartialBy::state,   PartialBy::state_rate};

// After passes by so many threads, one number a pass: patterns recorded by some are filled by others.
Evaluated evaluated(const System& system, const std::vector<std::size_t>& threads) {
  OperatingPoint op = system.drawn();
  std::mt19937 random(4);
  std::uniform_real_distribution<double> number(-1, 1);
  for (double& v : op.velocity) v = number(random);
  for (double& v : op.acceleration) v = number(random);
  for (double& v : op.lambda) v = number(random);
  for (double& v : op.algebraic) v = number(random);
  const Motion motion = system.motion(op);
  ConstraintRows rows;
  rows.resize(system.layout());
  system.constraints(motion, rows);
  Equations eq;
  eq.resize(system.layout());
  eq.keep_sizes();
  for (const std::size_t t : threads) {
    set_thread_count(t);
    system.equations(motion, rows, eq,
                     {PartialBy::position, PartialBy::velocity, PartialBy::damping, PartialBy::acceleration,
                      PartialBy::lambda, PartialBy::algebraic, PartialBy::state, PartialBy::state_rate});
  }
  Evaluated out{{eq.residual().begin(), eq.residual().end()}, {eq.magnitude().begin(), eq.magnitude().end()}, {}};
  for (const PartialBy f : families) {
    out.matrices.push_back(eq.matrix(f));
    ColumnMatrix sizes = eq.matrix(f);
    sizes.value.assign(eq.sizes(f).begin(), eq.sizes(f).end());
    out.matrices.push_back(std::move(sizes));
  }
  return out;
}

TEST_F(SharedPass, all_elements_give_the_same_numbers_by_any_number_of_threads) {
  const auto system = system_of(row_of_parts(100));
  const Evaluated alone = evaluated(*system, {1});
  EXPECT_NE(alone.residual.front(), 0);
  for (const std::vector<std::size_t>& threads : {std::vector<std::size_t>{2}, {3}, {5, 1}, {1, 2}, {2, 7, 2}}) {
    const Evaluated shared = evaluated(*system, threads);
    EXPECT_EQ(shared.residual, alone.residual);
    EXPECT_EQ(shared.magnitude, alone.magnitude);
    for (std::size_t k = 0; k < alone.matrices.size(); ++k) {
      EXPECT_EQ(shared.matrices[k].row, alone.matrices[k].row) << k;
      EXPECT_EQ(shared.matrices[k].value, alone.matrices[k].value) << k;
    }
  }
}

// Adds thirds to one row: their sum tells the order in which they came.
class Thirds : public Kernel {
 public:
  Thirds(std::size_t count, std::size_t shares) : numbers_(count), shares_(shares) {
    for (std::size_t k = 0; k < count; ++k) numbers_[k] = std::pow(-3.0, static_cast<double>(k % 40)) / 7;
  }
  std::size_t shares() const override { return shares_; }
  void equations(const Motion&, Equations& eq) const override {
    if (std::this_thread::get_id() != caller) ++elsewhere;
    for (const double& v : eq.share(numbers_)) {
      if (std::isnan(v)) throw std::runtime_error("not a number");
      eq.add_residual(0, v);
      std::this_thread::yield();
    }
  }

  const std::thread::id caller = std::this_thread::get_id();
  mutable std::atomic<int> elsewhere = 0;
  std::vector<double> numbers_;

 private:
  std::size_t shares_;
};

TEST_F(SharedPass, what_is_added_comes_in_its_order_and_what_is_not_shared_in_the_thread_of_the_caller) {
  Layout layout;
  layout.coordinate_count = 1;
  std::vector<std::unique_ptr<Kernel>> kernels;
  for (const std::size_t shares : {1u, 60u, 1u, 1u, 7u, 33u, 1u})
    kernels.push_back(std::make_unique<Thirds>(211, shares));
  const auto sum = [&](std::size_t threads) {
    set_thread_count(threads);
    Equations eq;
    eq.resize(layout);
    eq.begin({});
    add_equations(kernels, Motion(), Threads::all, eq);
    return eq.residual().front();
  };
  const double alone = sum(1);
  for (int round = 0; round < 30; ++round) {
    for (const std::size_t threads : {2u, 3u, 6u}) EXPECT_EQ(sum(threads), alone);
  }
  int elsewhere = 0;
  for (const auto& k : kernels) {
    const auto& thirds = static_cast<const Thirds&>(*k);
    if (thirds.shares() == 1) {
      EXPECT_EQ(thirds.elsewhere, 0);
    }
    elsewhere += thirds.elsewhere;
  }
  EXPECT_GT(elsewhere, 0);
  // An error in a share is the caller's.
  static_cast<Thirds&>(*kernels[1]).numbers_[150] = std::nan("");
  for (const std::size_t threads : {1u, 3u}) EXPECT_THROW(sum(threads), std::runtime_error);
}

}  // namespace
}  // namespace dynalin::system_test::shared_pass_test
