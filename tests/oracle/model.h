// The equations of a mechanism in the formulation of the oracle: Newton-Euler at the mass centre, reactions
// as wrenches along constraint gradients, everything evaluated from poses, velocities and accelerations of
// the bodies. Used by the oracle and by the generator, which needs ranks and conditioning.
#pragma once

#include <array>
#include <map>
#include <string_view>
#include <vector>

#include "beams.h"
#include "curves.h"
#include "jet.h"
#include "mechanism.h"
#include "oracle.h"
#include "plane_beams.h"
#include "small_algebra.h"
#include "solids.h"

namespace dynalin::oracle {

struct BodyMotion {
  Vec p;            // BCS origin
  Mat R;            // BCS to global
  Vec v, w, a, al;  // velocities and accelerations, global axes
};

// A marker along the motion: origin and axes with first and second time derivatives.
struct MarkerMotion {
  Vec p, v, a, w, al;
  std::array<Vec, 3> axis, axis1, axis2;
};

struct Wrench {
  Vec f, t;  // t about the point that the user of the wrench names
};

// One scalar constraint. point: (p_I - p_J) . e_J;  direction: e_I . e_J, or e_I . e_J - e_J' . e_I' with the axes
// swapped; angle: AZ(I,J); expression: any function of displacements, or one of velocities. A motion subtracts its
// function of time. shape: a node stands and is turned as the modal coordinates say, three rows each. plane: a node of
// a plane beam stays in its plane and turns with its slope.
struct Row {
  enum class Type { point, direction, angle, expression, shape, plane };
  Type type = Type::point;
  int i = 0, j = 0;  // marker indices
  int axis_i = 0, axis_j = 0;
  int joint = -1, motion = -1;  // whose row it is
  bool swapped = false;         // less the product of the same axes of the other marker
  bool of_rates = false;        // an expression of velocities: no position row
  Expr function{};
  std::size_t carried = 0;  // of a shape or plane: which node, of those that are bodies, and which of its rows
  int component = 0;
  Real offset = 0;  // subtracted from an expression
  // Of an expression, on each body, t about its BCS: once asked for at the present positions (Model::gradient_of).
  mutable std::vector<Wrench> gradient{};
};

// A force element as it acts: a wrench on I, its torque about p_I, and what takes the opposite.
struct ForceLoad {
  enum class Taker { body_at_i, body_at_j, nothing };
  std::string_view statement;
  int id = 0, marker = 0;  // marker: the id of I where the element has a wrench for each of several
  int i = 0, j = 0;        // marker indices
  Wrench on_i;
  Taker taker = Taker::body_at_i;
  bool forces = true, torques = true;  // what such a statement exerts
};

// A displacement of one body, or a change of its velocity: `shift` of the BCS and `turn`, global axes.
struct Variation {
  int body = 0;
  Vec shift, turn;
  bool of_rates = false;
};

struct DifferentialSlot {
  ElementClass element = ElementClass::diff;
  int element_id = 0, index = 1;
};

class Model {
 public:
  explicit Model(const Mechanism& mechanism);

  // Structure.
  struct BodyData {
    BodyRef ref;
    int dof = 0, offset = 0;
    Real mass = 0;
    Vec c;        // mass centre in the BCS; the BCS origin of a massless body without CM
    Mat inertia;  // about the mass centre, BCS axes
  };
  std::vector<BodyData> bodies;  // bodies[0] is ground
  std::vector<Row> rows;
  std::vector<DifferentialSlot> slots;
  int dofs = 0;
  Real length = 1;  // largest distance between marker origins in the drawn pose

  // The instant under evaluation.
  Real time = 0, clock = 1;  // and the rate of TIME: 0 in a static analysis
  std::vector<BodyMotion> motion;
  std::vector<Real> z;
  std::vector<Real> variable_values, sforce_values, lambda;
  std::vector<Real> component_values;                   // of general forces, six each, in the order of the mechanism
  std::vector<Real> algebraic_values, algebraic_rates;  // per DIFF, used where it is algebraic
  std::map<const Node*, Real> delay_offset;             // see expand_delays
  std::vector<Real> held_rates;                         // of differential states of DIFFs, if any: kept, not evaluated
  std::vector<int> cut;                                 // per variable: 1 when it is an independent input
  std::vector<Real> cut_values;

