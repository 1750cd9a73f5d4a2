#include "dynalin/operating_point.h"

#include <fmt/format.h>

#include <algorithm>

#include "dataset/dataset.h"
#include "library/inside.h"
#include "system/operating_state.h"
#include "system/request_values.h"

namespace dynalin::library {

namespace {

const dynalin::Model& model_of(const OperatingPoint& p) { return p.inside().point.system->model(); }

void must_exist(const dynalin::Model& model, const ElementId& id) {
  if (!model.find(id.statement, id.id) && !model.find_body(id.statement, id.id) &&
      !(id.statement == "MARKER" && model.find_marker(id.id)))
    fail_for_missing(id.text());
}

BodyState body(const OperatingPoint& point, const ElementId& id) {
  const OperatingState state = point.state();
  const auto found = std::ranges::find(state.bodies, id, &BodyState::element);
  if (found == state.bodies.end()) {
    must_exist(model_of(point), id);
    fail(Failure{"results", id.text() + " is the ground, which does not move", {}});
  }
  return *found;
}

// With the full name of the statement, which may be abbreviated as in a dataset.
ElementId in_full(const ElementId& id) {
  const std::string_view name = statement_name(id.statement);
  if (name.empty()) {
    const std::string_view near = nearest_word(id.statement, statement_names());
    fail(Failure{"results",
                 fmt::format("'{}' is no statement of a dataset{}", id.statement,
                             near.empty() ? "" : fmt::format("; did you mean {}?", near)),
                 {}});
  }
  return {std::string(name), id.id};
}

}  // namespace

double OperatingPoint::time() const { return inside_->point.values.time; }
bool OperatingPoint::is_consistent() const { return inside_->point.consistent; }
const std::vector<std::string>& OperatingPoint::redundant_rows() const { return inside_->point.redundant_rows; }
const std::vector<Remark>& OperatingPoint::remarks() const { return inside_->remarks; }

OperatingState OperatingPoint::state() const { return operating_state(*inside_->point.system, inside_->point.values); }

BodyState OperatingPoint::part(std::int64_t id) const { return body(*this, {"PART", id}); }
BodyState OperatingPoint::point_mass(std::int64_t id) const { return body(*this, {"POINT_MASS", id}); }

MarkerState OperatingPoint::marker(std::int64_t id) const {
  const auto marker = model_of(*this).find_marker(id);
  if (!marker) fail_for_missing(fmt::format("MARKER/{}", id));
  if (model_of(*this).marker(*marker).floating)
    fail(Failure{"results", fmt::format("MARKER/{} is floating: nothing fixes it on its body", id), {}});
  return marker_state(*inside_->point.system, inside_->point.values, *marker);
}

double OperatingPoint::variable(std::int64_t id) const {
  const auto value = variable_value(*inside_->point.system, inside_->point.values, id);
  if (!value) fail_for_missing(fmt::format("VARIABLE/{}", id));
  return *value;
}

Load OperatingPoint::load(const ElementId& asked) const {
  const ElementId id = in_full(asked);
  const OperatingState state = this->state();
  for (const auto* loads : {&state.reactions, &state.forces}) {
    const auto found = std::ranges::find(*loads, id, &Load::element);
    if (found != loads->end()) return *found;
  }
  must_exist(model_of(*this), id);
  fail(Failure{"results", id.text() + " exerts no force and torque on a marker", {}});
}

std::vector<RequestValues> OperatingPoint::requests() const {
  return requests_at(*inside_->point.system, inside_->point.values).values;
}

bool OperatingPoint::is_static() const { return inside_->point.statics.has_value(); }

StaticResult OperatingPoint::static_result() const {
  if (!is_static()) fail(Failure{"results", "the point is not that of a static analysis", {}});
  return dynalin::static_result(inside_->point);
}

}  // namespace dynalin::library
