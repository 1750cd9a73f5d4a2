// Marker frames and measures varied by one block of coordinates, of a pose, modal or a curve parameter, against
// differences of paths.
#include "mechanics/frame_variations.h"

#include <gtest/gtest.h>

#include "mechanics/paths_test_support.h"

namespace dynalin::mechanics_test::frame_variations_test {
namespace {

constexpr std::size_t all_levels = 18;

// A space curve, a cubic that the program reproduces exactly: c(u) = a + b u + c u² + d u³.
struct Cubic {
  std::array<Vector, 4> of{Vector{0.1, -0.2, 0.3}, Vector{1, 0.4, -0.3}, Vector{0.1, 0.4, 0.25},
                           Vector{-0.15, 0.1, 0.2}};

  template <class T>
  Vec3<T> at(const T& u) const {
    Vec3<T> sum{};
    T power = T(1.0);
    for (const Vector& c : of) {
      for (std::size_t k = 0; k < 3; ++k) sum[k] = sum[k] + c[k] * power;
      power = power * u;
    }
    return sum;
  }
  ParametricCurve curve() const {
    ParametricCurve::Points points;
    for (int k = 0; k <= 6; ++k) points.push_back(at(-1 + k / 3.0));
    return {points, ParametricCurve::Shape::open, ParametricCurve::Data::points};
  }
  // x along the tangent, y away from the centre of curvature.
  Frame<Real> frame(Real u) const {
    const RealVector tangent = slope([&](Real du) { return at(u + du); });
    const RealVector bend = second_slope([&](Real du) { return at(u + du); });
    const RealVector x = tangent / norm(tangent), across = cross(bend, tangent), z = across / norm(across);
    return {at(u), {x, cross(z, x), z}};
  }
};

// Paths with one marker that runs along a curve on PART/3 at the first parameter.
struct WithCurve {
  Paths p{3};
  Cubic cubic;
  ParametricCurve curve = cubic.curve();
  MarkerId carrier{4};

  MarkerFrame fixed(std::int32_t m) const { return {&p.marker(m)}; }
  MarkerFrame on_curve() const { return {&p.layout.marker(carrier), &curve, parameter(), Paths::modal_coordinates}; }
  std::int32_t parameter() const { return p.parameter(); }
  CoordinateBlock pose(std::int32_t body) const {
    const BodyBlock& block = p.layout.body({body});
    return {CoordinateBlock::Kind::pose, {body}, block.offset, static_cast<std::uint8_t>(block.count)};
  }
  // All of PART/3, or from one of them on.
  CoordinateBlock modal(std::size_t first = 0) const {
    return {CoordinateBlock::Kind::modal,
            {2},
            p.layout.body_coordinate_count + 2 + static_cast<std::int32_t>(first),
            static_cast<std::uint8_t>(4 - first),
            first};
  }
  CoordinateBlock along_curve(std::int32_t k = 0) const {
    return {CoordinateBlock::Kind::curve_parameter, {2}, p.parameter(k), 1};
  }