  void place_nodes();           // of flexible bodies, and their velocities, by the motion of frame and modes
  void update_positions();      // markers from poses
  void update_velocities();     // markers from body velocities
  void update_accelerations();  // markers from body accelerations
  [[nodiscard]] const std::vector<MarkerMotion>& markers() const { return markers_; }

  // Constraints. gradient: row times body velocities (v, w of each BCS) is the rate apart from time. A row of
  // velocities has no position (zero); its gradient is that by velocities.
  [[nodiscard]] Real row_position(const Row& row) const;
  [[nodiscard]] Real row_velocity(const Row& row) const;
  [[nodiscard]] Real row_acceleration(const Row& row) const;
  [[nodiscard]] Dense gradient() const;

  // Accelerations, multipliers, variables and force values at once; active rows carry multipliers.
  std::vector<int> active;
  [[nodiscard]] std::size_t algebra_size() const;
  [[nodiscard]] std::size_t algebraic_unknowns() const;  // of DIFFs
  void unpack_algebra(const std::vector<Real>& x);
  [[nodiscard]] std::vector<Real> algebra_residual() const;
  [[nodiscard]] std::vector<int> algebra_groups() const;  // quantities of one kind share a scale

  // From here on a DELAY is e - tau e' plus what makes its value here that of its history before the start.
  void expand_delays();
  [[nodiscard]] std::vector<Real> differential_rates() const;
  [[nodiscard]] std::vector<Real> diff_rates() const;  // of every DIFF
  // All force elements, statement by statement in alphabetical order.
  [[nodiscard]] std::vector<ForceLoad> force_loads() const;
  // Of a flexible body on its modal coordinates, by its stiffness and damping.
  [[nodiscard]] Vec elastic_force(std::size_t flexible) const;
  [[nodiscard]] std::size_t modes_of(std::size_t flexible) const { return flexible_data_[flexible].modes; }
  [[nodiscard]] Real evaluate(const Expr& expression) const;
  [[nodiscard]] Real evaluate_at(const Expr& expression, const LinePoint& point) const;
  // A direction in which the surfaces of a friction slip, and the lever of what rubs along it.
  struct Slip {
    Vec axis;
    bool turns = false;
    Real lever = 1, speed = 0;
  };
  [[nodiscard]] std::vector<Slip> slips(const Friction& friction) const;
  // Sizes of the reaction: force across and along the axis, moment across and along it.
  [[nodiscard]] std::array<Real, 4> pressing(const Friction& friction) const;
  // A place of a CONTACT, global axes: the normal out of J, I's material seen from J's half-way between.
  struct TouchState {
    Vec normal, point, velocity;
    Real gap = 0, pressure = 0;
    [[nodiscard]] Vec slip() const { return velocity - dot(velocity, normal) * normal; }
  };
  [[nodiscard]] std::vector<TouchState> touch_states(std::size_t k) const;
  [[nodiscard]] Vec contact_point(std::size_t k) const;
  [[nodiscard]] Real cable_tension(const Cable& f) const;
  // Where on the curves of i and of j the search for the point of contact begins from now on.
  void look_for_contact_at(std::size_t k, double u, double v) {
    mechanism_.contacts[k].u = u, mechanism_.contacts[k].v = v;
  }
  // How fast the point of contact moves along the curves of i and of j.
  [[nodiscard]] std::array<Real, 2> contact_speeds(std::size_t k) const;
  // With time derivatives along the motion, as far as positions, velocities and accelerations give them.
  [[nodiscard]] Jet evaluate_along(const Expr& expression) const;
  [[nodiscard]] int variable_index(int id) const { return variable_index_.at(id); }
  [[nodiscard]] int marker_index(int id) const { return marker_index_.at(id); }
  [[nodiscard]] int body_index(const BodyRef& ref) const;
  [[nodiscard]] const Mechanism& mechanism() const { return mechanism_; }
  [[nodiscard]] Dense mass_matrix() const;  // about each BCS, for conditioning and kinetic energy only

