// Bodies of facets that are not convex, poses, and touches in volumes in common, of facets and of solids alike.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "geometry/moved_frame_test_support.h"
#include "geometry/overlap_touch.h"
#include "geometry/polygon.h"
#include "geometry/prism.h"

namespace dynalin::overlap_test {

using Seeded = Dual<12>;

// An outline in the plane of x and y, swept along z.
inline FacetBody swept(const std::vector<std::array<double, 2>>& outline, double low, double high) {
  std::vector<Vector> corners;
  for (const auto& [x, y] : outline) corners.push_back({x, y, low});
  return FacetBody(prism(corners, Outline::closed, {0, 0, high - low}));
}
inline FacetBody angle() { return swept({{0, 0}, {1, 0}, {1, 0.3}, {0.4, 0.3}, {0.4, 0.9}, {0, 0.9}}, -0.3, 0.4); }
inline FacetBody star(int points) {
  std::vector<std::array<double, 2>> outline;
  for (int k = 0; k < 2 * points; ++k) {
    const double r = k % 2 == 0 ? 0.7 : 0.35, a = std::numbers::pi * k / points;
    outline.push_back({r * std::cos(a), r * std::sin(a)});
  }
  return swept(outline, -0.25, 0.3);
}

inline const RelativeFrame<double> upright{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
inline RelativeFrame<double> at(const Vector& p, RelativeFrame<double> f = upright) {
  f.p = p;
  return f;
}

// Those that are closed. `I` is a body of facets or a solid, whose touch_overlaps the caller includes.
template <class Body>
std::vector<Touch<double>> touches(const Body& I, const RelativeFrame<double>& f, const FacetBody& J,
                                   bool cavity = false) {
  std::vector<Touch<double>> list(most_overlaps);
  touch_overlaps<double>(I, f, J, cavity, list);
  std::erase_if(list, [](const auto& t) { return !t.closed(); });
  return list;
}
// The same with their derivatives.
template <class Body>
std::vector<Touch<Seeded>> seeded_touches(const Body& I, const RelativeFrame<double>& f, const FacetBody& J,
                                          bool cavity = false) {
  const auto along = [](const Vector& v) { return Vec3<Taylor>{Taylor(v.x), Taylor(v.y), Taylor(v.z)}; };
  const auto s = path::seeded<12>({along(f.p), along(f.x), along(f.y), along(f.z)});
  const auto values = [](const auto& v) { return Vec3<Seeded>{v.x.value, v.y.value, v.z.value}; };
  std::vector<Touch<Seeded>> list(most_overlaps);
  touch_overlaps<Seeded>(I, {values(s.p), values(s.x), values(s.y), values(s.z)}, J, cavity, list);
  std::erase_if(list, [](const auto& t) { return !t.closed(); });
  return list;
}

inline void expect_near(const Vector& a, const Vector& b, double tolerance) {
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], tolerance) << k;
}

// Derivatives against differences, of touches that are as many beside a pose. `tolerance`: of a partial, and of 1.
template <class Body>
void expect_differences(const std::vector<Touch<Seeded>>& list, const Body& I, const RelativeFrame<double>& f,
                        const FacetBody& J, double tolerance, bool cavity = false) {
  constexpr double h = 1e-6;
  for (std::size_t n = 0; n < 6; ++n) {
    const auto plus = touches(I, moved(f, n, h), J, cavity), minus = touches(I, moved(f, n, -h), J, cavity);
    if (plus.size() != list.size() || minus.size() != list.size()) continue;
    for (const auto& t : list) {
      const auto like = [&](const std::vector<Touch<double>>& of) {
        return *std::ranges::min_element(of, {}, [&](const auto& o) { return norm(o.point - value_of(t.point)); });
      };
      const Touch<double> up = like(plus), down = like(minus);
      const auto expect = [&](double partial, double high, double low) {
        EXPECT_NEAR(partial, (high - low) / (2 * h), tolerance * (1 + std::abs(partial))) << n;
      };
      expect(t.gap.partial[n], up.gap, down.gap);
      for (std::size_t c = 0; c < 3; ++c) {
        expect(t.normal[c].partial[n], up.normal[c], down.normal[c]);
        expect(t.point[c].partial[n], up.point[c], down.point[c]);
      }
    }
  }
}

// Poses by chance, the same in every run.
class Poses : public ::testing::Test {
 protected:
  RelativeFrame<double> pose(double far, const Vector& about = {}) {
    std::normal_distribution<double> n;
    const Matrix3 R = rotation_exponential({n(random_), n(random_), n(random_)});
    return {about + Vector{far * n(random_), far * n(random_), far * n(random_)}, R.x, R.y, R.z};
  }
  int draw(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

  // Solids turned by eighths and shifted by eighths of two bodies' size, so that rims and mantles lie in faces, along
  // edges and in corners: what is found is continuous, and both what is in a body and what is around it make up the
  // solid, `whole(solid)`. `most_open` poses may be left open. The caller includes find_overlaps of its solid.
  template <class Solid, std::size_t count, class Whole>
  void expect_definite_on_one_grid(const std::array<Solid, count>& solids, int poses, int most_open,
                                   const Whole& whole) {
    const FacetBody a = swept({{0, 0}, {1, 0}, {1, 0.25}, {0.5, 0.25}, {0.5, 1}, {0, 1}}, -0.25, 0.25),
                    b = swept({{0, 0}, {0.25, 0}, {0.25, 0.5}, {0.75, 0.5}, {0.75, 0}, {1, 0}, {1, 0.75}, {0, 0.75}}, 0,
                              0.5);
    int seen = 0, open = 0;
    for (int k = 0; k < poses; ++k) {
      const Solid& solid = solids[static_cast<std::size_t>(draw(static_cast<int>(count)))];
      const FacetBody& J = draw(2) == 0 ? a : b;
      Matrix3 R = Matrix3::identity();
      for (int t = 0; t < 2; ++t)
        R = rotation_exponential(unit_vectors[static_cast<std::size_t>(draw(3))] * (draw(8) * std::numbers::pi / 4)) *
            R;
      RelativeFrame<double> f{{0.125 * (draw(13) - 2), 0.125 * (draw(13) - 2), 0.125 * (draw(9) - 4)}, R.x, R.y, R.z};
      const auto volume = [&](bool cavity) {
        const auto found = find_overlaps(solid, f, J, cavity);
        open += !found.definite;
        double sum = found.definite && !found.engulfed ? 0 : std::numeric_limits<double>::quiet_NaN();
        for (const auto& o : found.volumes) {
          EXPECT_GT(o.volume, -1e-12) << k;
          sum += o.volume;
        }
        return sum;
      };
      const double here = volume(false), around = volume(true);
      f.p += Vector{1.3e-9, -0.7e-9, 0.9e-9};
      const double beside = volume(false);
      if (std::isnan(here + beside + around)) continue;
      EXPECT_NEAR(beside, here, 1e-8) << k;
      if (here > 1e-6 && around > 1e-6) {
        EXPECT_NEAR(here + around, whole(solid), 1e-9) << k;
      }
      seen += here > 1e-3;
    }
    EXPECT_GT(seen, poses / 10);
    EXPECT_LT(open, most_open);
  }

  std::mt19937_64 random_{5};
};

}  // namespace dynalin::overlap_test
