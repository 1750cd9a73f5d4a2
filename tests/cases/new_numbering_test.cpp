// Coordinates outside bodies are in the numbering: an element made for this test, a bead on a parabola with its curve
// parameter as a coordinate.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "eigenvalues/eigen.h"
#include "elements/catalogue.h"
#include "linear/linear_system.h"
#include "mechanics/kernel.h"
#include "model/schema.h"
#include "states/candidates.h"

namespace dynalin::new_numbering_test {
namespace {

// UCON/id, I=, DISP=a: x_I = s, y_I = a s² in global coordinates, with s a coordinate of its own.
struct Parabola {
  MarkerId i;
  double curvature = 0;
  static constexpr std::array<Argument<Parabola>, 2> arguments = {{
      {.name = "I", .slot = &Parabola::i, .required = true},
      {.name = "DISP", .slot = &Parabola::curvature, .required = true},
  }};
};

constexpr StateType type_of_s = StateType::cvcv;  // of a curve, like this one

class ParabolaKernel final : public Kernel {
 public:
  ParabolaKernel(const std::vector<Parabola>& elements, const std::vector<ElementLabel>& labels, Layout& layout)
      : layout_(layout) {
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const std::int32_t s = layout.add_extra(labels[k], {type_of_s}, {{.name = "s"}});
      const std::int32_t first = layout.add_row(labels[k], "x");
      layout.add_row(labels[k], "y");
      beads_.push_back({layout.marker(elements[k].i), elements[k].curvature, s, first});
    }
  }
  void constraints(const Motion& motion, ConstraintRows& rows) const override {
    for (const Bead& b : beads_) {
      const std::size_t e = layout_.extra_index(b.s);
      const Taylor s(motion.extra[e], motion.extra_rate[e], motion.extra_acceleration[e]);
      const Frame<Taylor> I = motion.frame(b.I);
      const BodyMotion& body = motion.body(b.I.body);
      const Vec3<Taylor> arm = I.origin - along_motion(body.r, body.rdot, body.rddot);
      for (std::int32_t k = 0; k < 2; ++k) {
        const Vec3<Taylor> e_k{Taylor(k == 0 ? 1.0 : 0.0), Taylor(k == 1 ? 1.0 : 0.0), Taylor(0.0)};
        rows.set(b.row + k, k == 0 ? I.origin.x - s : I.origin.y - b.a * s * s);
        rows.add_pose(b.row + k, b.I.body, e_k, cross(arm, e_k));
        rows.add_coordinate(b.row + k, b.s, k == 0 ? Taylor(-1.0) : -2.0 * b.a * s);
      }
    }
  }
  void equations(const Motion& motion, Equations& eq) const override {
    // ∂(Φ_qᵀλ)/∂q: only the second row is curved, in s alone.
    for (const Bead& b : beads_) {
      const double lambda = motion.lambda[static_cast<std::size_t>(b.row) + 1];
      eq.add(PartialBy::position, b.s, b.s, 2.0 * b.a * lambda);
    }
  }

 private:
  struct Bead {
    MarkerPlace I;
    double a;
    std::int32_t s, row;
  };
  const Layout& layout_;
  std::vector<Bead> beads_;
};

template <class E, class K>
class TestSet final : public TypedSet<E> {
 public:
  using TypedSet<E>::TypedSet;
  void read(std::size_t k, ElementReader& reader) override { read_arguments(this->elements[k], reader); }
  std::unique_ptr<Kernel> make_kernel(const Model&, Layout& layout) const override {
    return std::make_unique<K>(this->elements, this->labels, layout);
  }
};
template <class E, class K>
constexpr Kind test_kind(std::string_view statement) {
  return {statement,
          "",
          "",
          Kind::Role::element,
          detail::argument_infos<E>,
          [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<TestSet<E, K>>(kind); }};
}
constexpr Kind parabola = test_kind<Parabola, ParabolaKernel>("UCON");

std::shared_ptr<const System> system_of(const std::string& text) {
  std::vector<const Kind*> kinds(catalogue().begin(), catalogue().end());
  kinds.push_back(&parabola);
  auto dataset = parse_dataset(std::make_shared<const SourceText>("test.adm", text));
  EXPECT_FALSE(dataset.diagnostics.has_errors()) << render(dataset.diagnostics);
  auto model = build_model(std::make_shared<const Dataset>(std::move(dataset.value)), kinds);
  EXPECT_FALSE(model.diagnostics.has_errors()) << render(model.diagnostics);
  return System::make(std::move(model.value)).value();
}

const std::string bead =
    "Bead\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nPOINT_MASS/2, MASS=3, "
    "CM=2\nMARKER/2\nMARKER/3, PART=1\nUCON/7, I=2, DISP=1.7\n"
    "! out of the plane the bead is held by a spring\nMARKER/4, PART=1, QP=0,0,-1\nSPRINGDAMPER/1, TRANSLATIONAL, "
    "I=2, J=4, K=12, LENGTH=1\nEND\n";

TEST(NewNumbering, a_coordinate_of_its_own_is_listed_as_its_owner_says) {
  const auto system = system_of(bead);
  const auto candidates = state_candidates(*system, system->motion(system->drawn()), {});
  ASSERT_TRUE(candidates);
  ASSERT_EQ(candidates->wanted.size(), 4u);
  const StateCoordinate& s = candidates->wanted.back().state;
  EXPECT_EQ(s.label.type, type_of_s);
  EXPECT_EQ(s.label.owner, (ElementId{"UCON", 7}));
  EXPECT_EQ(s.label.element, 7);
  EXPECT_EQ(s.label.text, "s");
  EXPECT_EQ(s.label.coordinate, 1);
  EXPECT_FALSE(s.label.is_rate);
  EXPECT_EQ(s.rate.type, type_of_s);
  EXPECT_EQ(s.rate.coordinate, 1);
  EXPECT_TRUE(s.rate.is_rate);
  EXPECT_EQ(s.scale, 1);
}

TEST(NewNumbering, bead_on_a_parabola_swings_with_the_curvature) {
  const auto system = system_of(bead);
  Findings findings;
  const auto op = initial_conditions(*system, findings);
  ASSERT_TRUE(op) << op.error().message;
  const auto linear = linearize(*system, *op, {});
  ASSERT_TRUE(linear) << linear.error().message;
  ASSERT_EQ(linear->model.states.size(), 4u);
  EXPECT_EQ(linear->model.states[1].type, StateType::point_mass);
  EXPECT_EQ(linear->model.states[1].coordinate, 1);
  EXPECT_EQ(linear->model.states[0].coordinate, 4);
  const auto modes = eigensolve(*linear);
  ASSERT_TRUE(modes);
  // ω² = 2 a g along the curve, k/m across it.
  EXPECT_NEAR(modes->modes[0].eigenvalue_hz.imag(), std::sqrt(12.0 / 3) / (2 * std::numbers::pi), 1e-14);
  EXPECT_NEAR(modes->modes[1].eigenvalue_hz.imag(), std::sqrt(2 * 1.7 * 9.81) / (2 * std::numbers::pi), 1e-14);
}

}  // namespace
}  // namespace dynalin::new_numbering_test