 private:
  template <class T>
  friend class Evaluator;
  struct MarkerData {
    int body = 0;
    Vec p;
    Mat R;
    int contact = -1;  // that holds a floating marker
    bool on_i = false;
  };
  struct Pair {
    Vec e;  // unit vector from J to I
    Real distance = 0, rate = 0;
  };
  void read_bodies();
  void read_rows();
  void read_joint(std::size_t k);
  void read_relations();
  void read_motions();
  void read_contacts();
  void read_beams();
  void read_controls();
  void capture_offsets();
  void solve_contacts();
  [[nodiscard]] bool touches(std::size_t contact, int body) const;
  [[nodiscard]] const std::vector<Wrench>& gradient_of(const Row& row) const;
  [[nodiscard]] Pair line_of_sight(int i, int j) const;
  [[nodiscard]] Real angle_z(int i, int j) const;
  [[nodiscard]] Real drive(const Row& row, std::size_t derivative) const;
  [[nodiscard]] Wrench row_wrench(const Row& row) const;  // on I for a unit multiplier, t about p_I
  // On every body, t about its BCS, `size` times the gradient of a row.
  void apply_row(std::vector<Wrench>& loads, const Row& row, Real size) const;
  void apply(std::vector<Wrench>& loads, int marker, const Vec& at, const Wrench& w, Real sign) const;
  void apply_springs(std::vector<Wrench>& loads) const;
  void apply_sforces(std::vector<Wrench>& loads) const;
  void apply_linears(std::vector<Wrench>& loads) const;
  void apply_nforces(std::vector<Wrench>& loads) const;
  void apply_cables(std::vector<Wrench>& loads) const;
  void apply_journals(std::vector<Wrench>& loads) const;
  void apply_frictions(std::vector<Wrench>& loads) const;
  void apply_touches(std::vector<Wrench>& loads) const;
  // Of beams on their nodes, torques about them, and on slopes and middles: elasticity, inertia, weight and FE_LOADs.
  void apply_beams(std::vector<Wrench>& loads) const;
  void add_beam_masses(Dense& mass) const;
  void read_plane_beams();
  void apply_plane_beams(std::vector<Wrench>& loads) const;
  void add_plane_beam_masses(Dense& mass) const;
  void read_flexibles();
  void apply_flexibles(std::vector<Wrench>& loads) const;
  void add_flexible_masses(Dense& mass) const;
  // Wrenches on I, torque about p_I.
  [[nodiscard]] Wrench spring_wrench(std::size_t k) const;
  [[nodiscard]] Wrench sforce_wrench(std::size_t k) const;
  [[nodiscard]] Wrench linear_wrench(const LinearForce& f) const;
  [[nodiscard]] std::vector<Wrench> nforce_wrenches(const Nforce& f) const;  // on each marker
  // On the second marker of each span.
  [[nodiscard]] std::vector<Wrench> cable_wrenches(const Cable& f) const;
  [[nodiscard]] Wrench journal_wrench(const Journal& f) const;
  [[nodiscard]] Wrench general_wrench(std::size_t k) const;
  [[nodiscard]] Wrench friction_wrench(std::size_t k) const;
  [[nodiscard]] Wrench touch_wrench(std::size_t k) const;
  [[nodiscard]] const std::vector<TouchPlace>& touch_places(std::size_t k) const;
  [[nodiscard]] TouchPlace place_of_ball(const Touch& touch, const MarkerMotion& i, const MarkerMotion& j) const;
  [[nodiscard]] TouchState touch_state(const Touch& touch, const TouchPlace& place) const;
  [[nodiscard]] std::vector<Real> creep_rates(std::size_t k) const;
  [[nodiscard]] Wrench joint_wrench(int joint) const;
  [[nodiscard]] Wrench motion_wrench(int motion) const;
  [[nodiscard]] Wrench contact_wrench(std::size_t k) const;  // torque about the point of contact
  [[nodiscard]] Wrench net_wrench(int i, int j) const;  // on marker i, from all that acts between i and j; j 0: all
  // The six displacements of I as seen from J, their rates, and a wrench given in the axes of J.
  struct Displacements {
    std::array<Real, 6> y{}, rate{};
  };
  [[nodiscard]] Displacements displacements(int i, int j) const;
  [[nodiscard]] Wrench in_axes_of(int j, const std::array<Real, 6>& load) const;
  [[nodiscard]] Vec between(int i, int j) const;  // from J to I
  [[nodiscard]] Real wrench_component(const Wrench& on_i, const Vec& i_from_j, const std::vector<int>& ids) const;
  [[nodiscard]] Real load_value(const Node& node) const;  // JOINT, MOTION, SFORCE ... FX ... TM
  [[nodiscard]] Real delayed_value(const Node& node) const;
  [[nodiscard]] Real array_entry(int id, int index) const;
  [[nodiscard]] std::vector<Real> tfsiso_rates(std::size_t k) const;
  [[nodiscard]] std::vector<Real> lse_rates(std::size_t k) const;
  [[nodiscard]] std::vector<Real> gse_rates(std::size_t k) const;
  [[nodiscard]] Real gse_output(std::size_t k, std::size_t row) const;
  [[nodiscard]] Real input_entry(int array, std::size_t index) const;
  [[nodiscard]] const NumberMatrix& number_matrix(int id) const;
  [[nodiscard]] Real diff_value(std::size_t k) const;
  [[nodiscard]] Real diff_rate(std::size_t k) const;

