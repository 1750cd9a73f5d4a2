// Paths of Adams View from names that hold more or less of them.
#include "model/view_names.h"

#include <gtest/gtest.h>

namespace dynalin::view_names_test {
namespace {

TEST(ViewNames, of_a_title_is_what_stands_behind_its_words) {
  EXPECT_EQ(view_model_name("Adams View model name:  car "), "car");
  EXPECT_EQ(view_model_name("adams view Model Name: car"), "car");
  EXPECT_EQ(view_model_name("A car"), "");
}

TEST(ViewNames, path_has_model_part_and_name_whatever_of_it_the_name_holds) {
  EXPECT_EQ(view_path("car", "wheel", "cm"), "car.wheel.cm");
  EXPECT_EQ(view_path("car", "wheel", "wheel.cm"), "car.wheel.cm");
  EXPECT_EQ(view_path("car", "car.wheel", "cm"), "car.wheel.cm");
  EXPECT_EQ(view_path("car", "car.wheel", "car.wheel.cm"), "car.wheel.cm");
  EXPECT_EQ(view_path("car", ".car.wheel", "cm"), ".car.wheel.cm");
  EXPECT_EQ(view_path("car", "wheel", ".car.wheel.cm"), ".car.wheel.cm");
  EXPECT_EQ(view_path("car", "", "SPRING_1.sforce"), "car.SPRING_1.sforce");
  EXPECT_EQ(view_path("", "wheel", "cm"), "wheel.cm");
  EXPECT_EQ(view_path("", "", "cm"), "cm");
  EXPECT_EQ(view_path("car", "wheel", ""), "");
}

TEST(ViewNames, of_a_part_may_be_that_of_the_model) {
  EXPECT_EQ(view_path("crank", "crank", "cm"), "crank.crank.cm");
  EXPECT_EQ(view_path("crank", "crank", "web.cm"), "crank.crank.web.cm");
  EXPECT_EQ(view_path("crank", "", "crank"), "crank.crank");
}

}  // namespace
}  // namespace dynalin::view_names_test
