// Zero times an infinite slope: x SQRT(y) has a derivative where both are zero, SQRT(x) SQRT(x) has another one than
// the chain rule says. What decides is how fast the parts vanish.
//
// Of each node this finds an order h with |f − f0| = O(d^h), d the distance of the atoms from the point, and whether
// f − f0 is linear in the atoms but for o(d), with the factors of the chain rule. Parts of products and of functions
// with a zero slope leave remainders of higher order, which must be above 1.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "expression/program_partials.h"

namespace dynalin {

namespace {

using Kind = ExpressionNode::Kind;

constexpr double infinite_order = std::numeric_limits<double>::infinity();

// The order in which a function grows at a point where its slope is infinite, of one of its argument; 0 if unknown.
double order_of_function(const ExpressionProgram& program, const ExpressionNode& node) {
  if (node.kind == Kind::power) return std::max(program.constant_of(node), 0.0);
  return node.kind == Kind::call ? program.function_of(node).growth_at_infinity : 0;
}

}  // namespace

// Asked only where a slope is infinite, which hardly any model has.
template <class T>
bool ExpressionProgram::is_differentiable(ExpressionWorkspace<T>& workspace) const {
  const std::vector<T>& value = workspace.value;
  std::vector<double>& order = workspace.order;
  std::vector<char>& smooth = workspace.smooth;
  if (order.size() < nodes().size()) order.resize(nodes().size()), smooth.resize(nodes().size());
  for (std::size_t i = 0; i < nodes().size(); ++i) {
    const ExpressionNode& node = nodes()[i];
    order[i] = node.kind == Kind::constant ? infinite_order : 1, smooth[i] = true;
    if (node.kind == Kind::constant || node.kind == Kind::atom || node.kind == Kind::branch ||
        node.kind == Kind::jump) {
      continue;
    }
    // Linear part: those operands with a slope. Remainder: products of two growths, of all that the node depends on.
    order[i] = infinite_order;
    double slowest = infinite_order;
    bool infinite = false;
    visit_partials(*this, node, value, [&](std::size_t operand, const auto& partial) {
      const double slope = value_of(partial);
      slowest = std::min(slowest, order[operand]);
      if (!std::isfinite(slope)) infinite = true;
      if (slope == 0.0) return;
      order[i] = std::min(order[i], order[operand]);
      smooth[i] = smooth[i] && smooth[operand];
    });
    if (infinite) {
      order[i] = order_of_function(*this, node) * slowest;
      smooth[i] = order[i] > 1;
      continue;
    }
    double remainder = 2 * slowest;
    if (node.kind == Kind::add || node.kind == Kind::subtract || node.kind == Kind::negate || node.kind == Kind::merge)
      remainder = infinite_order;
    if (node.kind == Kind::multiply || node.kind == Kind::divide) {
      const auto a = static_cast<std::size_t>(node.a), b = static_cast<std::size_t>(node.b);
      remainder = order[a] + order[b];
      if (node.kind == Kind::divide) remainder = std::min(remainder, 2 * order[b]);
    }
    // A power of what is zero has that order and no other.
    const double exponent = node.kind == Kind::power ? constant_of(node) : 0;
    if (exponent > 0 && value_of(value[static_cast<std::size_t>(node.a)]) == 0.0) {
      remainder = exponent == 1.0 ? infinite_order : exponent * slowest;
    }
    if (node.kind == Kind::call || node.kind == Kind::spline) {
      // Of what functions do beyond their slope no more is known than that they are continuous and smooth but for
      // kinks, where the slope is zero by convention.
      const bool kink = node.kind == Kind::call && function_of(node).flat_at_kinks;
      order[i] = std::min(order[i], slowest);
      smooth[i] = smooth[i] && (kink ? slowest >= 1 : remainder > 1);
      continue;
    }
    order[i] = std::min(order[i], remainder);
    smooth[i] = smooth[i] && remainder > 1;
  }
  return smooth[nodes().size() - 1];
}

std::optional<Span> ExpressionProgram::size_of_nothing(ExpressionWorkspace<double>& workspace) const {
  bool ordered = false;
  for (std::size_t i = 0; i < nodes().size(); ++i) {
    const ExpressionNode& node = nodes()[i];
    if (!is_size(node)) continue;
    if (!workspace.reached[i] || workspace.value[i] != 0.0 || workspace.adjoint[i] == 0.0) continue;
    if (!ordered) is_differentiable(workspace), ordered = true;
    const auto vector = operands().subspan(static_cast<std::size_t>(node.b), static_cast<std::size_t>(node.a));
    // A vector that leaves zero faster than the model moves has a size without a kink.
    const auto grows = [&](std::int32_t k) { return workspace.order[static_cast<std::size_t>(k)] <= 1; };
    if (std::any_of(vector.begin(), vector.end(), grows)) return place(i);
  }
  return std::nullopt;
}

template bool ExpressionProgram::is_differentiable(ExpressionWorkspace<double>&) const;
template bool ExpressionProgram::is_differentiable(ExpressionWorkspace<Taylor>&) const;

}  // namespace dynalin
