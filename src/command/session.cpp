#include "command/session.h"

#include <fmt/ostream.h>

#include "command/live_session.h"
#include "command/output_plan.h"
#include "output/destination.h"
#include "study/study_point.h"

namespace dynalin {

namespace {

// Tables on the terminal would stand between the results that go there.
bool to_standard_output(const std::string& path) {
  const auto destination = path.empty() ? tl::unexpected(std::string()) : find_destination(path);
  return destination && destination->kind == Destination::Kind::standard_output;
}

bool is_quiet(const SessionOptions& options, const Planner& plan) {
  bool quiet = options.quiet || to_standard_output(options.json);
  for (const Job& job : plan.jobs) {
    for (const Command& c : job.commands) {
      const CommandFiles files = c.action->files();
      quiet = quiet || (!files.file.empty() && to_standard_output(command_path(c.folder, files.file)));
    }
  }
  return quiet;
}

}  // namespace

int run_session(const SessionOptions& options, std::ostream& out, std::ostream& err) {
  auto plan = planned(options, err);
  if (!plan) return wrong_input;
  if (plan->only_a_dataset && plan->jobs.front().commands.empty()) {
    fmt::print(err, "error: {} states a model, and no command says what to do with it\n", options.file);
    fmt::print(err, "hint: dynalin run {} -c simulate/statics -c linear/eigensol\n", options.file);
    return wrong_usage;
  }
  Diagnostics unwritable;
  check_permissions(plan->jobs, options, unwritable);
  err << render(unwritable);
  if (unwritable.has_errors()) return wrong_input;
  LiveSession session(options, *plan, is_quiet(options, *plan) ? nullptr : &out, out, err);
  session.advance();
  return session.finish();
}

int check_file(const SessionOptions& options, std::ostream& out, std::ostream& err) {
  const auto plan = planned(options, err);
  if (!plan) return wrong_input;
  // What a run says of each model before its first command.
  for (const Job& job : plan->jobs) {
    if (job.stages.empty()) continue;
    const Diagnostics remarks = remarks_on(*job.stages.front().system);
    for (const Diagnostic& d : remarks.items()) err << render(d);
  }
  fmt::print(out, "{}: no errors\n", options.file == "-" ? "standard input" : options.file);
  return done;
}

}  // namespace dynalin