  Mechanism mechanism_;
  std::vector<MarkerData> marker_data_;  // marker 0 is the global frame
  std::vector<MarkerMotion> markers_;
  std::map<int, int> marker_index_, variable_index_, sforce_index_, joint_index_, array_index_, gforce_index_;
  std::map<int, std::size_t> diff_index_;
  std::vector<std::array<int, 2>> spring_markers_, sforce_markers_, joint_markers_;
  std::vector<std::size_t> tfsiso_slot_, lse_slot_, gse_slot_, diff_slot_, friction_slot_;
  std::vector<Real> friction_start_;  // displacement along z of J as drawn
  struct ContactData {
    bool two_curves = false, plane = false;
    int i = 0, j = 0;             // marker indices
    int icurve = 0, jcurve = 0;   // ids
    std::array<Vec, 2> across{};  // of PTCV: normal to the curve where it was drawn, axes of j
    // On i and on j, at the present positions, with their slopes by the conditions that hold there.
    std::array<Real, 2> parameter{};
    std::array<std::array<Real, 2>, 2> slopes{};
  };
  struct LoadedSpan {                       // of an element of a beam
    std::vector<std::size_t> loads;         // places in the mechanism
    std::array<Real, line_points> place{};  // S
    std::array<std::size_t, 4> body{};      // node, slope, node, slope
    Real length = 0;
  };
  [[nodiscard]] LinePoint line_point(const LoadedSpan& span, std::size_t point) const;
  [[nodiscard]] std::vector<LoadedSpan> loaded_spans(const Beam& beam, const std::vector<Real>& lengths) const;
  using Turnings = std::array<std::array<Vec, 3>, line_points>;
  [[nodiscard]] LineLoads line_loads(const LoadedSpan& span, const Turnings& turnings) const;
  struct BeamPiece {  // between two nodes
    BeamElement element;
    std::array<std::size_t, 5> body{};  // both nodes, both slopes, the middle
    LoadedSpan span;
  };
  [[nodiscard]] Turnings turnings_of(const BeamPiece& piece) const;
  struct PlanePiece {
    BeamPlane plane;
    PlaneElement element;
    std::array<std::size_t, 4> body{};  // node, slope, node, slope
    LoadedSpan span;
  };
  struct PlaneNode {  // what a node of a plane beam keeps of where it was drawn
    BeamPlane plane;
    std::size_t node = 0, slope = 0;  // bodies
    Real height = 0;                  // along the normal
    Vec normal, across;               // in its own axes
  };
  // Each node of a plane beam has five rows: itself and its first and second rate; what it does to node and slope.
  [[nodiscard]] std::array<Real, 3> plane_row(const Row& row) const;
  void apply_plane_row(std::vector<Wrench>& loads, const Row& row, Real size) const;
  struct FlexibleData {
    std::size_t frame = 0, modes = 0;  // bodies
    Mat damping;
  };
  struct Carried {  // a node that is a body
    std::size_t flexible = 0, node = 0, body = 0;
  };
  struct ShapeMotion {
    Vec arm;  // from the origin of the frame
    Vec p, v, a, w, al;
    Mat T;
    std::array<Vec, 3> shift, turn;  // velocities by the rates of the modes
  };
  [[nodiscard]] ShapeMotion shape_motion(std::size_t flexible, std::size_t node) const;
  // Of a row: itself and its first and second rate; what it does to node, frame and modes.
  [[nodiscard]] std::array<Real, 3> shape_row(const Row& row) const;
  void apply_shape(std::vector<Wrench>& loads, const Row& row, Real size) const;
  std::vector<FlexibleData> flexible_data_;
  std::vector<Carried> carried_;
  [[nodiscard]] BeamPose<Jet> pose_along_motion(const BeamPiece& piece) const;
  [[nodiscard]] PlanePose<Jet> pose_along_motion(const PlanePiece& piece) const;
  [[nodiscard]] const BeamDirections& directions(std::size_t piece) const;
  std::vector<BeamPiece> pieces_;
  std::vector<PlanePiece> plane_pieces_;
  std::vector<PlaneNode> plane_nodes_;
  mutable std::vector<BeamDirections> beam_directions_;        // of the present positions, once asked for
  mutable std::vector<std::vector<TouchPlace>> touch_places_;  // the same; none: not asked for
  std::map<int, CurveShape> curves_;
  std::vector<ContactData> contact_data_;
};

// In how many directions the surfaces of a joint slip.
[[nodiscard]] constexpr int surface_directions(JointType type) {
  return type == JointType::spherical ? 3 : type == JointType::cylindrical ? 2 : 1;
}

// f, f' and f'' of a motion.
[[nodiscard]] std::array<Real, 3> motion_values(const TimeFunction& f, Real t);

[[nodiscard]] inline Vec to_vec(const Triple& t) { return {t[0], t[1], t[2]}; }
[[nodiscard]] inline Triple to_triple(const Vec& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

// Psi, theta, phi of rotation_313.
[[nodiscard]] inline Triple angles_313(const Mat& R) {
  const auto& c = R.column;
  const Real off = std::hypot(c[2].x, c[2].y), theta = std::atan2(off, c[2].z);
  // Where z leads along itself one of the turns about it says all.
  if (off < 1e-12L) return to_triple({std::atan2(c[0].y, c[0].x), theta, 0});
  return to_triple({std::atan2(c[2].x, -c[2].y), theta, std::atan2(c[0].z, c[1].z)});
}
[[nodiscard]] inline Mat rotation_313(const Triple& angles) { return rotation_313(angles[0], angles[1], angles[2]); }

// Rows in the given order that add rank; a dependent row keeps less than `tolerance` of its own length.
[[nodiscard]] std::vector<int> independent_rows(const Dense& m, Real tolerance);

// Places the model at a point, poses as given (rotations made orthonormal), without touching constraints.
void place(Model& model, const OraclePoint& point);

// Which velocities of which bodies must not change.
struct Stated {
  std::vector<bool> v, w;
};

// Changes the velocities that are not stated by the least amount that satisfies the constraints, measured by
// mass-centre velocities and length times angular velocities.
void complete_velocities(Model& model, const Stated& stated);

// Solves accelerations, multipliers, variables and forces at the placed instant from zero. Throws when Newton
// fails.
std::vector<Real> solve_algebra(Model& model);

// About the axes of the node, out of the six numbers of the body file.
[[nodiscard]] Mat inertia_of(const Flexible::Node& node);
// Of its modes where the frame is held, [1/time].
[[nodiscard]] Real lowest_frequency(const Flexible& flexible);

}  // namespace dynalin::oracle
