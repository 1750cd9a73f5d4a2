#include "output/json.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

namespace dynalin::json_test {
namespace {

std::string text_of(const JsonResults& results) {
  std::ostringstream out;
  results.write(out);
  return out.str();
}

TEST(JsonResults, replace_bytes_that_are_no_text) {
  JsonResults results;
  results.add_plain("SHOW/\xE9", 0.5);
  EXPECT_EQ(nlohmann::json::parse(text_of(results))["results"][0]["command"], "SHOW/\xEF\xBF\xBD");
}

// Long lists are written value by value: as the library lays out and rounds the same values.
TEST(JsonResults, are_the_text_of_their_values) {
  constexpr double infinity = std::numeric_limits<double>::infinity(), none = std::numeric_limits<double>::quiet_NaN();
  JsonResults results;
  results.add_plain("TIME \"1\"\n", 0.5);
  EigenSolution modes;
  modes.states.resize(1);
  modes.states[0].text = "AX of \"a\"";
  modes.modes.resize(2);
  modes.modes[0].eigenvalue_hz = {-0.0, 1.0 / 3}, modes.modes[0].condition = infinity;
  modes.modes[1].eigenvalue_hz = {-1e-300, 0}, modes.modes[1].is_real = true, modes.modes[1].moves_most = {"PART", 2};
  modes.vectors = Eigen::MatrixXcd(2, 2);
  modes.vectors << std::complex(1.0, -0.0), std::complex(1e22, 5e-324), 0.1, std::complex(123456789.0, 1e15);
  results.add("LINEAR/EIGENSOL", modes);
  ModalTable table{"KINETIC", 1, {"X", "Y"}, {{{"PART", 2}, 0, "a", {0.25, none}, {}}, {{}, 3, "", {1}, {-2}}}};
  results.add_tables({table, ModalTable{"MODE", 0, {}, {}}});
  results.add_point({});
  StateSpace empty;
  empty.A = Eigen::MatrixXd::Constant(2, 1, 0.7);
  results.add("LINEAR/STATEMAT", empty);
  results.finish({}, 0, {"a.msg"});
  const std::string text = text_of(results);
  const auto values = nlohmann::ordered_json::parse(text);
  EXPECT_EQ(text, values.dump(1) + "\n");

  const auto& found = values["results"][1];
  EXPECT_EQ(found["eigenvalues"].size(), 3u);
  EXPECT_EQ(found["eigenvalues"][1]["imag_hz"], -1.0 / 3);
  EXPECT_FALSE(std::signbit(found["modes"][0]["real_hz"].get<double>()));
  EXPECT_TRUE(found["modes"][0]["condition"].is_null());
  EXPECT_EQ(found["modes"][1]["vector"][0][0], 1e22);
  EXPECT_EQ(found["modes"][1]["vector"][0][1], 5e-324);
  EXPECT_EQ(found["tables"][0]["rows"][0]["values"][0], 0.25);
  EXPECT_TRUE(found["tables"][0]["rows"][0]["values"][1].is_null());
  EXPECT_EQ(found["tables"][0]["rows"][1]["values"][0][1], -2.0);
  EXPECT_TRUE(found["operating_point"].is_object());
  EXPECT_EQ(values["results"][2]["A"][1][0], 0.7);
  EXPECT_TRUE(values["results"][2]["B"].empty());
}

}  // namespace
}  // namespace dynalin::json_test
