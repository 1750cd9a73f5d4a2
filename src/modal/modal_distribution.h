// What the modal tables hold: header quantities, coordinates, and how kinetic energy, strain energy and dissipated
// power are shared among the elements (LINEAR command, 5.1.5 and 5.1.6; scaling as the published headers prove).
//
// The eigenvector z of the state matrix is scaled so that its entry of largest modulus is 1; in the original
// implementation so that the largest among the coordinates of all bodies, chosen or not, and their rates is 1. With T
// the map from states to coordinates, velocities belong to the velocity entries of z alone, displacements to all
// entries.
#pragma once

#include <optional>

#include "linear/linear_system.h"
#include "system/sparse_lu.h"

namespace dynalin {

struct ModeHeader {
  double damping_ratio = 0;   // |Re λ|/|λ|; 1 for a real eigenvalue, 0 for a zero one
  double frequency = 0;       // |λ|/2π [1/time]
  double stiffness = 0;       // 2 T [mass/time²]
  double mass = 0;            // 2 T/|λ|² [mass]
  double kinetic_energy = 0;  // T = Σ ½ vᴴ M v [mass/time²]
};

// One row: an element with its numbers.
template <class T>
struct ModalRow {
  const ElementLabel* element = nullptr;
  std::int64_t part = 0;  // the marker or state, where an element has a row for each
  std::vector<T> values{};
  const ElementLabel* carrier = nullptr;  // the body that a marker is on
};

class ModalDistribution {
 public:
  // At the point of the linear model, which must outlive this.
  ModalDistribution(const System&, const LinearSystem&, const EigenSolution&);

  ModeHeader header(std::size_t mode) const;
  // X Y Z of the mass centre and RX RY RZ of each body, global axes; then one value for each differential state. The
  // largest is 1.
  std::vector<ModalRow<std::complex<double>>> coordinates(std::size_t mode) const;
  // X Y Z of the origin and RX RY RZ of each marker, global axes, with the scale of `coordinates`.
  std::vector<ModalRow<std::complex<double>>> markers(std::size_t mode, std::span<const MarkerId>) const;
  // X Y Z RXX RYY RZZ RXY RXZ RYZ and the sum, in percent of the model. With flexible bodies the sum has before it what
  // is left of theirs, the modal part; the rest is that of the BCS with mass and inertia about it. Beams have one row
  // each, summed up along them.
  std::vector<ModalRow<double>> kinetic(std::size_t mode) const;
  // Total X Y Z RX RY RZ in percent of the model, global axes; a missing entry is NaN. Forces follow displacements
  // (strain) or velocities (dissipation) also through other forces, VARIABLEs and algebraic DIFFs. Flexible bodies and
  // beams have rows with the total alone. Zero is what nothing does; where elements cancel and the model does nothing,
  // none has a share, and all entries are NaN.
  std::vector<ModalRow<double>> strain(std::size_t mode) const { return force_rows(mode, PartialBy::position); }
  std::vector<ModalRow<double>> dissipation(std::size_t mode) const { return force_rows(mode, PartialBy::damping); }

 private:
  Eigen::VectorXcd scaled_vector(std::size_t mode) const;
  // The largest modulus of what the mode moves among mass centres and principal angles of all bodies.
  double largest_original(const Eigen::VectorXcd& z) const;
  Eigen::VectorXcd displacements(const Eigen::VectorXcd& z) const;
  Eigen::VectorXcd velocities(const Eigen::VectorXcd& z) const;  // of the velocity entries
  std::vector<std::size_t> bodies_by_id() const;
  // Rows of bodies and states before they are scaled, and the largest value among them.
  std::pair<std::vector<ModalRow<std::complex<double>>>, std::complex<double>> shape(std::size_t mode) const;
  // Of each body the kinetic energy, in the order of ids.
  std::vector<std::pair<const ElementLabel*, KineticEnergy>> kinetic_energies(const Eigen::VectorXcd& v) const;
  // What the law of each body that deforms works.
  std::vector<ModalRow<double>> rows_of_bodies(const Eigen::VectorXcd& u, PartialBy family) const;
  std::vector<std::size_t> sets_with_rows() const;
  std::vector<ModalRow<double>> force_rows(std::size_t mode, PartialBy family) const;
  bool rests(std::size_t mode, const Eigen::VectorXcd& z, const Eigen::VectorXcd& velocities) const;
  Eigen::VectorXcd unclear_motion(const Eigen::VectorXcd& u) const;
  Eigen::VectorXcd algebraic_change(const Eigen::VectorXcd& dq, PartialBy family) const;
  Eigen::VectorXd algebraic_size(const Eigen::VectorXcd& dq, PartialBy family) const;  // the same if nothing cancelled

  const System& system_;
  const LinearSystem& linear_;
  const EigenSolution& solution_;
  const Motion& motion_;
  const Equations& eq_;                     // of the linear model, without partials that do not exist
  std::optional<ConstraintRows> original_;  // gradients of the coordinates of the original implementation
  SparseLu algebraic_;
  bool algebraic_solved_ = true;
};

}  // namespace dynalin
