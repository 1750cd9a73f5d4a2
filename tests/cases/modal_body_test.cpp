// A body with a modal coordinate of its own: a lump that slides along, turns about or is screwed along an axis of the
// body is one mode of it, exactly. The same mechanism of rigid parts and joints says what the linear model must be.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <numbers>

#include "elements/catalogue.h"
#include "linear/linear_system.h"
#include "mechanics/frame_variations.h"
#include "mechanics/pair.h"
#include "system/system.h"

namespace dynalin::modal_body_test {
namespace {

constexpr double speed = 11;  // of the whole about the global z axis
const Vector origin{0.4, -0.3, 0.2};
const Matrix3 axes = rotation_exponential({0.4, -0.7, 0.5});

// The axis of the mode in the BCS, its point, and what a unit of the coordinate does.
struct Mode {
  const char* name;
  bool turns;          // about the axis, else it slides along it
  double advance = 0;  // along the axis in one radian
};
const Vector node{0.3, 0.1, -0.2}, direction = normalized(Vector{0.5, -0.6, 0.9});
constexpr double stiffness = 900, damping = 3;

struct Particle {
  double mass;
  Vector at;  // undeformed, in the BCS
};
const std::array<Particle, 4> lump{
    {{0.7, {0.6, 0.2, -0.1}}, {0.4, {0.2, 0.5, -0.3}}, {0.9, {0.4, -0.1, 0.3}}, {0.5, {0.1, 0.0, -0.6}}}};

std::string text(const Vector& v) { return fmt::format("{:.17g},{:.17g},{:.17g}", v.x, v.y, v.z); }
// 3-1-3 angles.
std::string angles(const Matrix3& R) {
  return fmt::format("{:.17g},{:.17g},{:.17g}", std::atan2(R.z.x, -R.z.y), std::acos(R.z.z), std::atan2(R.x.z, R.y.z));
}
// Everything turns as one body at the start.
std::string turning(const Vector& centre) {
  const Vector at = origin + axes * centre;
  return fmt::format(", VX={:.17g}, VY={:.17g}, VZ=0, WX=0, WY=0, WZ={:.17g}, VM=1, WM=1", -speed * at.y, speed * at.x,
                     speed);
}

// `twin`: the lump is PART/3 on joints; else its markers are on PART/2.
std::string dataset(const Mode& mode, bool twin) {
  const std::string place = fmt::format(", QG={}, REULER={}", text(origin), angles(axes));
  Matrix3 along{};  // axes with z along the mode
  along.z = direction, along.x = normalized(cross(Vector{1, 0, 0}, direction)), along.y = cross(along.z, along.x);
  const Vector body_centre{0.1, -0.2, 0.15}, arm_centre{0.9, 0.4, 0.1};
  std::string t = "Mode\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nMARKER/2, QP=1.5,0.3,0.4\n";
  t += fmt::format("PART/2, MASS=3, CM=20, IP=0.4,0.5,0.6{}{}\n", place, turning(body_centre));
  t += fmt::format("MARKER/20, QP={}\n", text(body_centre));
  // On the global z axis.
  t +=
      fmt::format("MARKER/21, QP={}, REULER={}\n", text(-1.0 * transpose_times(axes, origin)), angles(transpose(axes)));
  t += fmt::format("MARKER/22, QP={}, REULER={}\n", text(node), angles(along));
  double mass = 0;
  Vector centre{};
  for (const Particle& p : lump) mass += p.mass, centre += p.mass * p.at;
  centre = centre / mass;
  std::array<double, 6> inertia{};
  for (const Particle& p : lump) {
    const Vector r = p.at - centre;
    inertia[0] += p.mass * (r.y * r.y + r.z * r.z), inertia[1] += p.mass * (r.x * r.x + r.z * r.z);
    inertia[2] += p.mass * (r.x * r.x + r.y * r.y);
    inertia[3] += p.mass * r.x * r.y, inertia[4] += p.mass * r.x * r.z, inertia[5] += p.mass * r.y * r.z;
  }
  if (twin) {
    t += fmt::format("PART/3, MASS={:.17g}, CM=30, IP={:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}{}{}\n", mass,
                     inertia[0], inertia[1], inertia[2], inertia[3], inertia[4], inertia[5], place, turning(centre));
    t += fmt::format("MARKER/30, QP={}\n", text(centre));
  }
  const int carrier = twin ? 3 : 2;
  t += fmt::format("MARKER/31, PART={}, QP=0.7,0.3,0.1\n", carrier);
  t += fmt::format("MARKER/32, PART={}, QP=0.2,-0.4,0.3, REULER=0.3,0.8,-0.4\n", carrier);
  t += fmt::format("MARKER/33, PART={}, QP={}, REULER={}\n", carrier, text(node), angles(along));
  // A pendulum on the lump.
  t += fmt::format("PART/4, MASS=1.3, CM=40, IP=0.1,0.15,0.2{}{}\n", place, turning(arm_centre));
  t += fmt::format("MARKER/40, QP={}\nMARKER/41, QP=0.7,0.3,0.1\nMARKER/42, QP=1.1,0.6,-0.2, REULER=1,0.4,0.2\n",
                   text(arm_centre));
  t +=
      "JOINT/1, REVOLUTE, I=21, J=1\nMOTION/1, JOINT=1, ROTATIONAL, FUNCTION=11*TIME\nJOINT/3, SPHERICAL, I=41, J=31\n";
  if (twin) {
    t += !mode.turns ? "JOINT/2, TRANSLATIONAL, I=33, J=22\n"
                     : fmt::format("JOINT/2, CYLINDRICAL, I=33, J=22\n{}",
                                   mode.advance == 0 ? "JPRIM/2, INPLANE, I=33, J=22\n"
                                                     : fmt::format("JOINT/4, SCREW, I=33, J=22, PITCH={:.17g}\n",
                                                                   2 * std::numbers::pi * mode.advance));
    t += mode.turns ? fmt::format("SPRINGDAMPER/1, ROTATIONAL, I=33, J=22, KT={}, CT={}\n", stiffness, damping)
                    : fmt::format(
                          "MARKER/34, PART=3, QP={}\n"
                          "SFORCE/1, I=34, J=22, TRANSLATIONAL, FUNCTION=-{}*DZ(33,22,22)-{}*VZ(33,22,22,22)\n",
                          text(node + direction), stiffness, damping);
  }
  // What acts on markers of the lump, and what reads them: forces of all families, a constraint, reactions.
  t += "BUSHING/1, I=32, J=2, K=40,50,60, KT=5,6,7, C=2,1,3, CT=0.4,0.3,0.2, FORCE=3,-4,5\n";
  t += "SPRINGDAMPER/3, TRANSLATION, I=32, J=42, K=300, C=2, LENGTH=0.6\n";
  t += "VARIABLE/1, FUNCTION=0.4\nPINPUT/1, VARIABLES=1\n";
  t += "SFORCE/4, I=42, J=32, TRANSLATIONAL, FUNCTION=5*VARVAL(1)+20*SIN(AZ(32,2))-0.7*VX(42,32,32,32)\n";
  t += "MARKER/9, FLOATING, PART=1\n";
  t += "VFORCE/1, I=42, JFLOAT=9, RM=32, FX=8+VARVAL(1), FY=-2*WZ(32,1), FZ=0.05*FX(41,31,32)\n";
  // What reacts on the lump wherever its own marker is, and a curve that rides on it.
  t += fmt::format("MARKER/8, FLOATING, PART={0}\nMARKER/7, FLOATING, PART={0}\n", carrier);
  t += "GFORCE/2, I=42, JFLOAT=8, RM=33, FX=4-3*DX(42,33)\\ , FY=2+VARVAL(1)\\ , TX=0.4-0.2*WX(42,8,8)\\ , TZ=0.7\n";
  // y = x² + 0.2 x³ and z = 0.3 x² − 0.1 x of four points, between which a curve is one cubic.
  t += "MATRIX/1, FULL=RORDER, ROWS=4, COLUMNS=3, VALUES=-0.9,0.6642,0.333, -0.3,0.0846,0.057, 0.3,0.0954,-0.003, "
       "0.9,0.9558,0.153\n"
       "CURVE/1, OPEN, MATRIX=1, CURVE_POINTS\n";
  const Vector bead = node + along * Vector{0.2, 0.0416, -0.008};
  t += fmt::format("PART/5, MASS=0.6, CM=50, IP=0.02,0.03,0.04{}{}\nMARKER/50, QP={}\n", place, turning(bead),
                   text(bead));
  t += "PTCV/1, I=50, JFLOAT=7, CURVE=1, RM=33\nJPRIM/5, ORIENTATION, I=50, J=20\n";
  t += "SPRINGDAMPER/5, TRANSLATION, I=50, J=2, K=70, C=1, LENGTH=0.4\n";
  const Vector between = Vector{1.1, 0.6, -0.2} - Vector{0.2, -0.4, 0.3};
  t += fmt::format("GCON/1, FUNCTION=DX(42,32)*DX(42,32)+DY(42,32)*DY(42,32)+DZ(42,32)*DZ(42,32)-{:.17g}\n",
                   dot(between, between));
  t +=
      "VARIABLE/2, FUNCTION=DX(32,2,42)\nVARIABLE/3, FUNCTION=VY(31,1,32)\nVARIABLE/4, FUNCTION=ACCX(32,1,42)\n"
      "VARIABLE/5, FUNCTION=TZ(32,2,32)+FM(41,31)\nVARIABLE/6, FUNCTION=AY(32,40)\nVARIABLE/7, FUNCTION=WDTX(32,40,1)\n"
      "VARIABLE/8, FUNCTION=GFORCE(2,1,6,33)+FY(8,42,7)\nVARIABLE/9, FUNCTION=PTCV(1,1,2,33)+WZ(7,20,20)\n"
      "POUTPUT/1, VARIABLES=2,3,4,5,6,7,8,9\n";
  // States of both, as the linear model about a motion is one of its coordinates.
  t += fmt::format(
      "VARIABLE/11, FUNCTION={}(33,22{})\nVARIABLE/12, FUNCTION=AX(40,32)\nVARIABLE/13, FUNCTION=AY(40,1)\n",
      mode.turns ? "AZ" : "DZ", mode.turns ? "" : ",22");
  t += "VARIABLE/14, FUNCTION=DX(50,33,33)\nPSTATE/1, VARIABLES=11,12,13,14\nEND\n";
  return t;
}

// Particles at places of their own and a spring on the modal coordinate.
class ModalLump final : public Kernel {
 public:
  ModalLump(const Model& model, const NodeShapes& shape, const ElementLabel& label)
      : label_(label), gravity_(model.gravity), shapes_(lump.size(), shape) {
    for (std::size_t k = 0; k < lump.size(); ++k) {
      shapes_[k].offset = lump[k].at - node;
      places_.push_back({BodyId{1}, lump[k].at, Matrix3::identity(), &shapes_[k]});
    }
  }
  void equations(const Motion& motion, Equations& eq) const override {
    eq.begin_element(label_);
    const MarkerPlace ground;
    for (std::size_t p = 0; p < lump.size(); ++p) {
      const MarkerFrame marker{&places_[p]};
      const PairMotion pair = pair_motion(motion, places_[p], ground);
      PairForce inertia;
      inertia.force = -lump[p].mass * (acceleration(marker.frame(motion, ground_body).origin) - gravity_);
      inertia.reaction = Reaction::none;
      apply(pair, inertia, eq, PartialBy::velocity);
      if (!eq.wants_partials()) continue;
      for_each_coordinate_block(marker, eq.layout(), [&](const CoordinateBlock& block) {
        const auto varied = path::varied_frame<18>(motion, marker, block, ground_body).origin;
        const std::array families = {PartialBy::position, PartialBy::velocity, PartialBy::acceleration};
        for (std::size_t level = 0; level < 3; ++level) {
          for (std::size_t k = 0; k < block.count; ++k) {
            const auto of = [&](std::size_t c) { return varied[c].acceleration.partial[6 * level + k]; };
            apply_column(pair, -lump[p].mass * Vector{of(0), of(1), of(2)}, {}, Reaction::none, families[level],
                         block.column + static_cast<std::int32_t>(k), eq);
          }
        }
      });
    }
    const std::int32_t q = eq.layout().body_coordinate_count;
    const Taylor at = motion.outside_poses(0);
    eq.add_residual(q, stiffness * at.value + damping * at.rate);
    eq.add(PartialBy::position, q, q, stiffness);
    eq.add(PartialBy::damping, q, q, damping);
  }

