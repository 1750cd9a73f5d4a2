#include "eigenvalues/triangular_form.h"

#include <algorithm>

namespace dynalin {

using Index = Eigen::Index;

std::vector<std::vector<Index>> connected_components(const Eigen::Ref<const Eigen::MatrixXd>& m) {
  const Index n = m.rows();
  constexpr Index none = -1;
  std::vector<Index> number(static_cast<std::size_t>(n), none), low = number, next_row(number.size(), 0), stack;
  std::vector<bool> on_stack(number.size(), false);
  std::vector<std::vector<Index>> components;
  Index count = 0;
  const auto at = [](Index k) { return static_cast<std::size_t>(k); };
  std::vector<Index> path;  // without recursion: chains may be as long as the model
  const auto enter = [&](Index v) {
    number[at(v)] = low[at(v)] = count++;
    stack.push_back(v);
    on_stack[at(v)] = true;
    path.push_back(v);
  };
  for (Index root = 0; root < n; ++root) {
    if (number[at(root)] != none) continue;
    enter(root);
    while (!path.empty()) {
      const Index v = path.back();
      Index& row = next_row[at(v)];
      while (row < n && (row == v || m(row, v) == 0.0 || (number[at(row)] != none && !on_stack[at(row)]))) ++row;
      if (row < n) {
        const Index w = row++;
        if (number[at(w)] == none) {
          enter(w);
        } else {
          low[at(v)] = std::min(low[at(v)], number[at(w)]);
        }
        continue;
      }
      path.pop_back();
      if (!path.empty()) low[at(path.back())] = std::min(low[at(path.back())], low[at(v)]);
      if (low[at(v)] != number[at(v)]) continue;
      auto& component = components.emplace_back();
      while (true) {
        const Index w = stack.back();
        stack.pop_back();
        on_stack[at(w)] = false;
        component.push_back(w);
        if (w == v) break;
      }
    }
  }
  return components;
}

std::vector<Index> reached_from(const Eigen::Ref<const Eigen::MatrixXd>& m, Index from) {
  std::vector<bool> seen(static_cast<std::size_t>(m.rows()), false);
  std::vector<Index> found, open{from};
  while (!open.empty()) {
    const Index v = open.back();
    open.pop_back();
    for (Index row = 0; row < m.rows(); ++row) {
      if (m(row, v) == 0.0 || seen[static_cast<std::size_t>(row)]) continue;
      seen[static_cast<std::size_t>(row)] = true;
      found.push_back(row);
      open.push_back(row);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace dynalin
