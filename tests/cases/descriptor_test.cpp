// LINEAR/STATEMAT, DESCRIPTOR: files that say the same as the state matrices, read back as others would read them.
#include <gmock/gmock.h>
#include <matio.h>

#include <Eigen/Dense>
#include <fstream>
#include <memory>
#include <numbers>

#include "cases/both.h"

namespace dynalin::cases::descriptor_test {
namespace {

using ::testing::HasSubstr;
using Matrix = Eigen::MatrixXd;
using Complex = std::complex<double>;
constexpr double cycle = 2 * std::numbers::pi;

// A loop of four hinged links, two controllers, a force that reads an acceleration, two inputs and two outputs.
const std::string model =
    "loop\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nMARKER/2, QP=2,0,0\nMARKER/3, QP=1,3,0\n"
    "MARKER/4, REULER=90D,90D,0\n"
    "PART/2, MASS=1, CM=20, IP=0.1,0.2,0.3, REULER=70D,0,0\nMARKER/20, QP=0.5,0,0\nMARKER/21\nMARKER/22, QP=1,0,0\n"
    "PART/3, MASS=2, CM=30, IP=0.2,0.2,0.3, QG=0.3420201433256687,0.9396926207859084,0\nMARKER/30, "
    "QP=1,0,0\nMARKER/31\n"
    "MARKER/32, QP=2,0,0\nPART/4, MASS=1.5, CM=40, IP=0.1,0.1,0.1, QG=2,0,0, REULER=70D,0,0\nMARKER/40, QP=0.5,0,0\n"
    "MARKER/41\nMARKER/42, QP=1,0,0\nJOINT/1, REVOLUTE, I=21, J=1\nJOINT/2, REVOLUTE, I=31, J=22\n"
    "JOINT/3, REVOLUTE, I=32, J=42\nJOINT/4, REVOLUTE, I=41, J=2\n"
    "SPRINGDAMPER/1, TRANSLATIONAL, I=30, J=3, K=90, C=2, LENGTH=1\nDIFF/1, FUNCTION=-2*DIF(1)+VARVAL(1)+DX(30)\n"
    "DIFF/2, FUNCTION=DIF(1)-0.3*DIF(2)\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=40, J=4, "
    "FUNCTION=VARVAL(2)-0.5*DIF(2)-0.1*ACCX(30)\nVARIABLE/1, FUNCTION=0\nVARIABLE/2, FUNCTION=0\n"
    "VARIABLE/3, FUNCTION=DY(30)\nVARIABLE/4, FUNCTION=FX(31,22)+3*VARVAL(1)\nPINPUT/5, VARIABLES=1,2\n"
    "POUTPUT/6, VARIABLES=3,4\nEND\n";

class Descriptor : public ProgramAndLibrary {
 protected:
  Matrix read_market(const std::string& name) const {
    std::ifstream in(folder_ / name);
    std::string line;
    std::getline(in, line);
    EXPECT_EQ(line, "%%MatrixMarket matrix coordinate real general");
    while (in.peek() == '%') std::getline(in, line);
    Eigen::Index rows = 0, columns = 0, entries = 0;
    in >> rows >> columns >> entries;
    Matrix m = Matrix::Zero(rows, columns);
    for (Eigen::Index k = 0; k < entries; ++k) {
      Eigen::Index r = 0, c = 0;
      std::string value;
      in >> r >> c >> value;
      m(r - 1, c - 1) = std::stod(value);
    }
    EXPECT_TRUE(in.good()) << name;
    return m;
  }
  static Matrix of_json(const nlohmann::json& rows, Eigen::Index columns) {
    Matrix m(static_cast<Eigen::Index>(rows.size()), columns);
    for (Eigen::Index r = 0; r < m.rows(); ++r) {
      for (Eigen::Index c = 0; c < columns; ++c)
        m(r, c) = rows[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
    }
    return m;
  }
};

TEST_F(Descriptor, has_the_eigenvalues_and_the_transfer_function_of_the_state_matrices) {
  const RunResult r = run(model,
                          "LINEAR/STATEMAT, DESCRIPTOR, FILE=m, PINPUT=5, POUTPUT=6\n"
                          "LINEAR/STATEMAT, FILE=s, PINPUT=5, POUTPUT=6\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const Matrix E = read_market("m_E.mtx"), A = read_market("m_A.mtx"), B = read_market("m_B.mtx"),
               C = read_market("m_C.mtx"), D = read_market("m_D.mtx");
  const auto states = static_cast<Eigen::Index>(r.result(1).at("states").size());
  const Eigen::Index n = A.rows(), first = n - states;
  EXPECT_EQ(r.result(0).at("unknowns"), n);
  EXPECT_EQ(r.result(0).at("first_state"), first + 1);
  EXPECT_EQ(r.result(0).at("states"), r.result(1).at("states"));
  Matrix ones = Matrix::Zero(n, n);
  ones.bottomRightCorner(states, states).setIdentity();
  EXPECT_EQ(E, ones);

  const Matrix eliminated = A.bottomLeftCorner(states, first) *
                            A.topLeftCorner(first, first).fullPivLu().solve(A.topRightCorner(first, states));
  const Eigen::VectorXcd values = (A.bottomRightCorner(states, states) - eliminated).eigenvalues() / cycle;
  ASSERT_EQ(values.size(), static_cast<Eigen::Index>(r.eigenvalues(2).size()));
  for (const Complex& value : r.eigenvalues(2))
    EXPECT_LT((values.array() - value).abs().minCoeff(), 1e-10 * std::abs(value)) << value;

  const Matrix a = of_json(r.result(1).at("A"), states), b = of_json(r.result(1).at("B"), 2),
               c = of_json(r.result(1).at("C"), states), d = of_json(r.result(1).at("D"), 2);
  for (const Complex s : {Complex(0, 1), Complex(0.3, 7), Complex(-20, 3), Complex(5, 0)}) {
    const Eigen::MatrixXcd sparse = C * (s * E - A).fullPivLu().solve(B.cast<Complex>()) + D;
    const Eigen::MatrixXcd dense =
        c * (s * Matrix::Identity(states, states) - a).fullPivLu().solve(b.cast<Complex>()) + d;
    for (Eigen::Index k = 0; k < dense.size(); ++k)
      EXPECT_LT(std::abs(sparse(k) - dense(k)), 1e-9 * std::abs(dense(k)) + 1e-14 * dense.cwiseAbs().maxCoeff())
          << s << "\n"
          << sparse << dense;
    EXPECT_GT(dense.cwiseAbs().minCoeff(), 1e-8) << dense;
  }
}

TEST_F(Descriptor, has_the_same_in_the_matlab_file_with_names) {
  const RunResult r = run(model, "LINEAR/STATEMAT, DESCRIPTOR, FILE=m, PINPUT=5, POUTPUT=6\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const auto close = [](mat_t* file) { Mat_Close(file); };
  const std::unique_ptr<mat_t, decltype(close)> file(Mat_Open((folder_ / "m.mat").c_str(), MAT_ACC_RDONLY), close);
  ASSERT_TRUE(file);
  const auto read = [&](const char* name) {
    const auto free_it = [](matvar_t* v) { Mat_VarFree(v); };
    return std::unique_ptr<matvar_t, decltype(free_it)>(Mat_VarRead(file.get(), name), free_it);
  };
  for (const char* name : {"E", "A", "B", "C"}) {
    const auto variable = read(name);
    ASSERT_TRUE(variable) << name;
    ASSERT_EQ(variable->class_type, MAT_C_SPARSE);
    const auto& sparse = *static_cast<const mat_sparse_t*>(variable->data);
    Matrix m = Matrix::Zero(static_cast<Eigen::Index>(variable->dims[0]), static_cast<Eigen::Index>(variable->dims[1]));
    for (Eigen::Index c = 0; c < m.cols(); ++c) {
      for (mat_uint32_t k = sparse.jc[c]; k < sparse.jc[c + 1]; ++k)
        m(static_cast<Eigen::Index>(sparse.ir[k]), c) = static_cast<const double*>(sparse.data)[k];
    }
    EXPECT_EQ(m, read_market(std::string("m_") + name + ".mtx")) << name;
  }
  EXPECT_EQ(read("D")->class_type, MAT_C_DOUBLE);
  const auto states = read("states"), first = read("first_state"), types = read("STATES");
  const auto& labels = r.result(0).at("states");
  EXPECT_EQ(*static_cast<const double*>(first->data), r.result(0).at("first_state"));
  ASSERT_EQ(states->dims[0], labels.size());
  ASSERT_EQ(types->dims[0], labels.size());
  ASSERT_EQ(types->dims[1], 3u);
  for (std::size_t k = 0; k < labels.size(); ++k) {
    const matvar_t* cell = Mat_VarGetCell(states.get(), static_cast<int>(k));
    EXPECT_EQ(std::string(static_cast<const char*>(cell->data), cell->nbytes), labels[k].at("label"));
  }
  const std::string text = r.text("m_labels.txt");
  EXPECT_THAT(text, HasSubstr("kind\tnumber\tunknown\ttype\telement\tcoordinate\tname\nstate\t1\t" +
                              r.result(0).at("first_state").dump() + "\t"));
  EXPECT_THAT(text, HasSubstr("input\t2\t\t\t2\t\tVARIABLE/2\noutput\t1\t\t\t3\t\tVARIABLE/3\n"));
  EXPECT_THAT(r.out, HasSubstr("sparse equations of "));
  EXPECT_THAT(r.message, HasSubstr("kinematic states (displacement and velocities)"));
}

TEST_F(Descriptor, leaves_out_channels_that_are_not_asked_for) {
  const RunResult r = run(model, "LINEAR/STATEMAT, DESCRIPTOR, FILE=m\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(r.wrote("m_E.mtx") && r.wrote("m_A.mtx") && r.wrote("m.mat") && r.wrote("m_labels.txt"));
  EXPECT_FALSE(r.wrote("m_B.mtx") || r.wrote("m_C.mtx") || r.wrote("m_D.mtx"));
}

// A point without mass between a damper and a spring has a state of first order, and equations that are coupled
// otherwise.
TEST_F(Descriptor, holds_freedoms_without_mass) {
  const std::string massless =
      "massless\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nPART/3, "
      "QG=0,0,1\nMARKER/30\nMARKER/2, PART=1, QP=0,0,2\nJOINT/1, TRANSLATIONAL, I=20, J=1\nJOINT/2, TRANSLATIONAL, "
      "I=30, "
      "J=2\nSPRINGDAMPER/1, TRANSLATIONAL, I=30, J=20, K=3, LENGTH=1\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=30, J=1, "
      "FUNCTION=-2*VZ(30)\nSFORCE/2, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=-5*DZ(20)\nEND\n";
  const RunResult r = run(massless, "LINEAR/STATEMAT, DESCRIPTOR, FILE=m\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const Matrix E = read_market("m_E.mtx"), A = read_market("m_A.mtx");
  for (const Complex& value : r.eigenvalues(1)) {
    // A − λE has nothing left in one direction.
    const Eigen::MatrixXcd pencil = A.cast<Complex>() - (cycle * value) * E.cast<Complex>();
    const Eigen::VectorXd singular = pencil.jacobiSvd().singularValues();
    EXPECT_LT(singular(singular.size() - 1), 1e-12 * singular(0)) << value;
  }
  EXPECT_EQ(E.sum(), static_cast<double>(r.eigenvalues(1).size()));
}

TEST_F(Descriptor, is_offered_where_state_matrices_are_too_large) {
  write("model.adm", model);
  SessionOptions options;
  options.file = (folder_ / "model.adm").string();
  options.dense_up_to = 3;
  const auto run_with = [&](const std::string& command) {
    options.commands = {command + ", FILE=" + (folder_ / "m").string()};
    std::ostringstream out, err;
    const int status = run_session(options, out, err);
    return std::pair(status, err.str());
  };
  for (const std::string command : {"LINEAR/STATEMAT", "LINEAR/MKB"}) {
    const auto [status, said] = run_with(command);
    EXPECT_EQ(status, 2);
    EXPECT_THAT(said,
                HasSubstr("the state matrix of 4 states has 128 bytes and is formed up to 3 states only; the sparse "
                          "equations (LINEAR/STATEMAT, DESCRIPTOR; descriptor_form) do without it, --dense-up-to 4 "
                          "(dense_up_to) forms it"));
  }
  EXPECT_EQ(run_with("LINEAR/STATEMAT, DESCRIPTOR").first, 0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "m.mat"));
  options.dense_up_to = 4;
  EXPECT_EQ(run_with("LINEAR/STATEMAT").first, 0);
}

}  // namespace
}  // namespace dynalin::cases::descriptor_test
