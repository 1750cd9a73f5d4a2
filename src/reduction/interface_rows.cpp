#include "reduction/interface_rows.h"

#include <fmt/format.h>

#include <array>
#include <map>
#include <set>

namespace dynalin::reduction {

namespace {

using Rows = std::array<Eigen::Index, 7>;  // by direction, -1 for none

std::string missing_directions(const Rows& rows, int first, int last) {
  std::string list;
  for (int d = first; d <= last; ++d) {
    if (rows[static_cast<std::size_t>(d)] < 0) list += (list.empty() ? "" : ", ") + std::to_string(d);
  }
  return list;
}

// The labels below and above one that does not exist, as "the nearest label … is 5".
std::string nearest(const std::map<NodeLabel, Rows>& nodes, NodeLabel label) {
  if (nodes.empty()) return {};
  const auto above = nodes.lower_bound(label);
  constexpr std::string_view one = "the nearest label with freedoms is {}";
  if (above == nodes.begin()) return fmt::format(one, above->first);
  const NodeLabel below = std::prev(above)->first;
  if (above == nodes.end()) return fmt::format(one, below);
  return fmt::format("the nearest labels with freedoms are {} and {}", below, above->first);
}

}  // namespace

std::optional<InterfaceRows> interface_rows(std::span<const Freedom> freedoms, std::span<const NodeLabel> interface,
                                            bool rotations_required, Diagnostics& diagnostics) {
  std::map<NodeLabel, Rows> nodes;
  for (std::size_t k = 0; k < freedoms.size(); ++k) {
    if (freedoms[k].direction == 0) continue;
    const auto [at, is_new] = nodes.try_emplace(freedoms[k].node);
    if (is_new) at->second.fill(-1);
    at->second[static_cast<std::size_t>(freedoms[k].direction)] = static_cast<Eigen::Index>(k);
  }
  InterfaceRows rows;
  std::set<NodeLabel> seen;
  bool good = true;
  const auto refuse = [&](std::string message, std::string hint = {}) {
    diagnostics.error("fe-interface", Span{}, std::move(message), std::move(hint));
    good = false;
  };
  if (interface.empty()) refuse("there is no interface node", "--interface 1,17,20");
  std::vector<bool> taken(freedoms.size());
  for (const NodeLabel label : interface) {
    const auto node = nodes.find(label);
    if (!seen.insert(label).second) {
      refuse(fmt::format("interface node {} is asked for twice", label));
    } else if (node == nodes.end()) {
      refuse(fmt::format("interface node {} has no freedoms", label), nearest(nodes, label));
    } else {
      const std::string translations = missing_directions(node->second, 1, 3);
      const std::string rotations = missing_directions(node->second, 4, 6);
      const bool none = rotations == "4, 5, 6";
      if (!translations.empty())
        refuse(fmt::format("interface node {} has no freedom in direction {}", label, translations),
               "freedoms that are held or eliminated are not in the matrices");
      if (!rotations.empty() && (rotations_required || !none))
        refuse(fmt::format("interface node {} has no rotation {}", label, rotations),
               none ? "nodes of solid elements have none: tie a rigid body with a rotation node to them and write "
                      "node:rotation-node, or do without by --translations-only"
                    : "");
      for (const Eigen::Index row : node->second) {
        if (row < 0) continue;
        rows.interface.push_back(row);
        taken[static_cast<std::size_t>(row)] = true;
      }
    }
  }
  if (!good) return std::nullopt;
  for (std::size_t k = 0; k < freedoms.size(); ++k) {
    if (!taken[k]) rows.interior.push_back(static_cast<Eigen::Index>(k));
  }
  return rows;
}

}  // namespace dynalin::reduction
