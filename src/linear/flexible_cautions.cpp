#include "linear/flexible_cautions.h"

#include <fmt/format.h>

#include <numbers>

#include "elements/bodies/flex_body.h"

namespace dynalin {

namespace {

constexpr double fast = 0.1, far = 0.1, degree = std::numbers::pi / 180, largest_turn = 10 * degree;

// Of all nodes, three rows each.
double farthest_node(const Eigen::VectorXd& by_nodes) {
  double most = 0;
  for (Eigen::Index k = 0; k + 2 < by_nodes.size(); k += 3) most = std::max(most, by_nodes.segment<3>(k).norm());
  return most;
}

}  // namespace

void flexible_cautions(const System& system, const OperatingPoint& op, Diagnostics& out) {
  const Model& model = system.model();
  const Motion motion = system.motion(op);
  for (const FlexibleBody& f : flexible_bodies(model)) {
    const ModalBody& b = *f.flexible;
    if (b.modes() == 0) continue;
    const ElementLabel& label = model.body(f.body).label;
    const double speed = norm(motion.body(f.body).w);
    const double lowest = own_modes(b, model.units.ucf).frequency.minCoeff();
    if (speed > fast * lowest) {
      out.warning("fast-flexible-body", label.at,
                  fmt::format("{} turns at {:.3g} rad/{}, {:.2g} of its lowest frequency: its modes know no geometric "
                              "stiffening",
                              label.full_text(), speed, model.units.time_symbol(), speed / lowest));
    }
    const Eigen::Map<const Eigen::VectorXd> q(op.extra.data() + f.first, b.modes());
    const double bent = farthest_node(b.translation * q), turned = farthest_node(b.rotation * q);
    if ((b.length > 0 && bent > far * b.length) || turned > largest_turn) {
      out.warning(
          "far-bent-body", label.at,
          fmt::format("{} is bent by {:.3g} of its length and turned within by {:.3g} degrees: linear modes hold "
                      "for a tenth and ten degrees",
                      label.full_text(), b.length > 0 ? bent / b.length : 0.0, turned / degree));
    }
  }
}

}  // namespace dynalin
