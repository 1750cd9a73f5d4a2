#include "time/conservative.h"

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>
#include <numbers>

#include "time/reference_integration.h"

namespace dynalin::in_time {

namespace {

constexpr double pi = std::numbers::pi;

}  // namespace

// A point on a bar that is let go horizontally: sin(φ/2) = k sn(K − ω t), φ from below, k = sin 45°.
Conservative pendulum() {
  constexpr double g = 9.80665, k = std::numbers::sqrt2 / 2;
  const double frequency = std::sqrt(g), quarter = boost::math::ellint_1(k);
  const auto truth = [=](const std::vector<double>& times) {
    std::vector<std::vector<double>> values;
    for (const double t : times) {
      double cn = 0, dn = 0;
      const double s = k * boost::math::jacobi_elliptic(k, quarter - frequency * t, &cn, &dn);
      values.push_back({2 * std::asin(s) - pi / 2, -2 * k * frequency * cn});
    }
    return values;
  };
  return {"pendulum", R"(point on a bar without mass
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=22
MARKER/2, PART=2
MARKER/22, PART=2, QP=1,0,0
JOINT/1, REVOLUTE, I=2, J=1
ACCGRAV/JGRAV=-9.80665
VARIABLE/1, FUNCTION=AZ(2,1)
VARIABLE/2, FUNCTION=WZ(2,1)
VARIABLE/90, FUNCTION=0.5*(VX(22)**2+VY(22)**2)+9.80665*DY(22)
END
)",
          4 * quarter / frequency, g, truth};
}

// Inertias 1, 2, 3; nearly about the middle axis, over which it turns again and again. Energy below H²/2B: with
// H² > 2 B T,  ω₁ = … cn, ω₂ = … sn, ω₃ = … dn.
Conservative tumbling_body() {
  constexpr double A = 1, B = 2, C = 3, w1 = 0.1, w2 = 2, w3 = 0.2;
  const double twice_energy = A * w1 * w1 + B * w2 * w2 + C * w3 * w3;
  const double momentum2 = A * A * w1 * w1 + B * B * w2 * w2 + C * C * w3 * w3;
  // H² − 2TB = A (A − B) w1² + C (C − B) w3² > 0: about the axis of C the curve of ω closes.
  const double a1 = std::sqrt((C * twice_energy - momentum2) / (A * (C - A)));
  const double a2 = std::sqrt((C * twice_energy - momentum2) / (B * (C - B)));
  const double a3 = std::sqrt((momentum2 - A * twice_energy) / (C * (C - A)));
  const double p = std::sqrt((C - B) * (momentum2 - A * twice_energy) / (A * B * C));
  const double k = std::sqrt((B - A) * (C * twice_energy - momentum2) / ((C - B) * (momentum2 - A * twice_energy)));
  // ω₁ = a1 cn τ, ω₂ = a2 sn τ, ω₃ = a3 dn τ has ω₁′ = −a1 p sn dn = (B − C)/A ω₂ ω₃.
  const double quarter = boost::math::ellint_1(k);
  double start = std::asin(w2 / a2);
  start = boost::math::ellint_1(k, start);
  const auto truth = [=](const std::vector<double>& times) {
    std::vector<std::vector<double>> values;
    for (const double t : times) {
      double cn = 0, dn = 0;
      const double sn = boost::math::jacobi_elliptic(k, start + p * t, &cn, &dn);
      values.push_back({a1 * cn, a2 * sn, a3 * dn, A * w1, B * w2, C * w3});
    }
    return values;
  };
  return {"body that tumbles about its middle axis", R"(no gravity; momentum in global axes
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=2, IP=1,2,3, WX=0.1, WY=2, WZ=0.2
MARKER/2, PART=2
VARIABLE/1, FUNCTION=WX(2,1,2)
VARIABLE/2, FUNCTION=WY(2,1,2)
VARIABLE/3, FUNCTION=WZ(2,1,2)
MARKER/12, PART=2, QP=1,0,0
MARKER/22, PART=2, QP=0,1,0
MARKER/32, PART=2, QP=0,0,1
VARIABLE/4, FUNCTION=VARVAL(1)*DX(12,2)+2*VARVAL(2)*DX(22,2)+3*VARVAL(3)*DX(32,2)
VARIABLE/5, FUNCTION=VARVAL(1)*DY(12,2)+2*VARVAL(2)*DY(22,2)+3*VARVAL(3)*DY(32,2)
VARIABLE/6, FUNCTION=VARVAL(1)*DZ(12,2)+2*VARVAL(2)*DZ(22,2)+3*VARVAL(3)*DZ(32,2)
VARIABLE/90, FUNCTION=0.5*(VARVAL(1)**2+2*VARVAL(2)**2+3*VARVAL(3)**2)
END
)",
          4 * quarter / p, twice_energy / 2, truth};
}

