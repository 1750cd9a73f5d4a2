#include "command/run_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "command/progress_line.h"
#include "output/message_file.h"
#include "output/operating_state_text.h"
#include "system/operating_state.h"

namespace dynalin {

RunState::RunState(const SessionOptions& of_user, const Job& to_do, std::ostream* to_terminal, std::ostream& errors,
                   JsonResults& all_results, RunFiles& all_files)
    : options(of_user),
      job(to_do),
      point(as_drawn(job.stages.front().system)),
      settings(job.model().settings),
      terminal(to_terminal),
      err(errors),
      json(all_results),
      remarks(errors, message, json, job.prefix + ".msg"),
      steps(job, remarks),
      files(all_files) {
  steps.settings = output_settings(job.model());
}

void RunState::count(const IntegrationStatistics& s) {
  last_simulation = s;
  all_simulations = followed_by(all_simulations, s);
}

void RunState::print(const std::string& text) {
  message << text;
  if (terminal) *terminal << text;
  json.add_printed(command, time(), text);
}

StudyResult<void> RunState::make_consistent(Level last) {
  const auto tell = [this](Level level, bool done) {
    static constexpr std::array<std::string_view, 3> names = {"Displacement", "Velocity", "Acceleration"};
    const std::string title = fmt::format("{} Initial Conditions", names[static_cast<std::size_t>(level)]);
    done ? write_end(message, title) : write_begin(message, title);
  };
  const bool there = point.consistent;
  ProgressLine line(status_line());
  auto found = initial_conditions(point, {tell, line.progress()}, last);
  line.clear();
  if (!found) return tl::unexpected(found.error());
  if (there)
    point = std::move(found->point);
  else
    accept(std::move(*found));
  return {};
}

void RunState::accept(FoundPoint found) {
  if (found.point.redundant_rows != point.redundant_rows)
    write_redundant(message, found.point.values.time, found.point.redundant_rows);
  point = std::move(found.point);
  shown = false;
  remarks.say(found.remarks);
}

void RunState::show(StepKind kind, const OperatingState& state, const OperatingPoint& values) {
  write_operating_state(message, state, units());
  steps.begin(kind);
  const PointRequests requests = requests_at(system(), values);
  steps.add(system().model(), state, requests);
  steps.end();
  say_undefined_requests(system(), values, requests);
  if (terminal && options.state) write_operating_state(*terminal, state, units());
  if (terminal && !options.state && kind == StepKind::statics)
    write_operating_state(*terminal, state, units(), short_tables);
  shown = true;
}

void RunState::show_where_it_ended() {
  const OperatingState state = operating_state(system(), point.statics ? point.statics->at_rest : point.values);
  write_operating_state(message, state, units());
  if (terminal && options.state) write_operating_state(*terminal, state, units());
  json.add_point(state);
  shown = true;
}

void RunState::say_undefined_requests(const System& of, const OperatingPoint& at, const PointRequests& requests) {
  const auto undefined = [&](const RequestValues& r) {
    return !undefined_requests_.contains(r.request) &&
           !std::all_of(r.values.begin(), r.values.end(), [](double v) { return std::isfinite(v); });
  };
  if (std::none_of(requests.values.begin(), requests.values.end(), undefined)) return;
  for (const UndefinedRequest& u : undefined_requests(of, at)) {
    if (undefined_requests_.insert(u.request).second) remarks.say("undefined-request", u.reason);
  }
}

}  // namespace dynalin
