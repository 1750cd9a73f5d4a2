// The program's tables of strain energy and dissipated power against the work of the oracle's forces by differences, on
// generated mechanisms and for every kind of element that has rows.
#include "oracle/energy_rows.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "eigenvalues/eigen.h"
#include "elements/catalogue.h"
#include "modal/modal_distribution.h"
#include "oracle/program_point.h"
#include "places/draws.h"

namespace dynalin::oracle::energy_rows_test {
namespace {

// What was compared, over many mechanisms.
struct Seen {
  std::set<std::string> kinds;  // with a share of more than a thousandth: "SFORCE ROTATIONAL strain"
  int tables = 0, left_out = 0;
};

// A sum that nearly cancels makes percentages of nothing.
constexpr double cancelled = 1e-5;
// Work that is rounding of extended precision, beside the square of the motion: there is nothing to share out.
constexpr double nothing = 1e-15;

std::string kind_of(const EnergyRow& row) {
  if (row.statement != "SFORCE" && row.statement != "SPRINGDAMPER") return row.statement;
  return row.statement + (row.shows_force ? " TRANSLATIONAL" : " ROTATIONAL");
}
std::string key_of(const std::string& kind, Energy energy) {
  return kind + (energy == Energy::strain ? " strain" : " dissipation");
}

void expect_rows(const std::vector<ModalRow<double>>& ours, const std::vector<EnergyRow>& theirs, Energy energy,
                 double motion, Seen& seen) {
  ASSERT_EQ(ours.size(), theirs.size());
  double total = 0, parts = 0, size = 0;
  for (const EnergyRow& row : theirs) {
    for (const double v : row.along) total += v, parts += std::abs(v);
    size += row.without_cancellation;
  }
  if (parts <= nothing * motion) return;
  if (parts <= 1e-9 * size || std::abs(total) <= cancelled * parts) {
    ++seen.left_out;
    if (parts > 1e-13 * size) return;
    for (const ModalRow<double>& row : ours) {  // no shares of rounding
      for (const double v : row.values) EXPECT_TRUE(std::isnan(v) || v == 0) << row.element->text() << " " << v;
    }
    return;
  }
  ++seen.tables;
  std::vector<bool> found(ours.size(), false);
  std::string_view before;
  for (std::size_t k = 0; k < ours.size(); ++k) {
    const ElementLabel& label = *ours[k].element;
    SCOPED_TRACE(label.text());
    EXPECT_LE(before, label.statement);
    before = label.statement;
    std::size_t at = 0;
    while (at < theirs.size() && (found[at] || theirs[at].statement != label.statement || theirs[at].id != label.id ||
                                  theirs[at].marker != ours[k].part))
      ++at;
    ASSERT_LT(at, theirs.size()) << "marker " << ours[k].part;
    found[at] = true;
    const EnergyRow& row = theirs[at];
    double sum = 0, error = 0;
    ASSERT_EQ(ours[k].values.size(), 7u);
    for (std::size_t c = 0; c < 6; ++c) {
      const double share = 100 * row.along[c] / total, doubt = 100 * std::abs(row.error[c] / total);
      const double room = 1e-8 * std::max(100.0, 100 * parts / std::abs(total)) + 10 * doubt;
      sum += share, error += room;
      const double value = ours[k].values[1 + c];
      EXPECT_EQ(std::isnan(value), !(c < 3 ? row.shows_force : row.shows_torque)) << c;
      if (std::isnan(value)) continue;
      EXPECT_NEAR(value, share, room) << c;
    }
    EXPECT_NEAR(ours[k].values[0], sum, error);
    if (std::abs(sum) > 0.1) seen.kinds.insert(key_of(kind_of(row), energy));
  }
}

// Whether anything sees the point of contact of a curve or the reaction there. The program has the curve's parameter
// for a coordinate of its own, the oracle does not: with multipliers and rates held they mean different things.
bool sees_contacts(const Mechanism& m) {
  std::set<int> touching;
  for (const Contact& c : m.contacts) touching.insert({c.i, c.ifloat, c.jfloat});
  bool found = false;
  const auto look = [&](const Expr& e) {
    if (!e.node) return;
    walk(e, [&](const Node& n) {
      const bool names_one =
          std::any_of(n.ids.begin(), n.ids.end(), [&](int id) { return id != 0 && touching.count(id) > 0; });
      found = found || n.op == Op::contact || ((n.op == Op::measure || n.op == Op::marker_force) && names_one);
    });
  };
  for (const Variable& v : m.variables) look(v.function);
  for (const Sforce& s : m.sforces) look(s.function);
  for (const GeneralForce& f : m.gforces) {
    for (const auto& e : f.component) look(e.value_or(Expr{}));
  }
  for (const Diff& d : m.diffs) look(d.function), look(d.coefficient);
  return found;
}

class EnergyRows : public ::testing::TestWithParam<std::uint64_t> {};

void compare(std::uint64_t seed, Seen& seen) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  const Mechanism mechanism = random_mechanism(seed);
  if (sees_contacts(mechanism)) return;
  auto dataset = parse_dataset(std::make_shared<const SourceText>("generated.adm", dataset_text(mechanism)));
  auto model = build_model(std::make_shared<const Dataset>(std::move(dataset.value)), catalogue());
  ASSERT_FALSE(model.diagnostics.has_errors()) << render(model.diagnostics);
  const auto made = System::make(std::move(model.value)).value();
  const System& system = *made;
  Findings findings;
  const auto op = initial_conditions(system, findings);
  ASSERT_TRUE(op) << op.error().message;
  const auto linear = linearize(system, *op, {});
  ASSERT_TRUE(linear) << linear.error().message;
  const auto modes = eigensolve(*linear);
  ASSERT_TRUE(modes) << modes.error().message;
  std::vector<ChosenState> states;
  for (const StateLabel& label : linear->model.states) states.push_back(chosen(label, mechanism));
  const ModalDistribution energies(system, *linear, *modes);
  const OraclePoint point = point_of(system, *op);
  const std::size_t count = modes->modes.size();
  for (const std::size_t mode : std::set<std::size_t>{0, count / 2, count - 1}) {
    if (mode >= count) continue;
    SCOPED_TRACE("mode " + std::to_string(mode + 1));
    Eigen::VectorXcd z = modes->vectors.col(static_cast<Eigen::Index>(mode));
    const std::vector<std::complex<double>> entries(z.begin(), z.end());
    for (const Energy energy : {Energy::strain, Energy::dissipation}) {
      SCOPED_TRACE(energy == Energy::strain ? "strain" : "dissipation");
      const auto rows = energy == Energy::strain ? energies.strain(mode) : energies.dissipation(mode);
      // Velocities of an eigenvalue that is zero as far as it is known may be rounding, and have no rows then.
      const EigenMode& m = modes->modes[mode];
      const bool may_rest = energy == Energy::dissipation && std::abs(m.eigenvalue_hz) <= m.error_bound_hz;
      if (may_rest && std::ranges::all_of(rows, [](const auto& row) { return row.values[0] == 0; })) continue;
      double motion = 0;
      for (std::size_t k = 0; k < states.size(); ++k) {
        const auto kind = energy == Energy::strain ? ChosenState::Kind::coordinate : ChosenState::Kind::rate;
        if (states[k].kind == kind) motion += std::norm(entries[k]);
      }
      expect_rows(rows, energy_rows(mechanism, point, states, entries, energy), energy, motion, seen);
    }
  }
}

TEST_P(EnergyRows, equal_the_work_of_forces_by_differences) {
  Seen seen;
  for (const std::uint64_t seed : drawn_seeds(GetParam(), GetParam() + 29)) {
    compare(seed, seen);
    ASSERT_FALSE(::testing::Test::HasFailure());
  }
  EXPECT_GT(seen.tables, 5 * seen.left_out) << seen.tables;
}
INSTANTIATE_TEST_SUITE_P(generated, EnergyRows, ::testing::Range<std::uint64_t>(1, 241, 30));

// Seeds with a journal bearing each.
TEST(JournalEnergyRows, equal_the_work_of_forces_by_differences) {
  Seen seen;
  for (std::uint64_t seed = 321; seed < 323; ++seed) compare(seed, seen);
  for (const Energy energy : {Energy::strain, Energy::dissipation})
    EXPECT_TRUE(seen.kinds.count(key_of("JOURNAL", energy)) > 0);
}

TEST(FlexibleEnergyRows, equal_the_work_of_forces_by_differences) {
  Seen seen;
  for (std::uint64_t seed = 271; seed <= 280; ++seed) compare(seed, seen);
  for (const Energy energy : {Energy::strain, Energy::dissipation})
    EXPECT_TRUE(seen.kinds.count(key_of("FLEX_BODY", energy)) > 0);
}

// Each in both tables, with a share that is not nothing.
TEST(EnergyRowKinds, are_all_compared) {
  std::set<std::string> missing;
  for (const dynalin::Kind* kind : catalogue()) {
    if (kind->energy_rows == dynalin::Kind::EnergyRows::none) continue;
    if (kind->statement == "FLEX_BODY" || kind->statement == "JOURNAL") continue;  // above
    const std::string name =
        std::string(kind->statement) + (kind->variant.empty() ? "" : " ") + std::string(kind->variant);
    for (const Energy energy : {Energy::strain, Energy::dissipation}) missing.insert(key_of(name, energy));
  }
  EXPECT_EQ(missing.size(), 28u) << "BEAM, BUSHING, CABLE, CONTACT, FIELD, FRICTION, GFORCE, NFORCE, VFORCE, VTORQUE, "
                                    "two each of SFORCE and SPRINGDAMPER";
  for (std::uint64_t seed = 1; seed <= 240 && !missing.empty(); ++seed) {
    // Only mechanisms that hold one of those.
    const std::string text = dataset_text(random_mechanism(seed));
    if (std::none_of(missing.begin(), missing.end(), [&](const std::string& key) {
          return text.find("\n" + key.substr(0, key.find(' ')) + "/") != std::string::npos;
        }))
      continue;
    Seen seen;
    compare(seed, seen);
    for (const std::string& key : seen.kinds) missing.erase(key);
  }
  for (const std::string& key : missing) ADD_FAILURE() << key;
}

}  // namespace
}  // namespace dynalin::oracle::energy_rows_test
