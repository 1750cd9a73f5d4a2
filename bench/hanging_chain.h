// n rods on hinges, hanging under gravity: two states a rod. Without damping, 1 long and of mass 1; or with a
// rotational spring and damper in every hinge, 10 long and of mass 10 (k = EI/l, EI = 1, c = 1e-3 s · k).
#pragma once

#include <fmt/format.h>

#include <string>

inline std::string hanging_chain(int n) {
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

inline std::string damped_chain(int n) {
  const double length = 10, l = length / n, k = 1 / l, c = 1e-3 * k;
  std::string s = "chain\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\n";
  for (int i = 1; i <= n; ++i) {
    const std::string above = i == 1 ? "1" : fmt::format("{}2", i);
    s += fmt::format(
        "PART/{0}, MASS={1:.17g}, CM={0}0, IP={2:.17g},{2:.17g},{2:.17g}, QG=0,{3:.17g},0\n"
        "MARKER/{0}0, QP=0,{4:.17g},0\nMARKER/{0}1\nMARKER/{0}2, QP=0,{5:.17g},0\n"
        "JOINT/{0}, REVOLUTE, I={0}1, J={6}\n"
        "SPRINGDAMPER/{0}, ROTATION, I={0}1, J={6}, KT={7:.17g}, CT={8:.17g}\n",
        i + 1, l, l * l * l / 12, -(i - 1) * l, -0.5 * l, -l, above, k, c);
  }
  return s + "END\n";
}
