// Eigenvalues of a mechanism over a range of stiffness: ten models in ten threads.
#include <dynalin/dynalin.h>

#include <cstdio>
#include <string>
#include <thread>
#include <vector>

int main() {
  std::vector<double> frequency(10);
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < frequency.size(); ++k) {
    threads.emplace_back([&frequency, k] {
      const std::string stiffness = std::to_string(100 * (k + 1));
      const dynalin::Study mass_on_spring(
          dynalin::Model::from_text("A mass on a spring\n"
                                    "UNITS/SYSTEM=MKS\n"
                                    "PART/1, GROUND\n"
                                    "MARKER/1\n"
                                    "PART/2, MASS=2, CM=20, IP=1,1,1, QG=0,0,1\n"
                                    "MARKER/20\n"
                                    "JOINT/1, TRANSLATIONAL, I=20, J=1\n"
                                    "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=1, LENGTH=1, K=" +
                                    stiffness +
                                    "\n"
                                    "END\n"));
      const auto at_rest = mass_on_spring.static_equilibrium();
      frequency[k] = mass_on_spring.linearize(at_rest).modes().modes.front().eigenvalue_hz.imag();
    });
  }
  for (auto& thread : threads) thread.join();
  for (std::size_t k = 0; k < frequency.size(); ++k) std::printf("K = %4zu: %.12f Hz\n", 100 * (k + 1), frequency[k]);
}
