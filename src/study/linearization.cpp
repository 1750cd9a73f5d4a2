#include "study/linearization.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/initial.h"
#include "cautions/cautions.h"
#include "cautions/motion_caution.h"
#include "linear/second_order.h"
#include "modal/mode_shapes.h"
#include "modal/still_modes.h"
#include "model/linear_remarks.h"
#include "routine/routine_findings.h"
#include "selected_modes/selected_modes.h"
#include "selected_modes/selection_of_modes.h"

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

Failure no_states(const System& system) {
  std::string reason = "the model has no states: neither degrees of freedom nor differential states";
  const std::vector<ConstraintRow>& rows = system.layout().rows;
  if (const auto driven = std::ranges::find(rows, true, &ConstraintRow::prescribed); driven != rows.end())
    reason += fmt::format("; {0} prescribes its motion, and DEACTIVATE/MOTION, ID={1} would leave it free",
                          driven->owner->full_text(), driven->owner->id);
  return {"linear analysis", std::move(reason), {}};
}

StudyResult<Linearization> linearized(const StudyPoint& at, const LinearRequest& request, Stateless stateless,
                                      Reduction reduction) {
  const auto options = options_of(at.system->model(), request);
  if (!options) return tl::unexpected(StudyFailure(options.error()));
  // Without reconciliation LINEAR takes the static solution as it was found; any other point is consistent anyway.
  const bool as_found = at.statics && (request.original || request.without_reconciliation);
  Linearization result{at.system, as_found ? at.statics->at_rest : at.values, as_found, request, {}};
  Findings of_analysis;
  if (at.system->layout().reads_analysis) {
    // MODE is 7 from here on, in values and reactions as well as in their derivatives.
    result.point.mode = AnalysisMode::linear;
    auto solved = solve_acceleration(*at.system, std::move(result.point), of_analysis);
    if (!solved) return tl::unexpected(StudyFailure(solved.error(), std::move(of_analysis.warnings)));
    result.point = std::move(*solved);
  }
  RoutineFindings routines;
  routines.of_linear_model = true;
  const RoutineFindings::Scope watch(routines);
  auto linear = reduction.has_linear_model ? linearize(*at.system, result.point, *options, reduction.up_to)
                                           : linearize_unreduced(*at.system, result.point, *options);
  if (!linear) return tl::unexpected(StudyFailure(linear.error()));
  if (stateless == Stateless::refused && linear->model.states.empty())
    return tl::unexpected(StudyFailure(no_states(*at.system), std::move(linear->warnings)));
  result.linear = std::move(*linear);
  result.linear.warnings.append(std::move(of_analysis.warnings));
  result.differenced = routines.differenced;
  for (const std::string& kink : routines.kinks)
    result.linear.warnings.warning("kink-of-routine", {}, kink + ": the linear model has the mean of both");
  for (const std::string& wrong : routines.wrong_partials)
    result.linear.warnings.warning("wrong-derivative", {}, wrong);
  label(result.linear.model, request);
  const Motion motion = at.system->motion(result.point);
  for (const auto& set : at.system->model().sets) {
    const auto* source = set->active ? dynamic_cast<const LinearRemarks*>(set.get()) : nullptr;
    if (source) source->remark_at(at.system->model(), motion, at.system->length(), result.linear.warnings);
  }
  return result;
}

namespace {

// How far differences are off nobody knows. Zeros by structure are zeros whatever slopes there are.
void forget_bounds(EigenSolution& modes) {
  for (EigenMode& m : modes.modes) {
    if (!m.structural_zero) m.error_bound_hz = std::numeric_limits<double>::infinity();
  }
}

// What an integration that has led to the point has left of its errors, as a part of the model's length.
double left_by_integration(const Linearization& of) {
  const AnalysisMode mode = of.point.mode;
  return mode == AnalysisMode::dynamics || mode == AnalysisMode::linear ? of.point.progress.left_over : 0.0;
}

void add_reference_caution(const Linearization& of, const EigenSolution* modes, Diagnostics& remarks) {
  const auto marker = of.request.rm ? of.system->model().find_marker(*of.request.rm) : std::nullopt;
  if (marker) reference_caution(*of.system, of.point, modes, *marker, left_by_integration(of), remarks);
}

// Named, labelled and commented, whichever way they were found.
StudyResult<ModesFound> presented(const Linearization& of, Result<EigenSolution> modes, Vectors wanted,
                                  const Progress& progress) {
  if (!modes) return tl::unexpected(StudyFailure(modes.error()));
  progress.tell("shapes of modes, and what to beware of");
  if (wanted != Vectors::none) {
    clear_still_modes(*of.system, of.point, of.linear, *modes);
    name_movers(*of.system, of.point, of.linear, *modes);
    map_shapes(*of.system, of.linear, *modes);
  }
  label(*modes, of.request);
  Diagnostics remarks = cautions(*of.system, of.point, of.linear, *modes, left_by_integration(of));
  add_reference_caution(of, &*modes, remarks);
  if (of.differenced) forget_bounds(*modes);
  return ModesFound{std::move(*modes), std::move(remarks)};
}

Result<EigenSolution> selected_of_all(const Linearization& of, Vectors wanted, const ModeSelection& selection,
                                      const Progress& progress) {
  auto all = eigensolve(of.linear, wanted, progress);
  if (!all) return all;
  return selected_of(*all, selection);
}

// What was asked for and is not there.
Diagnostics shortcomings(const EigenSolution& modes) {
  Diagnostics remarks;
  const SelectedModes& s = *modes.selected;
  const auto there = static_cast<std::size_t>(std::ranges::count(modes.modes, false, &EigenMode::structural_zero));
  const auto* nearest = std::get_if<NearestModes>(&s.wanted);
  if (nearest && s.complete && there < nearest->count) {
    remarks.warning("missing-mode", {},
                    fmt::format("{} modes are asked for, the model has {} besides {} that are zero by structure",
                                nearest->count, there, modes.modes.size() - there));
  }
  if (!s.complete) {
    remarks.warning(
        "incomplete-modes", {},
        s.by == CountedBy::nothing
            ? fmt::format("{} eigenvalues were found where modes are asked for, and whether these are all "
                          "of them is not known",
                          s.found)
        : s.doubt.empty()
            ? fmt::format("{} eigenvalues were found where modes are asked for, and {} are there", s.found, s.counted)
            : fmt::format("{} eigenvalues were found where modes are asked for, and counted there, but {}", s.found,
                          s.doubt));
  }
  return remarks;
}

}  // namespace

