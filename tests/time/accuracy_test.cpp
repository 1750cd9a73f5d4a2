// What ERROR means: errors of whole runs against closed forms and another integration.
#include "time/conservative.h"
#include "time/course.h"

namespace dynalin::in_time::accuracy_test {
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

void PrintTo(const Promise& p, std::ostream* out) { *out << p.mechanism().name; }

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

// A mass on a spring, pushed sideways as far as it is away: z = 0.05 (1 + cos √500 t). What the motion does not go by,
// a VARIABLE that only outputs and SENSORs read and the reaction of the slide, has as many digits after thousands of
// steps as after the first.
TEST(Accuracy, holds_for_what_nothing_in_the_motion_reads) {
  const std::string mass =
      "Mass\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/3, REULER=90D,90D,0\n"
      "PART/2, MASS=2, CM=2, IP=1,1,1, QG=0,0,0.1\nMARKER/2\nJOINT/1, TRANSLATIONAL, I=2, J=1\n"
      "SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=1000, LENGTH=0.05\n"
      "SFORCE/2, TRANSLATIONAL, ACTIONONLY, I=2, J=3, FUNCTION=1000*DZ(2,1)\n"
      "VARIABLE/1, FUNCTION=-1000*(DZ(2,1)-0.05)\nVARIABLE/2, FUNCTION=JOINT(1,0,2,1)\nVARIABLE/3, FUNCTION=VZ(2,1)\n";
  const Course course = led_through_time(mass + "END\n", {0.5, 5000, 1e-3});
  ASSERT_TRUE(course.ok()) << course.failure;
  const double omega = std::sqrt(500.0);
  double error = 0, of_reaction = 0, of_velocity = 0;
  for (std::size_t k = 0; k < course.times.size(); ++k) {
    const double t = course.times[k], away = 50 * std::cos(omega * t);
    error = std::max(error, std::abs(course.variables.at(1)[k] + away));
    of_reaction = std::max(of_reaction, std::abs(course.variables.at(2)[k] + 50 + away));
    of_velocity = std::max(of_velocity, std::abs(course.variables.at(3)[k] + 0.05 * omega * std::sin(omega * t)));
  }
  EXPECT_LT(error, 1e-4 * 50);
  EXPECT_LT(of_reaction, 1e-4 * 50);
  EXPECT_LT(of_velocity, 1e-4 * 0.05 * omega);
  const Course stopped =
      led_through_time(mass + "SENSOR/1, FUNCTION=VARVAL(1), VALUE=20, GE, HALT\nEND\n", {0.5, 5000, 1e-3});
  ASSERT_FALSE(stopped.times.empty());
  EXPECT_NEAR(stopped.times.back(), std::acos(-0.4) / omega, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Time, Accuracy, ::testing::ValuesIn(promises), [](const auto& its) {
  std::string name = its.param.mechanism().name;
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
});

}  // namespace
}  // namespace dynalin::in_time::accuracy_test
