// Static problems of the kinds that users have, far from rest as drawn: plain mechanisms, the same in every run.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "mechanism.h"

namespace dynalin::oracle {

struct StaticModel {
  std::string name;  // kind and number
  Mechanism mechanism;
  // What a refusal must say; nothing: there is an equilibrium.
  std::vector<std::string> proof{};
};

// More than a hundred.
[[nodiscard]] std::vector<StaticModel> static_models();

// Along x and along y of the part that carries the marker: where z of a marker points.
// Puts a mechanism together. Ground is body 1; bodies have their mass centre in their origin.
class Draft {
 public:
  Draft(const std::string& kind, int number) : random_(static_cast<std::uint64_t>(number) * 7919U + kind.size() * 31U) {
    model_.name = kind + " " + std::to_string(number);
    model_.mechanism.title = model_.name;
    model_.mechanism.gravity = {0, 0, -9.81};
    model_.mechanism.bodies.emplace_back().ref = {BodyKind::ground, 1};
  }

  double uniform(double a, double b) { return a + (b - a) * std::ldexp(static_cast<double>(random_() >> 11U), -53); }
  Triple box(double size) {
    const double x = uniform(-size, size), y = uniform(-size, size);
    return {x, y, uniform(-size, size)};
  }
  Mechanism& mechanism() { return model_.mechanism; }
  StaticModel done() { return std::move(model_); }
  StaticModel refused(std::vector<std::string> proof) {
    model_.proof = std::move(proof);
    return std::move(model_);
  }

  int part(double mass, const Triple& at, const Triple& reuler = {}, double radius = 0.3);
  int massless(const Triple& at);
  int point_mass(double mass, const Triple& at);
  int cm(int body) const { return 1000 * body; }
  int marker(int body, const Triple& qp, const Triple& reuler = {});
  // Where the mass centre of a body is drawn.
  Triple at(int body) const;

  int joint(JointType type, int i, int j);
  void spring(int i, int j, double k, double free, double preload = 0);
  void torsion(int i, int j, double k, double free);
  void along_z(int i, int j, const Expr& function);  // SFORCE, action only
  void torque(int i, int j, const Expr& function);
  void bushing(int i, int j, const std::array<double, 6>& k, const std::array<double, 6>& preload = {});
  void field(int i, int j, const std::array<double, 6>& k, const std::array<double, 6>& length);
  void beam(int i, int j, double length, double section);
  void force(int i, const std::array<std::optional<Expr>, 3>& components);  // on I, along global axes
  void drive(int joint, double value, char freedom);

 private:
  int next() { return next_++; }
  StaticModel model_;
  std::mt19937_64 random_;
  int next_body_ = 2, next_ = 1;
};

// The kinds; variants are numbered from 0 and any number may be asked for.
[[nodiscard]] StaticModel hanging_chain(int k);
[[nodiscard]] StaticModel cable(int k);
[[nodiscard]] StaticModel vehicle(int k);
[[nodiscard]] StaticModel preloaded_loop(int k);
[[nodiscard]] StaticModel stretched_body(int k);
[[nodiscard]] StaticModel snapping_frame(int k);
[[nodiscard]] StaticModel dropped_plate(int k);
[[nodiscard]] StaticModel slider_between_stops(int k);
[[nodiscard]] StaticModel indifferent(int k);
[[nodiscard]] StaticModel held_by_nothing(int k);
[[nodiscard]] StaticModel growing_force(int k);
[[nodiscard]] StaticModel massless_between(int k);
[[nodiscard]] StaticModel redundant_door(int k);
[[nodiscard]] StaticModel bent_beam(int k);
[[nodiscard]] StaticModel controlled(int k);
[[nodiscard]] StaticModel geared(int k);
[[nodiscard]] StaticModel driven_loop(int k);
[[nodiscard]] StaticModel torsion_pendulum(int k);

}  // namespace dynalin::oracle