  // Origin and axes of the point on the curve along a path.
  Frame<Real> point(const Moment& m) const {
    const Frame<Real> local = cubic.frame(m.parameter(0));
    return {m.origin(carrier) + m.axes(carrier) * local.origin, m.axes(carrier) * local.axes};
  }
};

template <std::size_t N, class Function>
void expect_variation(const Paths& p, const path::Seeded<N>& x, std::size_t seed, std::int32_t column,
                      std::size_t level, const std::string& what, const Function& f) {
  const auto gradient = [&](const Moment& m) { return m.partial(column, level, f); };
  const std::string by = what + " by " + coordinate_name(p.layout, column, level);
  EXPECT_TRUE(agree(x.value.partial[seed], gradient(p.now()))) << by;
  EXPECT_TRUE(agree(x.rate.partial[seed], p.now().rate(gradient))) << "rate of " << by;
  EXPECT_TRUE(agree(x.acceleration.partial[seed], p.now().second_rate(gradient))) << "second rate of " << by;
}

TEST(FrameVariations, a_frame_moves_with_all_that_it_depends_on_at_all_levels) {
  const WithCurve w;
  const BodyId from{1};
  for (const bool curved : {false, true}) {
    const MarkerFrame marker = curved ? w.on_curve() : w.fixed(5);
    std::vector<CoordinateBlock> blocks{w.pose(2), w.modal(), w.modal(1)};
    if (curved) blocks.push_back(w.along_curve());
    for (const CoordinateBlock& block : blocks) {
      const auto f = path::varied_frame<all_levels>(w.p.motion, marker, block, from);
      const auto frame = [&](const Moment& m) {
        return curved ? w.point(m) : Frame<Real>{m.origin(MarkerId{5}), m.axes(MarkerId{5})};
      };
      for (std::size_t seed = 0; seed < all_levels; ++seed) {
        const std::size_t of_block = seed % 6;
        if (of_block >= block.count) continue;
        const std::int32_t column = block.column + static_cast<std::int32_t>(of_block);
        for (std::size_t k = 0; k < 3; ++k) {
          expect_variation<all_levels>(w.p, f.origin[k], seed, column, seed / 6, "origin",
                                       [&](const Moment& m) { return frame(m).origin[k] - m.origin_of(from)[k]; });
        }
        const std::size_t r = seed % 3, c = (seed + 1) % 3;  // one entry of the axes for each seed
        expect_variation<all_levels>(w.p, f.axes[c][r], seed, column, seed / 6, "axis",
                                     [&](const Moment& m) { return frame(m).axes[c][r]; });
      }
    }
  }
}

TEST(FrameVariations, a_frame_stays_where_another_block_is_varied) {
  const WithCurve w;
  for (const CoordinateBlock& block :
       {w.pose(1), w.along_curve(), CoordinateBlock{CoordinateBlock::Kind::modal, {1}, w.modal().column - 2, 2}}) {
    const auto f = path::varied_frame<6>(w.p.motion, w.fixed(5), block, ground_body);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(f.origin[k].value.partial, (std::array<double, 6>{}));
      EXPECT_EQ(f.axes[k].y.rate.partial, (std::array<double, 6>{}));
      EXPECT_TRUE(
          agree(f.origin[k].rate.value, w.p.now().rate([&](const Moment& m) { return m.origin(MarkerId{5})[k]; })));
    }
  }
  const auto f = path::varied_frame<6>(w.p.motion, w.on_curve(), w.along_curve(1), ground_body);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(f.origin[k].value.partial, (std::array<double, 6>{}));
}

TEST(FrameVariations, a_marker_depends_on_the_pose_of_its_body_its_modal_coordinates_and_its_curve) {
  const WithCurve w;
  std::vector<std::array<std::int32_t, 2>> found;
  const auto note = [&](const CoordinateBlock& b) { found.push_back({b.column, b.count}); };
  for_each_coordinate_block(w.on_curve(), w.p.layout, note);
  EXPECT_EQ(found, (std::vector<std::array<std::int32_t, 2>>{{6, 6}, {23, 4}, {27, 1}}));
  found.clear();
  for_each_coordinate_block(w.fixed(6), w.p.layout, note);
  for_each_coordinate_block(w.fixed(1), w.p.layout, note);
  EXPECT_EQ(found, (std::vector<std::array<std::int32_t, 2>>{{12, 3}}));
}

TEST(FrameVariations, a_contact_marker_has_the_motion_of_its_parameter) {
  const WithCurve w;
  const Frame<Taylor> f = w.on_curve().frame(w.p.motion, ground_body);
  const Vec3<Taylor> arm = w.on_curve().arm(w.p.motion);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto origin = [&](const Moment& m) { return w.point(m).origin[k]; };
    const auto from_body = [&](const Moment& m) { return (w.point(m).origin - m.origin_of(BodyId{2}))[k]; };
    EXPECT_TRUE(agree(f.origin[k].value, origin(w.p.now())));
    EXPECT_TRUE(agree(f.origin[k].rate, w.p.now().rate(origin)));
    EXPECT_TRUE(agree(f.origin[k].acceleration, w.p.now().second_rate(origin)));
    EXPECT_TRUE(agree(arm[k].value, from_body(w.p.now())));
    EXPECT_TRUE(agree(arm[k].rate, w.p.now().rate(from_body)));
    EXPECT_TRUE(agree(arm[k].acceleration, w.p.now().second_rate(from_body)));
    EXPECT_TRUE(agree(w.on_curve().axes(w.p.motion).y[k], w.point(w.p.now()).axes.y[k]));
  }
}

