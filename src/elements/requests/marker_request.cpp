#include "elements/requests/marker_request.h"

#include "expression/measures.h"
#include "mechanics/wrench_source.h"

namespace dynalin {

namespace {

constexpr std::array displacements = {Measure::DM,  Measure::DX,    Measure::DY, Measure::DZ,
                                      Measure::PSI, Measure::THETA, Measure::PHI};
constexpr std::array velocities = {Measure::VM, Measure::VX, Measure::VY, Measure::VZ,
                                   Measure::WM, Measure::WX, Measure::WY, Measure::WZ};
constexpr std::array accelerations = {Measure::ACCM, Measure::ACCX, Measure::ACCY, Measure::ACCZ,
                                      Measure::WDTM, Measure::WDTX, Measure::WDTY, Measure::WDTZ};

}  // namespace

MarkerRequest::MarkerRequest(RequestKind kind, const Signals& signals, MarkerId i, MarkerId j, MarkerId axes)
    : kind_(kind),
      i_(frame_of_marker(signals, i, Axes::read)),
      j_(frame_of_marker(signals, j, Axes::read)),
      axes_(frame_of_marker(signals, axes, Axes::read)) {
  if (kind == RequestKind::force) loads_ = loads_on(signals, i, j == global_frame ? std::nullopt : std::optional(j));
}

void MarkerRequest::evaluate(const Motion& motion, std::vector<double>& values) const {
  if (kind_ == RequestKind::force) {
    const Matrix3 axes = axes_.axes(motion);
    MarkerWrench w;
    for (const LoadPart part : {LoadPart::force, LoadPart::torque}) {
      Vector sum{};
      for (const MarkerLoad& l : loads_) {
        w.clear();
        l.wrench.source->wrench(motion, l.wrench.which, Partials::no, w);
        sum += on_marker(w, l.on_J, part);
      }
      values.push_back(norm(sum));
      for (std::size_t k = 0; k < 3; ++k) values.push_back(dot(axes[k], sum) + 0.0);
    }
    return;
  }
  const BodyId from = i_.place().body;
  const auto frame = [&](const MarkerFrame& m) { return m.frame(motion, from); };
  // Derivatives are those that the ground sees.
  const MarkerPlace ground;
  const MeasureFrames<Taylor> frames{frame(i_), frame(j_), frame(axes_), frame({&ground})};
  const auto measure = [&](const auto& measures) {
    for (const Measure m : measures) values.push_back(evaluate_measure<Taylor>(m, frames).value + 0.0);
  };
  if (kind_ == RequestKind::displacement) measure(displacements);
  if (kind_ == RequestKind::velocity) measure(velocities);
  if (kind_ == RequestKind::acceleration) measure(accelerations);
}

}  // namespace dynalin
