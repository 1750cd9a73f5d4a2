// Where the points of a deck are, along which axes their components lie, and how their freedoms are numbered.
#pragma once

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "nastran_reader/deck.h"

namespace dynalin::nastran_reader {

struct Axes {
  System::Kind kind = System::Kind::rectangular;
  Vector3d origin = Vector3d::Zero();                  // in the basic system
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // columns, in the basic system
  Vector3d to_basic(const Vector3d& coordinates) const;
  // The three directions of the system at a point of the basic system: of a rectangular one the same everywhere.
  Eigen::Matrix3d at(const Vector3d& place) const;
};

struct Point {
  int id = 0;
  bool scalar = false;
  int first = 0;  // freedom; a grid has six, a scalar point one
  Vector3d position = Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // of CD, columns in the basic system
  Components fixed = 0;
  Span at;
};

class Points {
 public:
  // Coordinate systems that are missing, degenerate or define each other in a circle, and numbers that stand twice are
  // errors.
  Points(const Deck&, Diagnostics&);

  const std::vector<Point>& all() const { return points_; }
  const Point* find(int id) const;
  const Axes* system(int id) const;  // 0: the basic one
  int freedoms() const { return freedoms_; }
  // The freedom of a component of a point; a scalar point has component 0 or 1. Nothing where there is none.
  std::optional<int> freedom(const Freedom&) const;
  // "GRID 12 component 3", "SPOINT 4"
  std::string name(int freedom) const;
  const Point& point_of(int freedom) const;

 private:
  std::vector<Point> points_;
  std::unordered_map<int, std::size_t> by_id_;
  std::unordered_map<int, Axes> systems_;
  int freedoms_ = 0;
};

// The matrix of v x.
Eigen::Matrix3d cross_matrix(const Vector3d& v);

}  // namespace dynalin::nastran_reader
