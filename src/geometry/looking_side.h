// What of a convex body of flat faces looks in a direction.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "geometry/convex_body.h"

namespace dynalin {

inline constexpr double one_side = 0.70711;  // cosine of the bend between faces of one side, less than 45 degrees
inline constexpr double in_view = 0.17;      // cosine: of a face of a side with the direction in which it looks
inline constexpr std::size_t no_edge = std::numeric_limits<std::size_t>::max();

// An edge of the outline of a side.
struct OutlineEdge {
  ConvexBody::Index from, to;
  std::size_t before = no_edge, after = no_edge;  // that end and begin with its ends
};

// What of a body looks in a direction: the face that looks most that way, and all to which it goes on in bends of less
// than 45 degrees, as far as they are in view and reach to a height along it. Of a box that is one face.
struct LookingSide {
  std::vector<ConvexBody::Index> faces, beyond;  // beyond: those that the others end at
  std::vector<ConvexBody::Index> corners;
  std::vector<OutlineEdge> outline;

  LookingSide(const ConvexBody& body, ConvexBody::Index most, const Vector& direction, double height) {
    const auto reaches = [&](ConvexBody::Index face) {
      return std::ranges::any_of(body.faces()[face].corners,
                                 [&](ConvexBody::Index c) { return dot(direction, body.corners()[c]) >= height; });
    };
    enum : std::uint8_t { unseen, looking, ending };
    std::vector<std::uint8_t> state(body.faces().size(), unseen);
    faces.push_back(most), state[most] = looking;
    for (std::size_t k = 0; k < faces.size(); ++k) {
      for (const ConvexBody::Index other : body.faces()[faces[k]].across) {
        const Vector& normal = body.faces()[other].normal;
        if (state[other] == looking || dot(normal, direction) <= in_view) continue;
        if (dot(normal, body.faces()[faces[k]].normal) > one_side && reaches(other))
          faces.push_back(other), state[other] = looking;
      }
    }
    for (const ConvexBody::Index f : faces) {
      const ConvexBody::Face& face = body.faces()[f];
      corners.insert(corners.end(), face.corners.begin(), face.corners.end());
      for (std::size_t n = 0; n < face.corners.size(); ++n) {
        const ConvexBody::Index across = face.across[n];
        if (state[across] == looking) continue;
        outline.push_back({face.corners[n], face.corners[(n + 1) % face.corners.size()]});
        if (state[across] == unseen) beyond.push_back(across), state[across] = ending;
      }
    }
    std::ranges::sort(corners);
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    std::vector<std::size_t> starting(body.corners().size(), no_edge);
    for (std::size_t k = 0; k < outline.size(); ++k) starting[outline[k].from] = k;
    for (std::size_t k = 0; k < outline.size(); ++k) {
      outline[k].after = starting[outline[k].to];
      if (outline[k].after != no_edge) outline[outline[k].after].before = k;
    }
  }
};

}  // namespace dynalin
