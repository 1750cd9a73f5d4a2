#include "output/simulation_message.h"

#include <fmt/ostream.h>

#include <algorithm>
#include <cmath>

#include "output/message_file.h"

namespace dynalin {

namespace {

std::string_view name_of(StepKind kind) {
  switch (kind) {
    case StepKind::quasi_statics:
      return "Quasi-Static";
    case StepKind::kinematics:
      return "Kinematic";
    default:
      return "Dynamic";
  }
}

}  // namespace

std::string seconds_text(double seconds) {
  if (seconds < 60) return fmt::format("{:.2f}", seconds);
  const auto whole = static_cast<std::int64_t>(seconds + 0.5);
  if (whole < 3600) return fmt::format("{}:{:02d}", whole / 60, whole % 60);
  return fmt::format("{}:{:02d}:{:02d}", whole / 3600, whole / 60 % 60, whole % 60);
}

SimulationMessage::SimulationMessage(std::ostream& out, const SimulationHead& head)
    : out_(out), kind_(head.kind), start_(head.start), end_(head.end), begun_(std::clock()) {
  write_begin(out_, "Simulation");
  const std::string_view name = name_of(kind_);
  if (kind_ == StepKind::dynamics) {
    fmt::print(out_, "  ****** Performing {} Simulation using IDA SI2 Integrator ******\n", name);
    fmt::print(out_, "   The system is modelled with stabilized INDEX-2 DAEs.\n");
    std::string stated;
    for (const auto& word : {head.integrator, head.formulation}) {
      if (word) stated += (stated.empty() ? "" : " ") + *word;
    }
    fmt::print(out_, "   The integrator is IDA of SUNDIALS{}\n",
               stated.empty() ? "" : fmt::format(", which stands in for {}", stated));
    if (head.error) fmt::print(out_, "   Integration error = {:15.6E}\n", *head.error);
  } else {
    fmt::print(out_, "  ****** Performing {} Simulation ******\n", name);
  }
  fmt::print(out_,
             "\n   Simulation      Step        Function    Cumulative   Integration     CPU\n"
             "      Time         Size       Evaluations  Steps Taken    Order        time\n"
             "   ___________  ___________   ___________  ___________   _________    ________\n");
}

void SimulationMessage::row() {
  const double cpu = static_cast<double>(std::clock() - begun_) / CLOCKS_PER_SEC;
  const IntegrationStatistics& s = statistics_;
  fmt::print(out_, "   {:11.5E}  {:11.5E}{:13d}{:13d}{:8d}{:>16}\n", time_, s.step_size, s.evaluations, s.steps,
             s.order, seconds_text(cpu));
  fresh_ = false;
}

void SimulationMessage::add(double time, const IntegrationStatistics& statistics) {
  time_ = time, statistics_ = statistics, fresh_ = true;
  const double part = end_ > start_ ? (time - start_) / (end_ - start_) : 0;
  const int tenths = static_cast<int>(std::floor(10 * std::clamp(part, 0.0, 1.0) + 1e-9));
  if (tenths <= tenths_) return;
  tenths_ = tenths;
  row();
}

void SimulationMessage::end() {
  if (fresh_) row();
  write_end(out_, "Simulation");
}

}  // namespace dynalin
