// The wrenches that elements report, by the label of the element.
#pragma once

#include <map>
#include <unordered_map>
#include <vector>

#include "mechanics/wrench_source.h"
#include "system/system.h"

namespace dynalin::nastran {

struct ReportedWrench {
  const WrenchSource* source = nullptr;
  std::size_t which = 0;
};

// Of elements that exert exactly one wrench, by statement and id.
class SingleWrenches {
 public:
  explicit SingleWrenches(const System&);
  const ReportedWrench* of(const ElementLabel&) const;

 private:
  std::map<std::string_view, std::unordered_map<std::int64_t, std::vector<ReportedWrench>>> by_id_;
};

}  // namespace dynalin::nastran