StudyResult<ModesFound> modes_of(const Linearization& of, Vectors wanted, const Progress& progress) {
  return presented(of, eigensolve(of.linear, wanted, progress), wanted, progress);
}

StudyResult<ModesFound> modes_of(const Linearization& of, Vectors wanted, const ModeSelection& selection,
                                 const Progress& progress) {
  auto found =
      presented(of,
                of.has_state_matrix() ? selected_of_all(of, wanted, selection, progress)
                                      : eigensolve_selected(*of.system, of.linear, selection, wanted, progress),
                wanted, progress);
  if (found) found->remarks.append(shortcomings(found->solution));
  return found;
}

Diagnostics remarks_of_matrices(const Linearization& of) {
  Diagnostics remarks = cautions_of_matrices(*of.system, of.point, of.linear, left_by_integration(of));
  add_reference_caution(of, nullptr, remarks);
  return remarks;
}

StudyResult<Linearization> with_state_matrix(Linearization of) {
  if (of.has_state_matrix()) return of;
  const auto options = options_of(of.system->model(), of.request);
  if (!options) return tl::unexpected(StudyFailure(options.error()));
  auto linear = linearize(*of.system, of.point, *options);
  if (!linear) return tl::unexpected(StudyFailure(linear.error()));
  of.linear = std::move(*linear);
  label(of.linear.model, of.request);
  return of;
}

namespace {

std::string duration(double seconds) {
  if (seconds < 120) return fmt::format("{:.0f} s", seconds);
  return seconds < 7200 ? fmt::format("{:.0f} min", seconds / 60) : fmt::format("{:.0f} h", seconds / 3600);
}
std::string memory(double bytes) {
  if (bytes < 1e3) return fmt::format("{:.0f} bytes", bytes);
  if (bytes < 1e5) return fmt::format("{:.1f} kB", bytes / 1e3);
  if (bytes < 1e8) return fmt::format("{:.1f} MB", bytes / 1e6);
  return bytes < 10e9 ? fmt::format("{:.1f} GB", bytes / 1e9) : fmt::format("{:.0f} GB", bytes / 1e9);
}

}  // namespace

Diagnostics cost_of_all_modes(std::size_t states) {
  // docs/performance.md: 28 s for 2400 states, 4.2 GB for 4000.
  constexpr double seconds_of_cube = 2e-9, bytes_of_square = 260;
  Diagnostics remarks;
  if (states <= all_modes_unannounced_up_to) return remarks;
  const auto n = static_cast<double>(states);
  remarks.warning(
      "large-eigensolution", {},
      fmt::format("all eigenvalues of {} states take about {} and {}", states, duration(seconds_of_cube * n * n * n),
                  memory(bytes_of_square * n * n)),
      "LINEAR/EIGENSOL, NMODES=20 finds the 20 lowest modes alone, BAND=f1,f2 those between two frequencies");
  return remarks;
}

StudyResult<void> check_size_of_matrices(std::size_t states, const LinearRequest& request) {
  const std::size_t most = request.dense_up_to.value_or(state_matrices_up_to);
  if (states <= most) return {};
  const auto n = static_cast<double>(states);
  return tl::unexpected(StudyFailure(
      {"linear analysis",
       fmt::format(
           "the state matrix of {} states has {} and is formed up to {} states only; the sparse equations "
           "(LINEAR/STATEMAT, DESCRIPTOR; descriptor_form) do without it, --dense-up-to {} (dense_up_to) forms it",
           states, memory(8 * n * n), most, states),
       {}}));
}

StudyResult<SecondOrder> second_order_form(const Linearization& of) {
  auto form = second_order(of.linear.model, of.linear.first_order);
  if (!form) return tl::unexpected(StudyFailure(form.error()));
  label(*form, of.request);
  return std::move(*form);
}

}  // namespace dynalin
