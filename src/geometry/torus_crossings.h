// Which parts of facets that are in a torus bound one volume. Lines in which the facets cut the torus' surface are
// loops on it, around nothing, around the axis, around the tube or both. Two loops bound the same part of that surface
// where a way on it leads from one to the other through the body. Ways are looked for around the tube, up from a seam,
// a circle about the axis at which the angle v in the tube begins anew: cut open there the surface is a cylinder, and
// from the highest place of whatever is drawn on that a way leads upwards to the next loop or to the seam. What of the
// seam is in the body joins what it leads to.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "base/joined_sets.h"
#include "geometry/torus_section.h"

namespace dynalin {

class TorusCrossings {
 public:
  TorusCrossings(const TorusSolid&, const PlacedSurface&, const std::vector<FacetBody::Index>& near);

  struct Part {
    TorusSection section;
    std::size_t volume = 0;  // to which it belongs, after `join`
  };
  bool consistent() const { return consistent_; }
  bool empty() const { return parts_.empty(); }
  bool has_closed_patch();  // a part of the body that is wholly in the torus
  Vector seam() const;      // a place of it
  // Parts that bound one volume; the seam where no facet cuts it, if that is in the body.
  void join(bool seam_inside);
  std::vector<Part>& parts() { return parts_; }
  // Whether a volume has more than half of the seam.
  bool holds_most_of_seam(std::size_t volume);

 private:
  // On the lines, from one place to the next one.
  struct Step {
    std::size_t part, line;
    double u, next_u, v, du, dv;  // where it begins, and how far it goes
    const SpiricPiece* piece;
    double from, to;  // shares of the chord of the piece
  };
  struct Top {
    double u = 0, v = -1;
    std::size_t part = 0;
  };
  struct Crossing {
    std::size_t part, line;
    double at;
    bool leaves;  // the body, going up or around
  };

  void join_sides();
  void follow(std::size_t part, const TorusSection::Chain&);
  void add_step(const Step&, double next_v, std::size_t& line);
  void look_between(const Step&);  // over a highest place
  void look(std::size_t line, const Top&);
  std::size_t crossing(std::uint64_t key);
  // Up from the seam around the tube.
  std::vector<Crossing> on_meridian(double u) const;
  double share_where(const Step&, bool of_v, double angle) const;
  void join_along_seam();
  // The next crossing of the seam, seen from a place of it: whether that is in the body, and the part there.
  const Crossing* behind(double u) const;

  const TorusSolid& torus_;
  bool consistent_ = true;
  std::vector<Part> parts_;
  std::vector<Step> steps_;
  std::vector<Crossing> on_seam_;  // by angle
  std::unordered_map<std::uint64_t, std::size_t> crossings_;
  JoinedSets lines_;  // of what is drawn on the cylinder
  std::vector<Top> tops_;
  JoinedSets sets_;  // of parts, then the seam
  bool seam_inside_ = false;
};

}  // namespace dynalin