// Lagrange's top: inertias A across at the tip and C along its axis, which nods and turns about the vertical:
//     A θ″ = (A ψ′² cos θ − n ψ′ + m g l) sin θ,   ψ′ = (p − n cos θ) / (A sin² θ),   n = C (φ′ + ψ′ cos θ)
Conservative heavy_top() {
  constexpr double A = 2, C = 1, weight = 10, tilt = 0.5, spin = 20;  // A with the mass at its distance
  constexpr double n = C * spin;
  const double p = n * std::cos(tilt);  // ψ′ = 0 at the start
  const auto rate = [=](double, const Values& x) {
    const double s = std::sin(x[0]), c = std::cos(x[0]), turning = (p - n * c) / (A * s * s);
    return Values{x[1], (A * turning * turning * c - n * turning + weight) * s / A, turning};
  };
  const auto truth = [=](const std::vector<double>& times) {
    std::vector<Values> values;
    for (const Values& x : integrated(rate, {tilt, 0, 0}, times)) {
      const double s = std::sin(x[0]);
      values.push_back({std::cos(x[0]), s * std::sin(x[2]), -s * std::cos(x[2]), spin, p});
    }
    return values;
  };
  return {"heavy top", R"(tilted about x at first, so that its axis leans to -y
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=3, IP=1,1,1, REULER=0,0.5,0, WZ=20
MARKER/2, PART=2
MARKER/3, PART=2, QP=0,0,1
JOINT/1, SPHERICAL, I=2, J=1
ACCGRAV/KGRAV=-10
VARIABLE/1, FUNCTION=DZ(3,2)
VARIABLE/2, FUNCTION=DX(3,2)
VARIABLE/3, FUNCTION=DY(3,2)
VARIABLE/4, FUNCTION=WZ(2,1,2)
VARIABLE/5, FUNCTION=2*(WZ(2)-WZ(2,1,2)*DZ(3,2))+WZ(2,1,2)*DZ(3,2)
VARIABLE/90, FUNCTION=WX(2,1,2)**2+WY(2,1,2)**2+0.5*WZ(2,1,2)**2+10*DZ(3,2)
END
)",
          2 * pi * A / n, weight, truth};
}

// A crank of length 1 from the origin and a slider on x; the rod of length 3 is uniform. With x = cos θ + √(9 − sin² θ)
// the energy is ½ M(θ) θ′², so θ″ = −½ M′/M θ′².
Conservative slider_crank() {
  constexpr double crank = 1, rod = 3, crank_inertia = 2, rod_mass = 1.5, slider_mass = 0.8, speed = 3;
  const auto mass = [=](double angle) {  // M and M′
    const double s = std::sin(angle), c = std::cos(angle), h = std::sqrt(rod * rod - crank * crank * s * s);
    const double x1 = -crank * s - crank * crank * s * c / h;  // dx/dθ
    const double x2 =
        -crank * c - crank * crank * (c * c - s * s) / h - std::pow(crank, 4) * s * s * c * c / (h * h * h);
    // A uniform rod: ⅙ m (v₁² + v₁ v₂ + v₂²) with its ends (−sin, cos) and (dx/dθ, 0).
    const double m = crank_inertia + rod_mass / 3 * (crank * crank - crank * s * x1 + x1 * x1) + slider_mass * x1 * x1;
    const double m1 = rod_mass / 3 * (-crank * c * x1 - crank * s * x2 + 2 * x1 * x2) + 2 * slider_mass * x1 * x2;
    return std::pair{m, m1};
  };
  const auto rate = [=](double, const Values& x) {
    const auto [m, m1] = mass(x[0]);
    return Values{x[1], -0.5 * m1 / m * x[1] * x[1]};
  };
  const auto truth = [=](const std::vector<double>& times) {
    std::vector<Values> values;
    for (const Values& x : integrated(rate, {0, speed}, times)) {
      const double s = std::sin(x[0]);
      values.push_back({x[0], x[1], std::cos(x[0]) + std::sqrt(rod * rod - s * s)});
    }
    return values;
  };
  return {"slider-crank", R"(without gravity; three joints of the plane are redundant
PART/1, GROUND
MARKER/1, PART=1
MARKER/9, PART=1, REULER=90D,90D,0
PART/2, MASS=1, CM=2, IP=1,1,2, WZ=3
MARKER/2, PART=2
MARKER/21, PART=2, QP=1,0,0
PART/3, MASS=1.5, QG=1,0,0, CM=33, IP=0,1.125,1.125
MARKER/31, PART=3
MARKER/32, PART=3, QP=3,0,0
MARKER/33, PART=3, QP=1.5,0,0
PART/4, MASS=0.8, QG=4,0,0, CM=41, IP=1,1,1
MARKER/41, PART=4
MARKER/42, PART=4, REULER=90D,90D,0
JOINT/1, REVOLUTE, I=2, J=1
JOINT/2, REVOLUTE, I=31, J=21
JOINT/3, REVOLUTE, I=32, J=41
JOINT/4, TRANSLATIONAL, I=42, J=9
VARIABLE/1, FUNCTION=AZ(2,1)
VARIABLE/2, FUNCTION=WZ(2)
VARIABLE/3, FUNCTION=DX(41,1)
VARIABLE/90, FUNCTION=WZ(2)**2+0.5*(1.5*(VX(33)**2+VY(33)**2)+1.125*WZ(31)**2+0.8*VX(41)**2)
END
)",
          2 * pi / speed, 0.5 * mass(0).first * speed * speed, truth};
}

