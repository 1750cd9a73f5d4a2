// Matrices of the library copied, moved, resized and multiplied by a program, whatever options that is compiled with;
// and what it computes itself beside.
#include <dynalin/dynalin.h>

#include <cstdio>
#include <string>
#include <vector>

namespace {

int wrong = 0;
void expect(bool holds, const char* what) {
  if (holds) return;
  std::printf("wrong: %s\n", what);
  ++wrong;
}

dynalin::Model chain(int links) {
  std::string text = "Chain\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n";
  for (int k = 2; k < links + 2; ++k) {
    const std::string id = std::to_string(k), before = k == 2 ? "1" : std::to_string(10 * k - 10);
    text += "PART/" + id + ", MASS=1, CM=" + id + "0, IP=1,1,1\nMARKER/" + id + "0\nBUSHING/" + id + ", I=" + id +
            "0, J=" + before + ", K=100,200,300, KT=10,20,30, C=1,1,1\n";
  }
  text +=
      "VARIABLE/1, FUNCTION=0\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=VARVAL(1)\n"
      "VARIABLE/2, FUNCTION=DX(20,1)\nPINPUT/1, VARIABLES=1\nPOUTPUT/1, VARIABLES=2\nEND\n";
  return dynalin::Model::from_text(text);
}

}  // namespace

int main() {
  const dynalin::Study study(chain(8));
  const auto linear = study.linearize({.pinput = 1, .poutput = 1});
  dynalin::StateSpace space = linear.state_space();
  const Eigen::Index n = space.A.rows();
  expect(n == 96, "the number of states");

  // Moved and taken over, by either side.
  dynalin::DenseMatrix taken = std::move(space.A);
  space.A = taken * taken;
  taken.conservativeResize(n + 3, n + 1);
  taken = linear.state_space().A;
  const Eigen::MatrixXd own = taken;
  space.B.resize(0, 0);
  dynalin::Modes modes = linear.modes();
  modes.vectors.swap(modes.shapes);
  modes.vectors.swap(modes.shapes);
  dynalin::ModalTableRequest request;
  request.modes["KINETIC"] = dynalin::ModeRange::all();
  expect(linear.tables(modes, request).tables.size() == linear.tables(linear.modes(), request).tables.size(),
         "tables of modes that went through here");
  std::vector<dynalin::PhysicalMatrices> physical(3, linear.physical_matrices());
  physical.erase(physical.begin());
  auto sum = physical[0].force;
  sum += physical[1].force;
  expect(sum.of_accelerations == 2 * physical[0].force.of_accelerations, "a sum that the library forms");
  auto form = linear.descriptor_form();
  form.A = Eigen::SparseMatrix<double>(form.A.transpose());
  form.E.resize(0, 0);

  // What this program computes itself, with kernels that the library has for other processors.
  const Eigen::MatrixXd square = own * own;
  expect((taken * taken - square).cwiseAbs().maxCoeff() <= 1e-12 * square.norm(), "a product");
  try {
    study.linearize({.pstate = 7});
    expect(false, "an exception");
  } catch (const dynalin::Error& error) {
    expect(!error.problems.empty(), "its problems");
  }
  if (wrong == 0) std::printf("all as it should be\n");
  return wrong != 0;
}
