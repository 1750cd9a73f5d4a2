// A wheel under a quarter of a car: where it settles, what the strut carries there, how it bounces.
#include <dynalin/dynalin.h>

#include <cstdio>

int main() try {
  const dynalin::Study study(dynalin::Model::from_text(R"(Quarter of a car
UNITS/SYSTEM=MKS
ACCGRAV/KGRAV=-9.81
PART/1, GROUND
MARKER/1
PART/2, MASS=40, CM=20, IP=1,1,1, QG=0,0,0.3
MARKER/20
PART/3, MASS=300, CM=30, IP=20,20,20, QG=0,0,0.8
MARKER/30
JOINT/1, TRANSLATIONAL, I=20, J=1
JOINT/2, TRANSLATIONAL, I=30, J=1
SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=1, K=200000, LENGTH=0.3
SPRINGDAMPER/2, TRANSLATIONAL, I=30, J=20, K=20000, C=1500, LENGTH=0.5
END
)"));
  const dynalin::OperatingPoint settled = study.static_equilibrium();
  std::printf("the body settles by %.6f m, the strut carries %.2f N\n", 0.8 - settled.part(3).position[2],
              settled.load({"SPRINGDAMPER", 2}).force[2]);
  for (const dynalin::EigenMode& mode : study.linearize(settled).modes().modes)
    std::printf("%8.4f Hz, moves %s\n", mode.eigenvalue_hz.imag(), mode.moves_most.c_str());
  std::printf("computed with Dynalin %s\n", dynalin::version);
  return 0;
} catch (const dynalin::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
