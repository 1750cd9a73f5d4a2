// Time of each step from the dataset to all eigenvalues with their vectors.
//
//     eigensolution chain 500       n links on hinges
//     eigensolution vehicle 200     n parts in a row, two bushings between neighbours
#include <dynalin/mechanism.h>
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <string>

namespace {

std::string chain(int n) {
  std::string s = "chain\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\n";
  for (int k = 1; k <= n; ++k) {
    s += fmt::format(
        "PART/{0}, MASS={1:.17g}, CM={0}0, IP={2:.17g},{2:.17g},{2:.17g}, QG=0,{3:.17g},0\nMARKER/{0}0, "
        "QP=0,{4:.17g},0\n"
        "MARKER/{0}1\nMARKER/{0}2, QP=0,{5:.17g},0\nJOINT/{0}, REVOLUTE, I={0}1, J={6}\n",
        k + 1, 1.0 / n, 1.0 / 12 / n / n / n, -(k - 1.0) / n, -0.5 / n, -1.0 / n,
        k == 1 ? std::string("1") : fmt::format("{}2", k));
  }
  return s + "END\n";
}

std::string vehicle(int n) {
  std::string s = "vehicle\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nMARKER/2, QP=0,0.5,0\n";
  for (int k = 1; k <= n; ++k) {
    s += fmt::format(
        "PART/{0}, MASS=2, CM={0}0, IP=0.2,0.3,0.4, QG={1:.17g},0,{2:.17g}, REULER={3:.17g},0.2,0\nMARKER/{0}0\n"
        "MARKER/{0}1, QP=-0.1,0,0\nMARKER/{0}2, QP=-0.1,0.5,0\nMARKER/{0}3, QP=0.1,0,0\nMARKER/{0}4, QP=0.1,0.5,0\n",
        k + 1, 0.2 * k, 0.01 * k, 0.03 * k);
    for (int side = 0; side < 2; ++side) {
      const std::string j = k == 1 ? std::to_string(side + 1) : fmt::format("{}{}", k, side + 3);
      s += fmt::format("BUSHING/{}{}, I={}{}, J={}, K=1E5,2E5,3E5, KT=1E3,2E3,3E3, C=10,20,30, CT=1,2,3\n", k, side,
                       k + 1, side + 1, j);
    }
  }
  return s + "END\n";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return fmt::print("usage: eigensolution chain|vehicle NUMBER\n"), 3;
  const int n = std::atoi(argv[2]);
  auto last = std::chrono::steady_clock::now();
  const auto report = [&](const char* what) {
    const auto now = std::chrono::steady_clock::now();
    fmt::print("{:<24} {:8.3f} s\n", what, std::chrono::duration<double>(now - last).count());
    last = now;
  };
  auto mechanism = dynalin::Mechanism::from_text(std::string(argv[1]) == "chain" ? chain(n) : vehicle(n));
  report("reading");
  const int iterations = mechanism.static_equilibrium();
  report(fmt::format("statics, {} iterations", iterations).c_str());
  const auto matrices = mechanism.state_space();
  report("state matrix");
  const auto solution = mechanism.eigensolution();
  report("state matrix and modes");
  fmt::print("{} states, first mode at {:.12g}\n", matrices.states.size(),
             std::abs(solution.modes.front().eigenvalue_hz));
}
