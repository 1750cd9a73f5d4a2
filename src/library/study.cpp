#include "dynalin/study.h"

#include <fmt/format.h>

#include "analysis/static_settings.h"
#include "library/inside.h"
#include "library/request_checks.h"
#include "linear/physical_matrices.h"
#include "study/measured.h"
#include "study/modal_tables.h"

namespace dynalin::library {

namespace {

OperatingPoint handed_out(FoundPoint found, std::vector<Remark> remarks = {}) {
  append(remarks, remarks_of(found.remarks));
  return OperatingPoint(std::make_shared<const OperatingPoint::Inside>(
      OperatingPoint::Inside{std::move(found.point), std::move(remarks)}));
}

StaticsOptions options_of(EquilibriumSettings settings, const StaticRequest& request) {
  take_over(settings, {.error = request.error,
                       .imbalance = request.imbalance,
                       .stability = request.stability,
                       .translation_limit = request.translation_limit,
                       .rotation_limit = request.rotation_limit,
                       .iteration_limit = request.iteration_limit,
                       .pattern = request.pattern,
                       .newton = request.newton,
                       .by_motion = request.by_motion,
                       .global_damping = request.global_damping,
                       .acceleration_error = request.acceleration_error,
                       .kinetic_energy_error = request.kinetic_energy_error,
                       .settling_time = request.settling_time});
  StaticsOptions options = statics_options(settings);
  options.restore_velocities = request.restore_velocities;
  options.progress = request.progress;
  return options;
}

PhysicalEquations equations_of(const LinearModel::Inside& inside) {
  auto equations = PhysicalEquations::make(*inside.linear.system, inside.linear.linear);
  if (!equations) fail(equations.error());
  return std::move(*equations);
}

// A model whose matrices are D alone has no modes.
void check_for_states(const Linearization& linear) {
  if (linear.states() == 0) fail(no_states(*linear.system));
}

Vectors vectors_for(ModeShapes shapes) { return shapes == ModeShapes::wanted ? Vectors::right : Vectors::none; }

}  // namespace

void fail(const StudyFailure& f, std::vector<Remark> said) {
  std::string text = f.analysis + ": " + f.message;
  for (const std::string& d : f.details) text += "\n  " + d;
  Remark why;
  why.severity = Remark::Severity::error;
  why.message = f.message, why.code = f.code;
  Error error(text, f.problems.empty() ? std::vector{std::move(why)} : f.problems);
  error.analysis = f.analysis;
  error.details = f.details;
  error.remarks = std::move(said);
  append(error.remarks, remarks_of(f.remarks));
  throw error;
}

void fail_for_missing(const std::string& what) { fail(Failure{"results", fmt::format("{} does not exist", what), {}}); }

const StudyPoint& point_of(const Model& model, const OperatingPoint& point) {
  if (point.inside().point.system != model.inside().system)
    fail(Failure{"study",
                 "the point belongs to another model; Study::continued takes it over into this one, where this one was "
                 "made of that",
                 {}});
  return point.inside().point;
}

OperatingPoint Study::as_drawn() const { return handed_out({dynalin::as_drawn(model_.inside().system), {}}); }

OperatingPoint Study::continued(const OperatingPoint& before) const {
  const Model::Inside& now = model_.inside();
  const StudyPoint& point = before.inside().point;
  if (point.system == now.system) return before;
  return handed_out({dynalin::continued(point, now.system, now.edits.restated_since(point.system)), {}});
}

OperatingPoint Study::initial_conditions(const OperatingPoint& from, const InitialConditionRequest& request) const {
  check(request);
  StudyPoint start = point_of(model_, from);
  if (request.error) start.values.redundancy_tolerance = *request.error;
  return handed_out(value_or_throw(dynalin::initial_conditions(std::move(start))));
}

OperatingPoint Study::static_equilibrium(const OperatingPoint& from, const StaticRequest& request) const {
  check(request);
  const EquilibriumSettings& stated = model_.inside().system->model().settings.equilibrium;
  return handed_out(value_or_throw(dynalin::static_equilibrium(point_of(model_, from), options_of(stated, request))));
}

std::vector<double> Study::measured(const OperatingPoint& point, const std::vector<std::string>& functions) const {
  const Model::Inside& model = model_.inside();
  return value_or_throw(
      dynalin::measured(point_of(model_, point), model.statements(), functions, model_options(model.options)));
}

LinearModel Study::linearize(const OperatingPoint& from, const LinearRequest& request) const {
  const bool ready = point_of(model_, from).consistent;
  const OperatingPoint point = ready ? from : initial_conditions(from);
  std::vector<Remark> remarks = ready ? std::vector<Remark>{} : point.remarks();
  const Reduction reduction{request.dense_up_to.value_or(selected_from_all_up_to)};
  Linearization linear =
      value_or_throw(linearized(point.inside().point, request, stateless_matrices(request), reduction), remarks);
  append(remarks, remarks_of(linear.remarks()));
  OperatingPoint about = point;
  if (linear.at_rest_as_found) {
    OperatingPoint::Inside at_rest = point.inside();
    at_rest.point.values = linear.point;
    about = OperatingPoint(std::make_shared<const OperatingPoint::Inside>(std::move(at_rest)));
  }
  return LinearModel(
      std::make_shared<const LinearModel::Inside>(std::move(linear), std::move(about), std::move(remarks)));
}

StateSpace LinearModel::state_space() const { return inside_->whole_of_matrices().linear.model; }
SecondOrder LinearModel::second_order() const {
  return value_or_throw(second_order_form(inside_->whole_of_matrices()), inside_->remarks);
}

PhysicalMatrices LinearModel::physical_matrices() const { return equations_of(*inside_).whole(); }

std::vector<ElementMatrices> LinearModel::element_matrices() const {
  const PhysicalEquations equations = equations_of(*inside_);
  std::vector<ElementMatrices> list;
  for (const ElementLabel* label : equations.elements()) list.push_back({label->element(), equations.of(*label)});
  return list;
}

Modes LinearModel::modes(ModeShapes shapes) const {
  check_for_states(inside_->linear);
  std::vector<Remark> remarks = remarks_of(cost_of_all_modes(inside_->linear.states()));
  const Linearization& whole = inside_->whole();
  append(remarks, inside_->remarks_of_whole());
  ModesFound found = value_or_throw(modes_of(whole, vectors_for(shapes)), remarks);
  append(remarks, remarks_of(found.remarks));
  return {std::move(found.solution), std::move(remarks)};
}

Modes LinearModel::modes(const ModeSelection& selection, ModeShapes shapes) const {
  check_for_states(inside_->linear);
  check(selection);
  ModesFound found = value_or_throw(modes_of(inside_->linear, vectors_for(shapes), selection));
  return {std::move(found.solution), remarks_of(found.remarks)};
}

ModalTables LinearModel::tables(const EigenSolution& modes, const ModalTableRequest& request) const {
  check(modes, *inside_);
  TablesFound found = value_or_throw(modal_tables(inside_->linear, modes, request), inside_->remarks);
  return {modes.of_equations, std::move(found.tables), remarks_of(found.remarks)};
}

const LinearRequest& LinearModel::request() const { return inside_->linear.request; }
const OperatingPoint& LinearModel::operating_point() const { return inside_->about; }
const std::vector<Remark>& LinearModel::remarks() const { return inside_->remarks; }

}  // namespace dynalin::library
