// Where the nodes are: matrices do not tell.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "base/diagnostics.h"
#include "reduction/finite_element_model.h"

namespace dynalin::reduction {

// A node whose translations are rotations of a rigid body about another node (ROT NODE of CalculiX).
struct RotationNode {
  NodeLabel reference = 0, rotation = 0;
};

struct NodeList {
  std::map<NodeLabel, Eigen::Vector3d> nodes;
  std::vector<RotationNode> rotation_nodes;  // only an input deck of CalculiX tells
};

// The content decides. Lines `node x y z`, separated by blanks or commas, with comments behind # or %; or an input deck
// of CalculiX or Abaqus, of which *NODE and *RIGID BODY are read, and what moves nodes, *SYSTEM and *INSTANCE, refused;
// or a Nastran deck, of which GRID is (in the basic system alone). A node that is stated twice at two places is an
// error.
std::optional<NodeList> read_nodes(const SourceText&, Diagnostics&);

}  // namespace dynalin::reduction
