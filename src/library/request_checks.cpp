#include "library/request_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "library/inside.h"

namespace dynalin::library {

namespace {

// All that is out of range in one request.
class RequestCheck {
 public:
  explicit RequestCheck(std::string analysis) : analysis_(std::move(analysis)) {}

  void require(bool holds, std::string what) {
    if (!holds) wrong_.push_back(std::move(what));
  }
  void at_least_zero(std::string_view name, const std::optional<double>& value) {
    if (value)
      require(std::isfinite(*value) && *value >= 0, fmt::format("{} is {:g} and may not be less than 0", name, *value));
  }
  void positive(std::string_view name, const std::optional<double>& value) {
    if (value)
      require(std::isfinite(*value) && *value > 0, fmt::format("{} is {:g} and must be more than 0", name, *value));
  }
  void at_least_one(std::string_view name, const std::optional<std::int64_t>& value) {
    if (value) require(*value >= 1, fmt::format("{} is {} and must be at least 1", name, *value));
  }
  void finish() const {
    if (wrong_.empty()) return;
    const std::vector<std::string> rest(wrong_.begin() + 1, wrong_.end());
    fail(Failure{analysis_, wrong_.front(), rest});
  }

 private:
  std::string analysis_;
  std::vector<std::string> wrong_;
};

}  // namespace

void check(const InitialConditionRequest& request) {
  RequestCheck c("initial conditions");
  c.at_least_zero("error", request.error);
  c.finish();
}

void check(const StaticRequest& request) {
  RequestCheck c("statics");
  c.at_least_zero("error", request.error);
  c.at_least_zero("imbalance", request.imbalance);
  c.at_least_zero("translation_limit", request.translation_limit);
  c.at_least_zero("rotation_limit", request.rotation_limit);
  c.at_least_one("iteration_limit", request.iteration_limit);
  c.at_least_zero("stability", request.stability);
  c.at_least_zero("global_damping", request.global_damping);
  c.at_least_zero("acceleration_error", request.acceleration_error);
  c.at_least_zero("kinetic_energy_error", request.kinetic_energy_error);
  c.at_least_zero("settling_time", request.settling_time);
  c.finish();
}

void check(const SimulationRequest& request, double present_time) {
  RequestCheck c("simulation");
  c.require(std::isfinite(request.end) && request.end > present_time,
            fmt::format("the end, {:g}, is not a time after the present one, {:g}", request.end, present_time));
  c.require(!request.steps || !request.output_step, "either the time between outputs is stated or their number");
  c.positive("output_step", request.output_step);
  c.at_least_one("steps", request.steps);
  c.positive("error", request.error);
  c.positive("largest_step", request.largest_step);
  c.positive("first_step", request.first_step);
  c.at_least_zero("least_step", request.least_step);
  c.at_least_one("largest_order", request.largest_order);
  c.finish();
}

void check(const ModeSelection& selection) {
  RequestCheck c("eigensolution");
  if (const auto* nearest = std::get_if<NearestModes>(&selection)) {
    c.at_least_one("count", static_cast<std::int64_t>(nearest->count));
    c.at_least_zero("frequency", nearest->frequency);
  } else {
    const auto& band = std::get<ModesInBand>(selection);
    c.require(std::isfinite(band.high) && band.low >= 0 && band.low < band.high,
              fmt::format("a band takes frequencies 0 ≤ low < high, not {:g} and {:g}", band.low, band.high));
  }
  c.finish();
}

void check(const EigenSolution& modes, const LinearModel::Inside& of) {
  const auto fits = [](const ComplexDenseMatrix& columns, std::size_t rows, std::size_t count) {
    return columns.rows() == static_cast<Eigen::Index>(rows) && columns.cols() == static_cast<Eigen::Index>(count);
  };
  RequestCheck c("tables of modes");
  const std::size_t count = modes.modes.size();
  if (count > 0 && modes.vectors.size() == 0) {
    c.require(false, "they need mode shapes, and these modes were found without: modes() has them");
  } else {
    c.require(modes.of_equations == of.linear.linear.model.of_equations, "the modes are those of another linear model");
    c.require(count == 0 || (fits(modes.vectors, modes.states.size(), count) &&
                             fits(modes.shapes, modes.shape_labels.size(), count)),
              fmt::format("there are {} modes, and vectors or shapes of other sizes", count));
  }
  c.finish();
}

}  // namespace dynalin::library
