#include "structural_zeros/element_partials.h"

#include <algorithm>
#include <cmath>

namespace dynalin {

ElementPartials::ElementPartials(const System& system, const ElementTrace& trace, bool without_damping)
    : n_(system.layout().coordinate_count), w_(static_cast<std::int32_t>(system.layout().algebraic.size())) {
  std::map<std::int32_t, std::size_t> of_row;  // constraint row -> element
  auto law = trace.laws.begin();
  for (std::size_t e = 0; e < trace.elements.size(); ++e) {
    const ElementTrace::Element& noted = trace.elements[e];
    ElementContribution* element = nullptr;
    const auto known = noted.row_count > 0 ? of_row.find(noted.first_row) : of_row.end();
    if (known != of_row.end()) {
      element = &elements_[known->second];
    } else {
      for (std::int32_t r = 0; r < noted.row_count; ++r) of_row[noted.first_row + r] = elements_.size();
      element = &elements_.emplace_back();
      for (std::int32_t r = 0; r < noted.row_count; ++r) element->reactions.push_back(noted.first_row + r);
    }
    for (std::size_t k = noted.first_partial; k < trace.end_of_partials(e); ++k) {
      const ElementTrace::Partial& p = trace.partials[k];
      if (without_damping && p.family == PartialBy::damping) continue;
      if (!std::isfinite(p.value)) continue;  // of functions without a derivative: nothing comes of them
      if (p.row < n_) {
        element->partials.push_back({p.family, p.row, p.column, p.value});
      } else {
        read(p, trace);
      }
    }
    for (std::size_t k = noted.first_load; k < trace.end_of_loads(e); ++k) {
      auto& [load, size] = element->load[trace.loads[k].row];
      load += trace.loads[k].value;
      size += trace.loads[k].size;
    }
    for (; law != trace.laws.end() && law->element == e; ++law) {
      std::erase_if(element->laws.emplace_back(*law).partials, [&](const ElementTrace::Law::Partial& p) {
        return (without_damping && p.family == PartialBy::damping) ||
               !std::ranges::all_of(p.value, [](double v) { return std::isfinite(v); });
      });
    }
  }
}

void ElementPartials::read(const ElementTrace::Partial& p, const ElementTrace& trace) {
  const std::int32_t unknown = p.row - n_;
  if (p.family == PartialBy::algebraic && p.column == unknown) return;  // what the equation defines
  if (p.family == PartialBy::state_rate && p.column == unknown - w_) return;
  std::vector<Reading>& readings = readings_[p.row];
  const ElementPartial entry{p.family, p.row, p.column, p.value};
  const bool part_of_term = p.family <= PartialBy::acceleration && p.term >= 0;
  if (part_of_term && !readings.empty() && last_term_ == p.term) {
    readings.back().partials.push_back(entry);
  } else {
    readings.push_back({{entry}, part_of_term ? trace.coefficients[static_cast<std::size_t>(p.term)] : p.value});
  }
  last_term_ = part_of_term ? p.term : -1;
}

const std::vector<Reading>* ElementPartials::readings(std::int32_t equation) const {
  const auto found = readings_.find(equation);
  return found == readings_.end() ? nullptr : &found->second;
}

double ElementPartials::size_of(const Directions& d, const ElementPartial& p) const {
  // A quantity that is itself defined by an equation is as exact as what it is made of.
  if (p.family == PartialBy::algebraic) return size_of_algebraic(d, p.column, 0);
  if (p.family == PartialBy::lambda) return d.change[Directions::at(p.family)].row(p.column).cwiseAbs().maxCoeff();
  return d.unit(p.family, p.column) * d.size[Directions::at(p.family)];
}

double ElementPartials::size_of_algebraic(const Directions& d, std::int32_t unknown, int depth) const {
  double size = d.change[Directions::at(PartialBy::algebraic)].row(unknown).cwiseAbs().maxCoeff();
  const std::vector<Reading>* found = readings(n_ + unknown);
  if (!found || depth > 8) return size;
  for (const Reading& reading : *found) {
    for (const ElementPartial& p : reading.partials) {
      size = std::max(
          size, std::abs(p.value) *
                    (p.family == PartialBy::algebraic ? size_of_algebraic(d, p.column, depth + 1) : size_of(d, p)));
    }
  }
  return size;
}

}  // namespace dynalin