 private:
  ElementLabel label_;
  Vector gravity_;
  std::vector<NodeShapes> shapes_;
  std::vector<MarkerPlace> places_;
};

const Kind lump_kind{"LUMP", "", "", Kind::Role::element, {}, nullptr};
class LumpSet final : public ElementSet {
 public:
  explicit LumpSet(NodeShapes shape) : ElementSet(lump_kind), shape_(std::move(shape)) {
    labels.push_back({"LUMP", 1, {}, {}});
  }
  void append(ElementLabel) override {}
  void read(std::size_t, ElementReader&) override {}
  std::unique_ptr<Kernel> make_kernel(const Model& model, Layout&) const override {
    return std::make_unique<ModalLump>(model, shape_, labels.front());
  }

 private:
  NodeShapes shape_;
};

std::unique_ptr<Model> model_of(const std::string& text) {
  auto dataset = parse_dataset(std::make_shared<const SourceText>("mode.adm", text));
  EXPECT_FALSE(dataset.diagnostics.has_errors()) << render(dataset.diagnostics);
  auto model = build_model(std::make_shared<const Dataset>(std::move(dataset.value)), catalogue());
  EXPECT_FALSE(model.diagnostics.has_errors()) << render(model.diagnostics);
  return std::move(model.value);
}

std::shared_ptr<const System> rigid_twin(const Mode& mode) {
  return System::make(model_of(dataset(mode, true))).value();
}

std::shared_ptr<const System> with_mode(const Mode& mode) {
  std::unique_ptr<Model> model = model_of(dataset(mode, false));
  NodeShapes shape;
  shape.translation = {(mode.turns ? mode.advance : 1.0) * direction};
  shape.rotation = {(mode.turns ? 1.0 : 0.0) * direction};
  BodyNature nature = *model->bodies[1].nature;
  nature.modal = {{"Modal generalized coordinate Q1"}};
  nature.modal_kind = {StateType{99}, ExtraRole::shape};  // as of no element there is
  model->bodies[1].nature = std::make_shared<const BodyNature>(std::move(nature));
  for (const std::int64_t id : {31, 32, 33, 7, 8}) {
    MarkerPlace& place = model->markers[static_cast<std::size_t>(model->find_marker(id)->index)].place;
    auto own = std::make_unique<NodeShapes>(shape);
    own->offset = place.p_BM - node;
    place.shapes = own.get();
    model->node_shapes.push_back(std::move(own));
  }
  model->sets.push_back(std::make_unique<LumpSet>(shape));
  return System::make(std::move(model)).value();
}

LinearSystem linear_of(const System& system) {
  LinearOptions options;
  options.pinput = system.model().find("PINPUT", 1), options.poutput = system.model().find("POUTPUT", 1);
  options.pstate = system.model().find("PSTATE", 1);
  Findings findings;
  const auto op = initial_conditions(system, findings);
  if (!op) throw std::runtime_error(op.error().message + ", " + fmt::format("{}", fmt::join(op.error().details, "; ")));
  auto linear = linearize(system, *op, options);
  if (!linear) throw std::runtime_error(linear.error().message);
  return std::move(*linear);
}

void expect_equal(const Eigen::MatrixXd& found, const Eigen::MatrixXd& expected, const char* what) {
  ASSERT_EQ(found.rows(), expected.rows()) << what;
  ASSERT_EQ(found.cols(), expected.cols()) << what;
  for (Eigen::Index k = 0; k < expected.size(); ++k)
    EXPECT_NEAR(found(k), expected(k), 1e-10 * (1 + expected.cwiseAbs().maxCoeff())) << what << " at " << k;
}

TEST(ModalBody, has_the_linear_model_of_its_rigid_twin) {
  for (const Mode& mode : {Mode{"slides", false}, Mode{"turns", true}, Mode{"is screwed", true, 0.3}}) {
    SCOPED_TRACE(mode.name);
    const auto flexible = with_mode(mode), rigid = rigid_twin(mode);
    const LinearSystem a = linear_of(*flexible), b = linear_of(*rigid);
    EXPECT_EQ(a.model.states.size(), 8u);  // the mode, two freedoms of the pendulum, and the bead
    expect_equal(a.model.A, b.model.A, "A");
    expect_equal(a.model.B, b.model.B, "B");
    expect_equal(a.model.C, b.model.C, "C");
    expect_equal(a.model.D, b.model.D, "D");
  }
}

}  // namespace
}  // namespace dynalin::modal_body_test
