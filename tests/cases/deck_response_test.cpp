// Frequency response of decks, solved by their reader, against C (sI − A)⁻¹ B + D of LINEAR/STATEMAT with the same
// channels; and decks with few digits.
#include <Eigen/LU>
#include <numbers>

#include "cases/decks.h"
#include "nastran_reader/nastran_program.h"

namespace dynalin::cases::deck_response_test {
namespace {

using Complex = std::complex<double>;

// A car body on two bushings, a wheel on a hinge with a spring, an actuator with states that pushes back; at rest under
// gravity. The force on MARKER/21 and the displacement of MARKER/31, both along global axes.
const std::string model =
    "Response\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nMARKER/2, PART=1, QP=2,0.3,0\n"
    "MARKER/3, PART=1, QP=2.5,0,-0.4\nPART/2, MASS=12, CM=20, IP=2,3,4\nMARKER/20, QP=1,0.1,0.2\nMARKER/21, "
    "QP=0.4,0,0.5\n"
    "MARKER/22, REULER=0.2,0.5,0.1\nMARKER/23, QP=2,0.3,0\nMARKER/24, QP=1.4,0.2,0.1, REULER=90D,90D,0\nMARKER/25, "
    "FLOATING\n"
    "PART/3, MASS=3, CM=30, IP=0.2,0.3,0.1, QG=1.4,0.2,0.1\nMARKER/30, QP=0.4,0.1,-0.2\nMARKER/31, QP=0.6,0,-0.1\n"
    "MARKER/34, REULER=90D,90D,0\n"
    "BUSHING/1, I=22, J=1, K=900,800,700, C=9,8,7, KT=90,80,70, CT=0.9,0.8,0.7\n"
    "BUSHING/2, I=23, J=2, K=500,600,700, C=5,6,7, KT=50,60,70, CT=0.5,0.6,0.7\nJOINT/1, REVOLUTE, I=34, J=24\n"
    "SPRINGDAMPER/1, TRANSLATIONAL, I=31, J=3, K=300, C=4, LENGTH=0.5\n"
    "ARRAY/1, U, VARIABLES=5\nARRAY/2, Y\nARRAY/3, X\nARRAY/4, IC, NUMBERS=2\nARRAY/5, IC, NUMBERS=1,0.3\nTFSISO/1, "
    "U=1, Y=2, X=3, "
    "NUM=4, DEN=5\n"
    "VARIABLE/5, FUNCTION=DZ(31)\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=31, J=1, FUNCTION=-30*ARYVAL(2,1)\n"
    "VARIABLE/1, FUNCTION=0\nVFORCE/1, I=21, JFLOAT=4, RM=1, FX=0\\FY=VARVAL(1)\\FZ=0\nMARKER/4, PART=1, FLOATING\n"
    "PINPUT/1, VARIABLES=1\nVARIABLE/11, FUNCTION=DX(31)\nVARIABLE/12, FUNCTION=DY(31)\nVARIABLE/13, FUNCTION=DZ(31)\n"
    "POUTPUT/1, VARIABLES=11,12,13\nEND\n";
const std::string response =
    "solution_number = 108\nbegin_frequency = 0.5\nend_frequency = 8.5\nsteps_frequency = 16\n"
    "matrix_entry_zero_tolerance = 1e-30\nactuator_swept_sine { name = shaker magnitude = 2.5 phase_angle = 30D }\n"
    "force_input_channel { name = in marker_id = 21 dof = y actuator_name = shaker mode = global }\n"
    "displacement_output_channel { name = out marker_id = 31 mode = global }\n"
    "frequency_response_subcase { number = 7 input_channel_names = in output_channel_names = out }\n";

Eigen::MatrixXd matrix(const RunResult& r, std::size_t k, const char* name) {
  const auto rows = r.matrix(k, name);
  Eigen::MatrixXd m(rows.size(), rows.empty() ? 0 : rows[0].size());
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    for (Eigen::Index j = 0; j < m.cols(); ++j)
      m(i, j) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  }
  return m;
}

class DeckResponse : public ProgramLibraryAndDecks, public ::testing::WithParamInterface<const char*> {};

TEST_P(DeckResponse, is_that_of_the_state_matrices) {
  write("response.cfg", response);
  const RunResult r =
      Cases::run(model, "SIMULATE/STATICS\nLINEAR/STATEMAT, PINPUT=1, POUTPUT=1, FILE=m\nLINEAR/EXPORT, TYPE=" +
                            std::string(GetParam()) + ", FILE=deck, CONFIG=response.cfg\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const Eigen::MatrixXd A = matrix(r, 1, "A"), B = matrix(r, 1, "B"), C = matrix(r, 1, "C"), D = matrix(r, 1, "D");

  nastran_reader::SolveOptions solve;
  solve.deck = (folder_ / "deck.dat").string();
  solve.json = (folder_ / "deck.json").string();
  std::ostringstream out, err;
  ASSERT_EQ(nastran_reader::solve_deck(solve, out, err), 0) << err.str();
  const auto found = nlohmann::json::parse(read_file(solve.json)).at("subcases").at(0);
  EXPECT_EQ(found.at("subcase"), 7);
  ASSERT_EQ(found.at("frequencies").size(), 17u);
  ASSERT_EQ(found.at("points").size(), 1u);
  const auto& displacements = found.at("points").at(0).at("displacements");
  const Complex drive = std::polar(2.5, std::numbers::pi / 6);
  for (std::size_t k = 0; k < 17; ++k) {
    const double frequency = found.at("frequencies").at(k);
    EXPECT_NEAR(frequency, 0.5 + 0.5 * static_cast<double>(k), 1e-12);
    const Complex s(0, 2 * std::numbers::pi * frequency);
    const Eigen::MatrixXcd system = s * Eigen::MatrixXcd::Identity(A.rows(), A.rows()) - A.cast<Complex>();
    const Eigen::VectorXcd expected =
        drive * (C.cast<Complex>() * system.partialPivLu().solve(B.cast<Complex>()) + D.cast<Complex>()).col(0);
    for (Eigen::Index c = 0; c < 3; ++c) {
      const auto& value = displacements.at(k).at(static_cast<std::size_t>(c));
      EXPECT_LE(std::abs(Complex(value.at(0), value.at(1)) - expected(c)), 1e-8 * expected.norm())
          << frequency << ' ' << c;
    }
  }
}
INSTANTIATE_TEST_SUITE_P(boxes, DeckResponse, ::testing::Values("CLOSEDBOX", "OPENBOX"));

using FewDigits = ProgramLibraryAndDecks;

TEST_F(FewDigits, of_short_fields_and_single_precision_are_those_of_the_eigenvalues) {
  const std::pair<const char*, double> formats[] = {
      {"", 1e-8}, {"use_dmig_long_format = no\n", 1e-3}, {"use_dmig_long_format = no\nuse_long_format = no\n", 1e-3}};
  for (const auto& [format, relative] : formats) {
    SCOPED_TRACE(format);
    write("format.cfg", format);
    const RunResult r =
        Cases::run(model,
                   "SIMULATE/STATICS\nLINEAR/EIGENSOL\nLINEAR/EXPORT, TYPE=OPENBOX, FILE=open, CONFIG=format.cfg\n"
                   "LINEAR/EXPORT, TYPE=CLOSEDBOX, FILE=closed, CONFIG=format.cfg\n");
    ASSERT_EQ(r.status, 0) << r.err;
    for (const char* deck : {"open.dat", "closed.dat"})
      expect_roots((folder_ / deck).string(), roots_of(r.result(1)), relative);
  }
}

}  // namespace
}  // namespace dynalin::cases::deck_response_test
