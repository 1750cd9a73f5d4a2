// A System is never changed after it is made: threads that share one get what a single one gets, to the last bit. The
// preset `tsan` watches them.
#include <gtest/gtest.h>

#include <thread>

#include "analysis/statics.h"
#include "eigenvalues/eigen.h"
#include "elements/catalogue.h"
#include "modal/modal_distribution.h"
#include "oracle/mechanism.h"
#include "oracle/program_point.h"

namespace dynalin::oracle::threads_test {
namespace {

struct Numbers {
  std::vector<double> velocity, acceleration, lambda;
  Eigen::MatrixXd A;
  Eigen::MatrixXcd vectors;
  std::vector<double> strain;  // of the first mode
  bool operator==(const Numbers&) const = default;
};

std::optional<Numbers> numbers_of(const System& system) {
  Findings findings;
  const auto op = initial_conditions(system, findings);
  if (!op) return std::nullopt;
  const auto linear = linearize(system, *op, {});
  if (!linear) return std::nullopt;
  const auto modes = eigensolve(*linear);
  if (!modes) return std::nullopt;
  Numbers n{op->velocity, op->acceleration, op->lambda, linear->A, modes->vectors, {}};
  const ModalDistribution energies(system, *linear, *modes);
  for (const auto& row : energies.strain(0)) n.strain.push_back(row.values.front());
  // Statics may fail, alike for all.
  StaticsReport report;
  StaticsOptions short_search;
  short_search.iteration_limit = 20, short_search.restarts = 0, short_search.effort_limit = 1e7;
  if (const auto rest = find_equilibrium(system, *op, short_search, report, findings))
    n.lambda.insert(n.lambda.end(), rest->lambda.begin(), rest->lambda.end());
  return n;
}

TEST(Threads, share_a_system_and_get_the_same_numbers) {
  constexpr std::size_t threads = 4;
  std::size_t compared = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    auto dataset =
        parse_dataset(std::make_shared<const SourceText>("generated.adm", dataset_text(random_mechanism(seed))));
    auto model = build_model(std::make_shared<const Dataset>(std::move(dataset.value)), catalogue());
    ASSERT_FALSE(model.diagnostics.has_errors()) << render(model.diagnostics);
    const std::shared_ptr<const System> system = System::make(std::move(model.value)).value();
    const auto alone = numbers_of(*system);
    std::array<std::optional<Numbers>, threads> together;
    {
      std::vector<std::jthread> workers;
      for (auto& result : together) workers.emplace_back([&] { result = numbers_of(*system); });
    }
    for (const auto& result : together) {
      ASSERT_EQ(result.has_value(), alone.has_value());
      if (alone) {
        EXPECT_TRUE(*result == *alone);
      }
    }
    compared += alone.has_value();
  }
  EXPECT_GE(compared, 6u);
}

}  // namespace
}  // namespace dynalin::oracle::threads_test
