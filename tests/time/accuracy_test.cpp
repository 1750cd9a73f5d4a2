// What ERROR means: errors of whole runs against closed forms and another integration.
#include "time/conservative.h"
#include "time/course.h"

namespace dynalin::in_time {
namespace {

struct Promise {
  Conservative (*mechanism)();
  double times_error;  // the largest error of a value, as a part of its largest, over ERROR: ten periods
};

// Measured: 0.8, 90, 0.1, 5, 0.9, 0.2. The body that tumbles makes of a small error a large one at each turn over; the
// links in space run for 31 s at 2 rad/s and more, so that a speed that is wrong by 2e-9 is in the end a place that is
// wrong by 1e-7.
const Promise promises[] = {{pendulum, 2},          {tumbling_body, 250}, {heavy_top, 0.5},
                            {spatial_four_bar, 15}, {slider_crank, 3},    {gyroscope, 0.5}};

class Accuracy : public ::testing::TestWithParam<Promise> {};

double largest_error(const Conservative& mechanism, const Course& course) {
  const auto truth = mechanism.truth(course.times);
  double largest = 0;
  for (std::size_t v = 0; v < truth[0].size(); ++v) {
    double error = 0, size = 0;
    for (std::size_t k = 0; k < truth.size(); ++k) {
      error = std::max(error, std::abs(course.variables.at(static_cast<std::int64_t>(v) + 1)[k] - truth[k][v]));
      size = std::max(size, std::abs(truth[k][v]));
    }
    largest = std::max(largest, error / size);
  }
  return largest;
}

TEST_P(Accuracy, is_in_proportion_to_ERROR) {
  const Conservative mechanism = GetParam().mechanism();
  for (const double error : {1e-3, 1e-5, 1e-7, 1e-9}) {
    const Course course = led_through_time(mechanism.dataset, {10 * mechanism.period, 40, error});
    ASSERT_TRUE(course.ok()) << course.failure;
    EXPECT_LE(largest_error(mechanism, course), GetParam().times_error * error) << mechanism.name << ", " << error;
  }
}

INSTANTIATE_TEST_SUITE_P(Time, Accuracy, ::testing::ValuesIn(promises), [](const auto& its) {
  std::string name = its.param.mechanism().name;
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
});

}  // namespace
}  // namespace dynalin::in_time