// Measures by their definitions, from positions alone.
RealVector displacement(const Moment& m, MarkerId i, MarkerId j) { return m.origin(i) - m.origin(j); }
Real velocity_along_x(const Moment& m, MarkerId i, MarkerId j, MarkerId k, MarkerId l) {
  return dot(m.axes(k).x, m.rate_seen_from(l, [&](const Moment& n) { return displacement(n, i, j); }));
}

TEST(FrameVariations, measures_are_varied_by_each_block_they_see) {
  const WithCurve w;
  const MarkerId i{2}, j{5}, k{9}, l{3};
  const std::array<MarkerFrame, 4> places{w.fixed(2), w.fixed(5), w.fixed(9), w.fixed(3)};
  for (const CoordinateBlock& block : {w.pose(1), w.pose(2), w.pose(4), w.modal()}) {
    const auto dx = path::varied_measure<6>(Measure::DX, places, w.p.motion, block);
    const auto vx = path::varied_measure<12>(Measure::VX, places, w.p.motion, block);
    const auto wy = path::varied_measure<12>(Measure::WY, places, w.p.motion, block);
    for (std::int32_t c = 0; c < block.count; ++c) {
      const auto seed = static_cast<std::size_t>(c);
      const std::int32_t column = block.column + c;
      expect_variation<6>(w.p, dx, seed, column, 0, "DX",
                          [&](const Moment& m) { return dot(m.axes(k).x, displacement(m, i, j)); });
      const auto by_rate = [&](const Moment& m) { return velocity_along_x(m, i, j, k, l); };
      EXPECT_TRUE(agree(vx.value.partial[seed], w.p.now().partial(column, 0, by_rate))) << "VX by " << column;
      EXPECT_TRUE(agree(vx.value.partial[6 + seed], w.p.now().partial(column, 1, by_rate))) << "VX by rate " << column;
      const auto turning = [&](const Moment& m) {
        return dot(m.axes(k).y, m.angular_velocity(i) - m.angular_velocity(j));
      };
      EXPECT_TRUE(agree(wy.value.partial[seed], w.p.now().partial(column, 0, turning))) << "WY by " << column;
      EXPECT_TRUE(agree(wy.value.partial[6 + seed], w.p.now().partial(column, 1, turning))) << "WY by rate " << column;
    }
  }
}

TEST(FrameVariations, measures_are_varied_by_the_parameter_of_a_contact) {
  const WithCurve w;
  const std::array<MarkerFrame, 4> places{w.on_curve(), w.fixed(2), w.fixed(9), w.fixed(0)};
  const auto dz = path::varied_measure<6>(Measure::DZ, places, w.p.motion, w.along_curve());
  const auto vz = path::varied_measure<12>(Measure::VZ, places, w.p.motion, w.along_curve());
  const auto z = [&](const Moment& m) { return dot(m.axes(MarkerId{9}).z, w.point(m).origin - m.origin(MarkerId{2})); };
  const auto rate_of_z = [&](const Moment& m) {
    return dot(m.axes(MarkerId{9}).z,
               m.rate([&](const Moment& n) { return w.point(n).origin - n.origin(MarkerId{2}); }));
  };
  expect_variation<6>(w.p, dz, 0, w.parameter(), 0, "DZ", z);
  for (const std::size_t level : {0u, 1u})
    EXPECT_TRUE(agree(vz.value.partial[6 * level], w.p.now().partial(w.parameter(), level, rate_of_z)));
}

}  // namespace
}  // namespace dynalin::mechanics_test::frame_variations_test
