#include "study/linearization.h"

#include <fmt/format.h>

#include "linear/cautions.h"
#include "linear/mode_shapes.h"
#include "linear/second_order.h"
#include "linear/still_modes.h"

namespace dynalin {

namespace {

tl::expected<LinearOptions, Failure> options_of(const Model& model, const LinearRequest& request) {
  LinearOptions options;
  std::string problem;
  const auto find = [&](const std::optional<std::int64_t>& id, std::string_view statement) {
    const auto handle = id ? model.find(statement, *id) : std::nullopt;
    if (id && !handle) problem = fmt::format("{}/{} does not exist", statement, *id);
    return handle;
  };
  options.pstate = find(request.pstate, "PSTATE");
  options.pinput = find(request.pinput, "PINPUT");
  options.poutput = find(request.poutput, "POUTPUT");
  if (request.rm) {
    const auto marker = model.find_marker(*request.rm);
    if (!marker)
      problem = fmt::format("MARKER/{} does not exist", *request.rm);
    else if (model.marker(*marker).floating)
      problem = fmt::format("MARKER/{} is floating", *request.rm);
    else
      options.rm = *marker;
  }
  if (!problem.empty()) return tl::unexpected(Failure{"linear analysis", std::move(problem), {}});
  options.without_damping = request.without_damping;
  options.principal_states = request.original || request.principal_states;
  options.without_rate_coupling = request.original || request.without_rate_coupling;
  return options;
}

// What was asked for, with the result.
template <class Value>
void label(Value& result, const LinearRequest& request) {
  result.rm = request.rm.value_or(0);
  result.pstate = request.pstate.value_or(0);
  result.without_damping = request.without_damping;
  result.original = request.original;
}

}  // namespace

StudyResult<Linearization> linearized(const StudyPoint& at, const LinearRequest& request, Stateless stateless,
                                      Reduction reduction) {
  const auto options = options_of(at.system->model(), request);
  if (!options) return tl::unexpected(StudyFailure(options.error()));
  // Without reconciliation LINEAR takes the static solution as it was found; any other point is consistent anyway.
  const bool as_found = at.statics && (request.original || request.without_reconciliation);
  Linearization result{at.system, as_found ? at.statics->at_rest : at.values, as_found, request, {}};
  auto linear = reduction == Reduction::none ? linearize_unreduced(*at.system, result.point, *options)
                                             : linearize(*at.system, result.point, *options);
  if (!linear) return tl::unexpected(StudyFailure(linear.error()));
  if (stateless == Stateless::refused && linear->model.states.empty()) {
    constexpr auto reason = "the model has no states: neither degrees of freedom nor differential states";
    return tl::unexpected(StudyFailure({"linear analysis", reason, {}}, std::move(linear->warnings)));
  }
  result.linear = std::move(*linear);
  label(result.linear.model, request);
  return result;
}

StudyResult<ModesFound> modes_of(const Linearization& of, Vectors wanted) {
  auto modes = eigensolve(of.linear, wanted);
  if (!modes) return tl::unexpected(StudyFailure(modes.error()));
  if (wanted != Vectors::none) {
    clear_still_modes(*of.system, of.point, of.linear, *modes);
    name_movers(*of.system, of.point, of.linear, *modes);
    map_shapes(*of.system, of.linear, *modes);
  }
  label(*modes, of.request);
  Diagnostics remarks = cautions(*of.system, of.point, of.linear, *modes);
  return ModesFound{std::move(*modes), std::move(remarks)};
}

StudyResult<SecondOrder> second_order_form(const Linearization& of) {
  auto form = second_order(of.linear.model, of.linear.first_order);
  if (!form) return tl::unexpected(StudyFailure(form.error()));
  label(*form, of.request);
  return std::move(*form);
}

}  // namespace dynalin
