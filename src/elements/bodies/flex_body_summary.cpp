#include "elements/bodies/flex_body_summary.h"

#include <fmt/format.h>

#include <numbers>

#include "elements/bodies/flex_body.h"

namespace dynalin {

std::vector<std::string> flexible_body_lines(const Model& model) {
  std::vector<std::string> lines;
  for (const FlexibleBody& f : flexible_bodies(model)) {
    const ModalBody& b = *f.flexible;
    std::string line = fmt::format("{}: mass {:.6g}", model.body(f.body).label.full_text(), b.inertia.mass);
    if (b.modes() > 0) {
      const Eigen::VectorXd hertz = own_modes(b, model.units.ucf).frequency / (2 * std::numbers::pi);
      line += fmt::format(", {} mode{} from {:.6g} to {:.6g} {}", b.modes(), b.modes() == 1 ? "" : "s",
                          hertz.minCoeff(), hertz.maxCoeff(), model.units.frequency());
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace dynalin
