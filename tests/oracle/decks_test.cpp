// Decks of generated mechanisms have the eigenvalues of the program: as drawn, moving, in closed boxes, and at rest
// after their static solution in open ones.
#include <unistd.h>

#include <Eigen/QR>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "deck_roots.h"
#include "elements/catalogue.h"
#include "nastran/export.h"
#include "oracle/resting.h"
#include "places/draws.h"

namespace dynalin::oracle::decks_test {
namespace {

class Decks : public ::testing::TestWithParam<std::uint64_t> {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("dynalin_decks_" + std::to_string(::getpid()) + "_" + std::to_string(GetParam()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  static std::shared_ptr<const System> system_of(const Mechanism& mechanism) {
    auto dataset = parse_dataset(std::make_shared<const SourceText>("generated.adm", dataset_text(mechanism)));
    auto model = build_model(std::make_shared<const Dataset>(std::move(dataset.value)), catalogue());
    EXPECT_FALSE(model.diagnostics.has_errors()) << render(model.diagnostics);
    return System::make(std::move(model.value)).value();
  }

  // |yᵀ| U |x| of each mode, U what the entries of A are not known to one by one: a deck has its entries rounded, which
  // bounds of the program, along all that makes an entry, do not count.
  static std::vector<double> uncertain_by_entries(const LinearSystem& linear, const EigenSolution& solution) {
    const auto count = static_cast<Eigen::Index>(solution.modes.size());
    Eigen::MatrixXcd x(linear.A.rows(), 2 * count);
    Eigen::Index columns = 0;
    for (Eigen::Index k = 0; k < count; ++k) x.col(columns++) = solution.vectors.col(k);
    for (Eigen::Index k = 0; k < count; ++k) {
      if (!solution.modes[static_cast<std::size_t>(k)].is_real) x.col(columns++) = solution.vectors.col(k).conjugate();
    }
    const Eigen::MatrixXcd y = x.leftCols(columns).completeOrthogonalDecomposition().pseudoInverse();
    std::vector<double> uncertain;
    for (Eigen::Index k = 0; k < count; ++k)
      uncertain.push_back((y.row(k).cwiseAbs() * linear.uncertainty).dot(x.col(k).cwiseAbs()));
    return uncertain;
  }

  // Whether there was a linear model to compare.
  bool compare(const StudyPoint& point, nastran::Box box) const {
    const auto linear = linearized(point, {});
    if (!linear) return false;
    const auto modes = modes_of(*linear, Vectors::right);
    if (!modes) return false;
    std::vector<ExpectedRoot> expected;
    const std::vector<double> of_entries = uncertain_by_entries(linear->linear, modes->solution);
    for (std::size_t k = 0; k < modes->solution.modes.size(); ++k) {
      const EigenMode& m = modes->solution.modes[k];
      constexpr double cycle = 2 * std::numbers::pi;
      const double uncertain = 1e3 * std::max(cycle * m.error_bound_hz, of_entries[k]);
      expected.push_back({cycle * m.eigenvalue_hz, uncertain});
      if (!m.is_real) expected.push_back({cycle * std::conj(m.eigenvalue_hz), uncertain});
    }
    nastran::ExportOptions options;
    options.matrix_entry_zero_tolerance = 1e-30;
    const std::string main = (folder_ / (box == nastran::Box::open ? "open" : "closed")).string();
    const auto made = nastran::export_deck(*linear, box, options, main);
    EXPECT_TRUE(made) << made.error().message;
    if (!made) return false;
    for (const nastran::DeckFile& file : made->files) std::ofstream(file.name) << file.text;
    // In a deck bodies without mass have a little, as its remark says.
    const bool differs =
        std::ranges::any_of(made->remarks.items(), [](const auto& d) { return d.code == "export-differs"; });
    expect_roots(main + ".dat", expected, differs ? 1e-4 : 1e-8);
    return true;
  }

  static bool moves(const OperatingPoint& point) {
    const auto any = [](const std::vector<double>& values) {
      return std::ranges::any_of(values, [](double v) { return std::abs(v) > 1e-9; });
    };
    return any(point.velocity) || any(point.acceleration);
  }

  std::filesystem::path folder_;
};

TEST_P(Decks, of_generated_mechanisms_have_their_eigenvalues) {
  const auto seeds = drawn_seeds(GetParam(), std::min<std::uint64_t>(GetParam() + 29, 200));
  int closed = 0, open = 0;
  for (const std::uint64_t seed : seeds) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto moving = system_of(random_mechanism(seed));
    const auto point = initial_conditions(as_drawn(moving));
    ASSERT_TRUE(point) << point.error().message;
    closed += compare(point->point, nastran::Box::closed);

    // Nothing but its own springs holds every fourth: statics takes long, and has these in tests of its own.
    if (seed % 4 == 0) continue;
    Mechanism still = random_resting_mechanism(seed);
    hold_motions(still);
    const auto resting = system_of(still);
    StaticsOptions options;
    options.restore_velocities = false;
    options.restarts = 0, options.effort_limit *= 0.03;  // what is hard to find is for tests of statics
    const auto found = static_equilibrium(as_drawn(resting), options);
    if (!found || moves(found->point.values)) continue;
    open += compare(found->point, nastran::Box::open);
  }
  EXPECT_EQ(closed, std::ssize(seeds));
  // Some are at rest nowhere, or only with a joint turned over.
  EXPECT_GE(open, 0.4 * static_cast<double>(seeds.size()));
}
INSTANTIATE_TEST_SUITE_P(generated, Decks, ::testing::Range<std::uint64_t>(1, 201, 30));

}  // namespace
}  // namespace dynalin::oracle::decks_test
