// Mechanisms with FRICTION that are symmetric about a plane or a point, drawn anywhere in space.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>

#include "base/vec3.h"

namespace dynalin::symmetric {

// Where a mechanism is drawn: its axes by the angles of REULER, its origin.
struct Placed {
  double psi = 0, theta = 0, phi = 0;
  Vector origin;

  Vector turned(const Vector& v) const {
    const auto about_z = [](double a, const Vector& x) {
      return Vector{std::cos(a) * x.x - std::sin(a) * x.y, std::sin(a) * x.x + std::cos(a) * x.y, x.z};
    };
    const Vector x = about_z(phi, v);
    return about_z(psi,
                   {x.x, std::cos(theta) * x.y - std::sin(theta) * x.z, std::sin(theta) * x.y + std::cos(theta) * x.z});
  }
  std::string gravity(const Vector& g) const {
    const Vector v = turned(g);
    return fmt::format("ACCGRAV/IGRAV={:.17g}, JGRAV={:.17g}, KGRAV={:.17g}\n", v.x, v.y, v.z);
  }
  std::string euler() const { return fmt::format("REULER={:.17g},{:.17g},{:.17g}", psi, theta, phi); }
  // On the ground.
  std::string marker(int id, const Vector& at) const {
    const Vector v = origin + turned(at);
    return fmt::format("MARKER/{}, PART=1, QP={:.17g},{:.17g},{:.17g}, {}\n", id, v.x, v.y, v.z, euler());
  }
  // PART/3 with its mass centre at MARKER/30, or another one like it.
  std::string part(const Vector& at, const Vector& velocity, const Vector& spin, int id = 3) const {
    const Vector q = origin + turned(at), v = turned(velocity);
    return fmt::format(
        "PART/{0}, MASS=2, CM={0}0, IP=0.1,0.2,0.15, QG={1:.17g},{2:.17g},{3:.17g}, {4}, VX={5:.17g}, VY={6:.17g}, "
        "VZ={7:.17g}, WX={8}, WY={9}, WZ={10}\nMARKER/{0}0\n",
        id, q.x, q.y, q.z, euler(), v.x, v.y, v.z, spin.x, spin.y, spin.z);
  }
};

inline const std::array<Placed, 4> placements = {Placed{}, Placed{0.3, 0.7, 1.1, {}}, Placed{0, 0, 0, {2e3, -5e3, 7e3}},
                                                 Placed{2.3, -0.7, 1.1, {1e3, 3e3, -2e3}}};

inline std::string of_part(int id, const Vector& at) {
  return fmt::format("MARKER/{}, QP={:.17g},{:.17g},{:.17g}\n", id, at.x, at.y, at.z);
}
inline std::string springs() {
  return "SPRINGDAMPER/1, TRANSLATIONAL, I=32, J=5, K=200, C=3, LENGTH=0.3\n"
         "SPRINGDAMPER/2, TRANSLATIONAL, I=33, J=6, K=200, C=3, LENGTH=0.3\n";
}
inline std::string whole(const std::string& body) {
  return "Symmetric\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n" + body + "END\n";
}

// A slider along z between two springs, each `beside` the plane of y and z: they balance about z and about y.
inline std::string slider(const Placed& p, double beside, const std::string& more) {
  return whole(p.gravity({0, -9.81, 0}) + p.marker(4, {}) + p.marker(5, {beside, -0.7, 0.3}) +
               p.marker(6, {-beside, -0.7, 0.3}) + p.part({0, 0, 0.37}, {0, 0, 1}, {}) +
               of_part(32, {beside, -0.1, 0.1}) + of_part(33, {-beside, -0.1, 0.1}) +
               "JOINT/2, TRANSLATIONAL, I=30, J=4\nFRICTION/2, JOINT=2, MU_STATIC=0.3, MU_DYNAMIC=0.2, REACTION_ARM="
               "0.3, INITIAL_OVERLAP=0.5, STICTION_TRANSITION_VELOCITY=0.2\n" +
               springs() + more);
}
// A moment about the axis of the slider that rises along it.
inline std::string moment_along(double at_start) {
  return fmt::format("SFORCE/3, ROTATION, I=30, J=4, FUNCTION={:.17g}+3*(DZ(30,4,4)-0.37)\n", at_start);
}

inline std::string pendulum(const Placed& p, double beside, double along, const std::string& joint_and_more) {
  return whole(p.gravity({0, -9.81, 0}) + p.marker(4, {}) + p.marker(5, {0.3, -0.7, beside}) +
               p.marker(6, {0.3, -0.7, -beside}) + p.part({0.4, 0, 0}, {0, 0.8, along}, {0, 0, 2}) +
               of_part(31, {-0.4, 0, 0}) + of_part(32, {0.1, -0.1, beside}) + of_part(33, {0.1, -0.1, -beside}) +
               joint_and_more + springs());
}
// A pendulum about z, with springs on both sides of its plane.
inline std::string hinge(const Placed& p, double beside, const std::string& more) {
  return pendulum(p, beside, 0,
                  "JOINT/2, REVOLUTE, I=31, J=4\nFRICTION/2, JOINT=2, MU_STATIC=0.3, MU_DYNAMIC=0.2, PIN_RADIUS=0.05, "
                  "FRICTION_ARM=0.1, BENDING_REACTION_ARM=0.2, STICTION_TRANSITION_VELOCITY=0.02\n" +
                      more);
}
// The same, which also slides.
inline std::string sleeve(const Placed& p, double beside, const std::string& more) {
  return pendulum(p, beside, 0.5,
                  "JOINT/2, CYLINDRICAL, I=31, J=4\nFRICTION/2, JOINT=2, MU_STATIC=0.3, MU_DYNAMIC=0.2, "
                  "PIN_RADIUS=0.05, INITIAL_OVERLAP=0.3, STICTION_TRANSITION_VELOCITY=0.02\n" +
                      more);
}
// An arm that turns about z and a slider on it, with springs between both.
inline std::string slider_on_arm(const Placed& p, double beside, const std::string& more) {
  return whole(p.gravity({0, -9.81, 0}) + p.marker(4, {}) + p.part({0.4, 0, 0}, {0, 0.8, 0}, {0, 0, 2}) +
               of_part(31, {-0.4, 0, 0}) + "MARKER/34, QP=0.1,0.1,0, REULER=90D,90D,0\n" +
               of_part(5, {0, -0.2, beside}) + of_part(6, {0, -0.2, -beside}) +
               p.part({0.7, 0.1, 0}, {0.5, 1.4, 0}, {0, 0, 2}, 5) + "MARKER/51, QP=-0.1,0,0, REULER=90D,90D,0\n" +
               of_part(32, {0.1, -0.2, beside}) + of_part(33, {0.1, -0.2, -beside}) +
               "JOINT/1, REVOLUTE, I=31, J=4\nJOINT/2, TRANSLATIONAL, I=51, J=34\n"
               "FRICTION/1, JOINT=1, PIN_RADIUS=0.03, FRICTION_ARM=0.05, BENDING_REACTION_ARM=0.2\n"
               "FRICTION/2, JOINT=2, REACTION_ARM=0.1, INITIAL_OVERLAP=0.4\n" +
               springs() + more);
}
// A body that turns about its mass centre between springs opposite of each other: the ball bears nothing.
inline std::string ball(const Placed& p, const std::string& inputs) {
  return whole(p.marker(4, {}) + p.marker(5, {0.5, 0.4, 0.2}) + p.marker(6, {-0.5, -0.4, -0.2}) +
               p.part({}, {}, {0.3, 0.2, 0.4}) + of_part(32, {0.3, 0.1, -0.1}) + of_part(33, {-0.3, -0.1, 0.1}) +
               "JOINT/2, SPHERICAL, I=30, J=4\nFRICTION/2, JOINT=2, MU_STATIC=0.3, MU_DYNAMIC=0.2, BALL_RADIUS=0.1, "
               "STICTION_TRANSITION_VELOCITY=0.02, FRICTION_TORQUE_PRELOAD=0.3" +
               (inputs.empty() ? "" : ", " + inputs) + "\n" + springs());
}
// A pendulum that turns about the one bar of the cross of a HOOKE which is left free: nothing along it, no moment.
inline std::string cross(const Placed& p, double beside) {
  return whole(p.gravity({0, -9.81, 0}) + p.marker(4, {}) + p.marker(5, {beside, -0.7, 0.3}) +
               p.marker(6, {-beside, -0.7, 0.3}) + p.part({0, 0, 0.4}, {0, -0.8, 0}, {2, 0, 0}) +
               of_part(31, {0, 0, -0.4}) + of_part(32, {beside, -0.1, 0.1}) + of_part(33, {-beside, -0.1, 0.1}) +
               "JOINT/2, HOOKE, I=31, J=4\nMARKER/34, REULER=90D,90D,0\nJPRIM/1, PERPENDICULAR, I=34, J=4\n"
               "FRICTION/2, JOINT=2, MU_STATIC=0.3, MU_DYNAMIC=0.2, PIN_RADIUS=0.05, FRICTION_ARM=0.1, "
               "BENDING_REACTION_ARM=0.2, STICTION_TRANSITION_VELOCITY=0.02\n" +
               springs());
}

}  // namespace dynalin::symmetric
