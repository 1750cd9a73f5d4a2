// One body with mass, for whoever weighs bodies or makes lists of them: a rigid one, one with shapes, or a beam with
// all of its nodes. Its kernel knows which.
//
// Columns are coordinates of the layout, δr and δθ of poses along global axes. Masses are those of the user, without
// the factor of consistency: 2 T = vᵀ M v has the unit mass·length²/time².
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "mechanics/equations.h"
#include "mechanics/sparse_row.h"

namespace dynalin {

// Part of the mass matrix M of a body: with x its own rows of a motion, of which δr is taken of the point that `arm`
// leads to, all parts together have xᵀ rootᵀ root x = x_allᵀ M x_all.
struct WeighedPart {
  std::vector<std::int32_t> columns;  // −1 for those that the part has not
  Vector arm;                         // from the BCS, global axes: of a part whose first six columns are a pose
  Eigen::MatrixXd root;               // a column for each of `columns`
};

struct KineticEnergy {
  // ½ m |v|² of the mass centre by X Y Z, then ½ ωᵀ J ω by XX YY ZZ XY XZ YZ, global axes.
  std::array<double, 9> terms{};
  std::optional<double> whole{};  // with what shapes add to them, of bodies that have any

  double sum() const {
    double sum = 0;
    for (const double term : terms) sum += term;
    return sum;
  }
  double total() const { return whole.value_or(sum()); }
};

class BodySource {
 public:
  // Those of the layout that it consists of: one, or its nodes from end to end. The first stands for it in lists.
  virtual std::span<const BodyId> bodies() const = 0;
  // The mass centre of one of them from its origin, along the axes of its BCS.
  virtual Vec3<Taylor> centre_in_body(const Motion&, BodyId) const = 0;

  // --- mass -----------------------------------------------------------------------------------------
  virtual double mass() const = 0;
  // Whether there are motions of it without inertia.
  virtual bool lacks_inertia() const = 0;
  // Adds forms on velocities that together vanish for motions without inertia alone.
  virtual void add_momentum_rows(const Motion&, std::vector<SparseRow>&) const = 0;
  // Nothing of a body that counts as weightless: without mass.
  virtual std::vector<WeighedPart> weighed_parts(const Motion&) const = 0;
  // Of a motion of all coordinates in complex amplitudes, half of that with its conjugate: ½ vᴴ M v.
  virtual KineticEnergy kinetic_energy(const Motion&, const Eigen::VectorXcd& velocity) const = 0;

  // --- its own law ----------------------------------------------------------------------------------
  // uᴴ K u with its own stiffness (PartialBy::position), uᴴ C u with its damping (PartialBy::damping) for a motion of
  // all coordinates; nothing of a body that does not deform.
  virtual std::optional<double> own_work(const Motion&, PartialBy, const Eigen::VectorXcd&) const { return {}; }

  // --- what it has to say -----------------------------------------------------------------------------
  // Puts the velocities with which it starts into those of all coordinates, beyond what Body::velocity asks for, as far
  // as what the arguments of its statement say `holds` here.
  using Holds = std::function<bool(std::string_view argument)>;
  virtual void start_velocity(const Motion&, const Holds&, std::span<double> /*of_all*/) const {}
  // Adds warnings of a point of linearization that is outside of what its law was made for.
  virtual void add_cautions(const Motion&, Diagnostics&) const {}
  // A line for the message file, before anything is computed: a wrong unit shows in masses and frequencies.
  virtual std::optional<std::string> summary() const { return {}; }

 protected:
  ~BodySource() = default;
};

}  // namespace dynalin