// A crank that turns about z and a rocker about y, joined by a uniform rod: two angles and their constraint,
//     I₁ q₁″, I₂ q₂″ and ⅙ m (v₁² + v₁·v₂ + v₂²) of the rod's ends, |p₁ − p₂|² = L².
Conservative spatial_four_bar() {
  constexpr double crank = 1, rocker = 3, distance = 4, crank_inertia = 1, rocker_inertia = 3, rod = 0.9, speed = 2;
  using Point = std::array<double, 3>;
  const auto along = [](const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  // Ends: p₁ = a (cos q₁, sin q₁, 0), p₂ = (D, 0, 0) + b (−sin q₂, 0, cos q₂), which starts upright.
  const auto rate = [=](double, const Values& x) {
    const double s1 = std::sin(x[0]), c1 = std::cos(x[0]), s2 = std::sin(x[1]), c2 = std::cos(x[1]);
    const Point p1{crank * c1, crank * s1, 0}, d1{-crank * s1, crank * c1, 0}, e1{-crank * c1, -crank * s1, 0};
    const Point p2{distance - rocker * s2, 0, rocker * c2}, d2{-rocker * c2, 0, -rocker * s2},
        e2{rocker * s2, 0, -rocker * c2};
    const Point r{p1[0] - p2[0], p1[1] - p2[1], p1[2] - p2[2]};
    const double u1 = x[2], u2 = x[3];
    // ⅓ m d₁·d₁, ⅙ m d₁·d₂: the mass matrix, and what quadratic rates leave.
    const double m11 = crank_inertia + rod / 3 * along(d1, d1), m22 = rocker_inertia + rod / 3 * along(d2, d2);
    const double m12 = rod / 6 * along(d1, d2);
    const double h1 = rod / 6 * along(d1, e2) * u2 * u2, h2 = rod / 6 * along(d2, e1) * u1 * u1;
    // Half the constraint's gradient and −its second rate at constant velocities.
    const double g1 = along(r, d1), g2 = -along(r, d2);
    const Point v{d1[0] * u1 - d2[0] * u2, d1[1] * u1 - d2[1] * u2, d1[2] * u1 - d2[2] * u2};
    const double gamma = along(v, v) + along(r, e1) * u1 * u1 - along(r, e2) * u2 * u2;
    // [M −gᵀ; g 0] [a; λ] = [−h; −γ]
    const double det = m11 * m22 - m12 * m12;
    const auto solved = [&](double f1, double f2) {
      return std::pair{(m22 * f1 - m12 * f2) / det, (m11 * f2 - m12 * f1) / det};
    };
    const auto [f1, f2] = solved(-h1, -h2);
    const auto [k1, k2] = solved(g1, g2);
    const double lambda = (-gamma - g1 * f1 - g2 * f2) / (g1 * k1 + g2 * k2);
    return Values{u1, u2, f1 + lambda * k1, f2 + lambda * k2};
  };
  const auto truth = [=](const std::vector<double>& times) {
    std::vector<Values> values;
    // At q₁ = 90° and q₂ = 0: r = (−4, 1, −3), gradient (r·d₁, −r·d₂) = (4, −12).
    for (const Values& x : integrated(rate, {pi / 2, 0, speed, speed / 3}, times))
      values.push_back({x[0], x[1], x[2], x[3]});
    return values;
  };
  return {"spatial four-bar", R"(rod of length sqrt(26) on spherical and universal joints
PART/1, GROUND
MARKER/1, PART=1, REULER=90D,0,0
MARKER/5, PART=1, QP=4,0,0, REULER=180D,90D,0
PART/2, MASS=1, CM=2, IP=1,1,1, REULER=90D,0,0, WZ=2
MARKER/2, PART=2
MARKER/21, PART=2, QP=1,0,0
PART/3, MASS=0.9, QG=0,1,0, CM=33, IP=1.95,1.95,0, ZG=4,0,3, XG=0,1,9
MARKER/31, PART=3
MARKER/32, PART=3, QP=0,0,5.099019513592785
MARKER/33, PART=3, QP=0,0,2.549509756796392
MARKER/34, PART=3, QP=0,0,5.099019513592785, ZP=1,0,5.099019513592785, XP=0,1,5.099019513592785
PART/4, MASS=1, QG=4,0,0, CM=41, IP=1,3,1
MARKER/41, PART=4
MARKER/42, PART=4, REULER=180D,90D,0
MARKER/43, PART=4, QP=0,0,3, REULER=180D,90D,0
JOINT/1, REVOLUTE, I=2, J=1
JOINT/2, SPHERICAL, I=31, J=21
JOINT/3, UNIVERSAL, I=34, J=43
JOINT/4, REVOLUTE, I=42, J=5
VARIABLE/1, FUNCTION=AZ(2,1)+90D
VARIABLE/2, FUNCTION=-AZ(42,5)
VARIABLE/3, FUNCTION=WZ(2)
VARIABLE/4, FUNCTION=-WY(41)
VARIABLE/80, FUNCTION=VX(31)**2+VY(31)**2+VX(32)**2+VZ(32)**2+VX(31)*VX(32)
VARIABLE/90, FUNCTION=0.5*WZ(2)**2+1.5*WY(41)**2+0.15*VARVAL(80)
END
)",
          2 * pi / speed, 0.5 * (1 + 0.3) * 4 + 0.5 * (3 + 2.7) * 4 / 9, truth};
}

