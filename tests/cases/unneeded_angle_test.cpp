// Angles that do not exist where axes are at right angles: laws in which they have no factor are as good there as
// anywhere, others are refused by name.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "cases/run.h"
#include "cases/study_of.h"

namespace dynalin::cases::unneeded_angle_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

// A body of mass 2 and inertia 1 on stiffnesses of 100 and 50, with z of MARKER/20 along y of 67 and x of it along z of
// 66, and z of MARKER/21 along x of 68.
std::string mounted(const std::string& more) {
  return "Right angles\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/66, PART=1, REULER=90D,90D,0\n"
         "MARKER/67, PART=1, REULER=0,90D,0\nMARKER/68, PART=1, REULER=90D,90D,90D\n"
         "PART/2, MASS=2, CM=20, IP=1,1,1\nMARKER/20\n"
         "BUSHING/1, I=20, J=1, K=100,100,100, KT=50,50,50\n" +
         more + "\nEND\n";
}
std::string diagonal(const std::string& first, const std::string& last) {
  std::string values;
  for (int k = 0; k < 6; ++k) {
    for (int row = 0; row < 6; ++row) values += (values.empty() ? "" : ",") + (row != k ? "0" : k < 3 ? first : last);
    if (k % 2 == 1 && k < 5) values += "\n";
  }
  return values;
}

class UnneededAngles : public Cases {
 protected:
  // λ² + c λ + k = 0 of translations and rotations.
  struct Freedom {
    double c, k;
  };
  void expect_vibrations(const std::string& element, const std::vector<Freedom>& freedoms) const {
    const RunResult r = run(mounted(element), "SIMULATE/STATICS\nLINEAR/EIGENSOL, STRAIN=1\n");
    ASSERT_EQ(r.status, 0) << r.err << element;
    std::vector<std::complex<double>> expected;
    for (const auto& [c, k] : freedoms) {  // by frequency
      const std::complex<double> root(-c / 2, std::sqrt(k - c * c / 4));
      expected.push_back(root / (2 * std::numbers::pi));
    }
    expect_eigenvalues(r.eigenvalues(1), expected);
  }
};

TEST_F(UnneededAngles, are_not_looked_at_by_dampers) {
  const Freedom free{0, 50}, damped{1, 50};
  expect_vibrations("BUSHING/9, I=20, J=67, K=1,2,3, CT=1,1,1",
                    {damped, damped, damped, {0, 50.5}, {0, 51}, {0, 51.5}});
  expect_vibrations("FIELD/9, I=20, J=67, KMATRIX=" + diagonal("1", "0") + "\n, CMATRIX=" + diagonal("0", "1"),
                    {damped, damped, damped, {0, 50.5}, {0, 50.5}, {0, 50.5}});
  expect_vibrations("SPRINGDAMPER/9, ROTATIONAL, I=20, J=66, CT=1", {damped, free, free, free, free, free});
  expect_vibrations("MATRIX/9, FULL=CORDER, ROWS=6, COLUMNS=6, VALUES=" + diagonal("1", "0") +
                        "\nMATRIX/8, FULL=CORDER, ROWS=6, COLUMNS=6, VALUES=" + diagonal("0", "1") +
                        "\nNFORCE/9, IMARKERS=20, J=67, KMATRIX=9, CMATRIX=8",
                    {damped, damped, damped, {0, 50.5}, {0, 50.5}, {0, 50.5}});
}

// Of a BUSHING that has a stiffness about the two other axes alone; a torque needs no angle either.
TEST_F(UnneededAngles, are_not_looked_at_beside_those_that_are_needed) {
  for (const char* element : {"BUSHING/9, I=20, J=67, KT=3,0,4", "SPRINGDAMPER/9, ROTATIONAL, I=20, J=66, TORQUE=1"}) {
    const RunResult r = run(mounted(element), "LINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 0) << r.err << element;
  }
}

TEST_F(UnneededAngles, are_refused_by_name_where_they_are_needed) {
  const std::pair<std::string, const char*> rows[] = {
      {"BUSHING/9, I=20, J=67, KT=0,1,0",
       "BUSHING/9: the angle AY is not defined where the z axis of I is along the y"},
      {"SPRINGDAMPER/9, ROTATIONAL, I=20, J=66, KT=1",
       "SPRINGDAMPER/9: the angle AZ is not defined where the x axis of I is along the z axis of J"},
      {"MATRIX/9, FULL=CORDER, ROWS=6, COLUMNS=6, VALUES=" + diagonal("1", "1") +
           "\nNFORCE/9, IMARKERS=20, J=67, KMATRIX=9",
       "NFORCE/9: the angle AY is not defined where the z axis of MARKER/20 is along the y axis of J"},
  };
  for (const auto& [element, reason] : rows) {
    const RunResult r = run(mounted(element), "LINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 2) << element;
    EXPECT_THAT(r.err, AllOf(HasSubstr(reason), Not(HasSubstr("the force on")))) << element;
  }
}

TEST_F(UnneededAngles, are_no_cause_for_a_warning) {
  const auto warned = [](const std::string& element) {
    const auto model = library::Model::from_text(mounted(element));
    std::vector<std::string> codes;
    for (const auto& remark : model.remarks()) codes.emplace_back(remark.code);
    return codes;
  };
  EXPECT_THAT(warned("BUSHING/9, I=20, J=67, K=1,2,3, KT=5,0,5, CT=1,1,1"), IsEmpty());
  EXPECT_THAT(warned("FIELD/9, I=20, J=67, KMATRIX=" + diagonal("1", "0") + "\n, CMATRIX=" + diagonal("0", "1")),
              IsEmpty());
  const std::string nforce = "\nNFORCE/9, IMARKERS=20, J=67, KMATRIX=9",
                    matrix = "MATRIX/9, FULL=CORDER, ROWS=6, COLUMNS=6, VALUES=";
  EXPECT_THAT(warned(matrix + diagonal("1", "0") + nforce), IsEmpty());
  EXPECT_THAT(warned(matrix + diagonal("1", "1") + nforce), ::testing::ElementsAre("skew-axes"));
}

// Which angles are read is decided by the numbers that hold.
TEST_F(UnneededAngles, are_needed_as_soon_as_a_number_says_so) {
  const auto damped = library::Model::from_text(mounted("BUSHING/9, I=20, J=67, CT=1,1,1"));
  const auto read = [](const library::Model& model) { return library::Study(model).linearize().state_space().A; };
  const Eigen::MatrixXd A = read(damped);
  EXPECT_TRUE(A.allFinite());
  const auto sprung = damped.with({{"BUSHING/9 KT[2]", 1}});
  EXPECT_THAT([&] { read(sprung); }, ::testing::Throws<Error>());
  EXPECT_EQ(read(sprung.with({{"BUSHING/9 KT[2]", 0}})), A);
}

}  // namespace
}  // namespace dynalin::cases::unneeded_angle_test
