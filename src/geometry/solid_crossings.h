// Which parts of facets that are in a solid bound one volume. Lines in which the facets cut the solid's surface are
// loops on it. Two loops bound the same part of that surface where a way on it leads from one to the other through the
// body; ways are looked for along meridians, sections through a lower and an upper pole on which height only grows: of
// each loop from its highest place upwards to the next loop or the pole.
#pragma once

#include <unordered_map>
#include <vector>

#include "base/joined_sets.h"
#include "geometry/conic_arc.h"
#include "geometry/facet_section.h"

namespace dynalin {

class SolidCrossings {
 public:
  SolidCrossings(const QuadricSolid&, const PlacedSurface&, const std::vector<FacetBody::Index>& near);

  struct Part {
    FacetSection section;
    std::vector<ConicPiece> arcs;        // of all its pieces that are no straight lines, one after the other
    std::vector<std::size_t> first_arc;  // of each piece
    std::size_t volume = 0;              // to which it belongs, after `join`
  };
  bool consistent() const { return consistent_; }
  bool empty() const { return parts_.empty(); }
  bool has_closed_patch();  // a part of the body that is wholly in the solid
  Vector pole(bool upper) const { return upper ? upper_ : lower_; }
  // Parts that bound one volume; those of poles that are in the body.
  void join(bool lower_pole_inside, bool upper_pole_inside);
  std::vector<Part>& parts() { return parts_; }
  std::size_t volume_of_pole(bool upper) { return sets_.of(parts_.size() + (upper ? 1 : 0)); }

 private:
  // A line on the solid from where a side of a facet leaves that to where one enters it, or a closed one.
  struct Chain {
    std::size_t part, loop;
    Vector from, to;
    bool closed = false;
    Vector highest, somewhere;
    double top;
  };
  struct MeridianCrossing {
    std::size_t part, loop;
    Vector at;
    double height;
    bool leaves;  // the body, going up
  };

  void find_arcs(Part&);
  void find_chains(std::size_t part);
  void add_chain(std::size_t part, std::size_t begin, std::size_t end);
  void join_neighbours();
  void join_lower_pole();
  std::size_t crossing(FacetBody::Index triangle, std::size_t side, bool at_end);
  // Of the half of the meridian through a place that it is on, in order of height.
  std::vector<MeridianCrossing> meridian_through(const Vector& place);
  const Chain& nearest_chain(std::size_t part, const Vector& at) const;
  void add_crossings(std::size_t part, const Vector& across, const Vector& half, std::vector<MeridianCrossing>&);
  double height(const Vector& p) const { return dot(up_, p); }

  const QuadricSolid& solid_;
  const PlacedSurface& surface_;
  bool consistent_ = true;
  Vector up_, lower_, upper_;
  std::vector<Part> parts_;
  std::unordered_map<FacetBody::Index, std::size_t> part_of_;
  std::unordered_map<std::uint64_t, std::size_t> crossings_;
  JoinedSets loops_;
  JoinedSets sets_;  // of parts, then both poles
  std::vector<Chain> chains_;
  std::vector<std::vector<std::size_t>> chains_of_;
};

}  // namespace dynalin
