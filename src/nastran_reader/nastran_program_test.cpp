// The subcommands: exit statuses, what is printed, what is written.
#include "nastran_reader/nastran_program.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace dynalin::nastran_reader::nastran_program_test {
namespace {

using ::testing::HasSubstr;

class NastranProgram : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("nastran" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return path(name);
  }
  int check(const std::string& deck) { return check_deck(deck, out, err); }
  int solve(SolveOptions options) { return solve_deck(options, out, err); }

  std::filesystem::path folder_;
  std::ostringstream out, err;
};

const std::string control = "SOL 107\nCEND\nCMETHOD=1\nBEGIN BULK\nEIGC,1,HESS,MAX,,,,9\n";
const std::string oscillator = "SPOINT,1\nCELAS2,1,50.,1\nCMASS2,2,2.,1\nCDAMP2,3,.4,1\n";

TEST_F(NastranProgram, solves_and_writes_what_it_computed) {
  const std::string deck = write("a.bdf", control + oscillator + "ENDDATA\n");
  EXPECT_EQ(check(deck), 0);
  EXPECT_THAT(out.str(), HasSubstr("nothing wrong"));
  EXPECT_EQ(solve({deck, path("a.json"), {2}, false}), 0);
  EXPECT_EQ(err.str(), "");
  EXPECT_THAT(out.str(), HasSubstr("4.9989998"));
  const auto json = nlohmann::json::parse(std::ifstream(path("a.json")));
  EXPECT_EQ(json["solution"], 107);
  EXPECT_EQ(json["finite"], 2);
  EXPECT_EQ(json["degrees_of_freedom"], 1);
  ASSERT_EQ(json["eigenvalues"].size(), 2u);
  const double imaginary = std::sqrt(25 - .01);
  EXPECT_NEAR(json["eigenvalues"][1]["imag"], imaginary, 1e-14);
  EXPECT_NEAR(json["eigenvalues"][1]["real"], -.1, 1e-15);
  EXPECT_NEAR(json["eigenvalues"][1]["imag_hz"], imaginary / (2 * std::acos(-1.0)), 1e-14);
  EXPECT_EQ(json["modes"][0]["number"], 2);
  EXPECT_NEAR(json["modes"][0]["points"][0]["displacements"][0][0], 1, 1e-15);
}

TEST_F(NastranProgram, solves_frequency_response) {
  const std::string deck = write(
      "a.bdf", "SOL 108\nCEND\nFREQ=2\nDLOAD=3\nDISP=ALL\nBEGIN BULK\nFREQ,2,.5,.1\nRLOAD1,3,4,,,1.\nDAREA,4,1,,7.\n" +
                   oscillator + "ENDDATA\n");
  EXPECT_EQ(solve({deck, path("a.json"), {}, false}), 0) << err.str();
  const auto json = nlohmann::json::parse(std::ifstream(path("a.json")));
  EXPECT_EQ(json["solution"], 108);
  const auto& first = json["subcases"][0];
  EXPECT_EQ(first["frequencies"], (std::vector<double>{.1, .5}));
  const double w = .2 * std::acos(-1.0);
  const std::complex<double> expected = 7.0 / std::complex<double>(50 - 2 * w * w, .4 * w);
  EXPECT_NEAR(first["points"][0]["displacements"][0][0][0], expected.real(), 1e-14);
  EXPECT_NEAR(first["points"][0]["displacements"][0][0][1], expected.imag(), 1e-14);
  EXPECT_EQ(solve({deck, "", {1}, false}), 3);
}

TEST_F(NastranProgram, tells_by_its_exit_status_what_happened) {
  EXPECT_EQ(check(path("none.bdf")), 1);
  EXPECT_THAT(err.str(), HasSubstr("cannot be read"));
  EXPECT_EQ(check(write("b.bdf", control + "GRID,1,,1\nENDDATA\n")), 1);
  EXPECT_THAT(err.str(), HasSubstr("b.bdf:6:9: error: GRID: X 1 is 1, an integer, and should be a real [field-form]"));
  EXPECT_EQ(solve({path("b.bdf"), path("b.json"), {}, false}), 1);
  EXPECT_FALSE(std::filesystem::exists(path("b.json")));
  const std::string singular = write("c.bdf", control + "SPOINT,1,2\nCDAMP2,1,1.,1,,2\nENDDATA\n");
  EXPECT_EQ(check(singular), 0);
  EXPECT_EQ(solve({singular, "", {}, false}), 2);
  EXPECT_THAT(err.str(), HasSubstr("singular"));
  const std::string unknown = write("d.bdf", control + oscillator + "CBEAM,9,9,9,9\nENDDATA\n");
  EXPECT_EQ(solve({unknown, "", {}, false}), 1);
  EXPECT_EQ(solve({unknown, "", {}, true}), 0);
  EXPECT_EQ(solve({write("e.bdf", control + oscillator + "ENDDATA\n"), "", {3}, false}), 3);
}

}  // namespace
}  // namespace dynalin::nastran_reader::nastran_program_test