// A rotor in two gimbals: the outer turns by ψ about z, the inner by θ about its x, the rotor about the z of the inner.
//     P θ″ = (Q − R) s c ψ′² − n ψ′ s,   (O + Q s² + R c²) ψ′ + n c = p,   n = C (φ′ + ψ′ c)
// with P, Q, R the inertias of the inner gimbal, the first two with those of the rotor across.
Conservative gyroscope() {
  constexpr double outer = 1, P = 1.5 + 1, Q = 1.2 + 1, R = 0.7, C = 1.6, tilt = 1, turning = 0.5, spin = 12;
  constexpr double n = C * spin;  // the rotor's whole angular velocity along its axis
  const double p =
      (outer + Q * std::pow(std::sin(tilt), 2) + R * std::pow(std::cos(tilt), 2)) * turning + n * std::cos(tilt);
  const auto rate = [=](double, const Values& x) {
    const double s = std::sin(x[0]), c = std::cos(x[0]), w = (p - n * c) / (outer + Q * s * s + R * c * c);
    return Values{x[1], ((Q - R) * s * c * w * w - n * w * s) / P, w, n / C - w * c};
  };
  const auto truth = [=](const std::vector<double>& times) {
    std::vector<Values> values;
    for (const Values& x : integrated(rate, {tilt, 0, 0, 0}, times)) values.push_back({x[0], x[2], x[3], n / C, p});
    return values;
  };
  return {"gyroscope in gimbals", R"(three bodies with one centre
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=2, IP=3,3,1, WZ=0.5
MARKER/2, PART=2
MARKER/21, PART=2, ZP=1,0,0, XP=0,1,0
PART/3, MASS=1, CM=3, IP=1.5,1.2,0.7, REULER=0,1,0, WY=0.4207354924039483, WZ=0.2701511529340699
MARKER/3, PART=3
MARKER/31, PART=3, ZP=1,0,0, XP=0,1,0
PART/4, MASS=1, CM=4, IP=1,1,1.6, REULER=0,1,0, WY=0.4207354924039483, WZ=12
MARKER/4, PART=4
JOINT/1, REVOLUTE, I=2, J=1
JOINT/2, REVOLUTE, I=31, J=21
JOINT/3, REVOLUTE, I=4, J=3
VARIABLE/1, FUNCTION=AZ(31,21)
VARIABLE/2, FUNCTION=AZ(2,1)
VARIABLE/3, FUNCTION=AZ(4,3)
VARIABLE/4, FUNCTION=WZ(4,1,4)
MARKER/302, PART=3, QP=0,1,0
MARKER/303, PART=3, QP=0,0,1
VARIABLE/5, FUNCTION=WZ(2)+2.2*WY(3,1,3)*DZ(302,3)+(0.7*WZ(3,1,3)+1.6*WZ(4,1,4))*DZ(303,3)
VARIABLE/90, FUNCTION=0.5*(WZ(2)**2+2.5*WX(3,1,3)**2+2.2*WY(3,1,3)**2+0.7*WZ(3,1,3)**2+1.6*WZ(4,1,4)**2)
END
)",
          1, 1, truth};
}

std::vector<Conservative> all_conservative() {
  return {pendulum(), tumbling_body(), heavy_top(), spatial_four_bar(), slider_crank(), gyroscope()};
}

}  // namespace dynalin::in_time
