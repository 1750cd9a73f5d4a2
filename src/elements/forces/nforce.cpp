// NFORCE/id, IMARKERS=, J=, KMATRIX= [, CMATRIX= | CRATIO=] [, LENGTH=] [, FORCE=]
//
// A linear force among n markers as seen from J: with Y the 6 n displacements (DX, DY, DZ, AX, AY, AZ)(I_k, J) in the
// axes of J and Y′ their velocities,
//
//     (F_1, T_1, …, F_n, T_n) = FORCE − K (Y − LENGTH) − C Y′
//
// acts on the markers I_k, and on J's body what balances it: the opposite of each at the origin of I_k. K and C are
// MATRIX statements of 6 n × 6 n, LENGTH and FORCE of 6 n × 1.
#include <fmt/format.h>

#include "elements/controls/matrix.h"
#include "elements/families/linear_wrench.h"

namespace dynalin {

namespace {

struct Nforce {
  std::vector<std::int64_t> ids;
  MarkerId j;
  MatrixRef stiffness, damping, length, force;
  std::optional<double> ratio;
  UserSubroutine function{"NFOSUB"};
  std::vector<MarkerId> markers;

  static constexpr std::array<Argument<Nforce>, 8> arguments = {{
      {.name = "IMARKERS", .slot = &Nforce::ids, .required = true, .help = "the markers that the forces act on"},
      {.name = "J",
       .slot = &Nforce::j,
       .required = true,
       .help = "marker whose body balances them, and whose axes count"},
      {.name = "KMATRIX", .slot = &Nforce::stiffness, .help = "MATRIX of 6 n × 6 n: stiffness"},
      {.name = "CMATRIX", .slot = &Nforce::damping, .help = "MATRIX of 6 n × 6 n: damping"},
      {.name = "CRATIO", .slot = &Nforce::ratio, .unit = "time", .help = "damping as part of the stiffness"},
      {.name = "LENGTH", .slot = &Nforce::length, .help = "MATRIX of 6 n × 1: displacements at which FORCE acts"},
      {.name = "FORCE", .slot = &Nforce::force, .help = "MATRIX of 6 n × 1"},
      {.name = "FUNCTION", .slot = &Nforce::function, .help = "USER(…): not available"},
  }};
};

// Dense 6 n × 6 n tables, by columns.
struct Law {
  std::vector<MarkerId> markers;
  MarkerId j;
  std::size_t size = 0;
  std::vector<double> K, C, length, force;
};

class NforceKernel final : public Kernel {
 public:
  NforceKernel(const std::vector<Law>& laws, Layout& layout) {
    for (const Law& law : laws) {
      Placed p{law, {}, layout.marker(law.j), {}};
      for (const MarkerId m : law.markers) {
        p.I.push_back(layout.marker(m));
        p.memory.push_back(layout.add_memory());
        layout.add_memory();
        layout.add_memory();
      }
      laws_.push_back(std::move(p));
    }
  }

  void equations(const Motion& motion, Equations& eq) const override {
    for (const Placed& p : laws_) {
      const std::size_t n = p.I.size();
      pairs_.resize(n), displacements_.resize(n);
      for (std::size_t k = 0; k < n; ++k) {
        pairs_[k] = pair_motion(motion, p.I[k], p.J);
        displacements_[k] = relative_displacement(
            pairs_[k], std::span(motion.memory).subspan(static_cast<std::size_t>(p.memory[k]), 3));
      }
      for (std::size_t k = 0; k < n; ++k) {
        RelativeWrench total;
        for (std::size_t r = 0; r < 6; ++r) {
          double sum = p.law.force[6 * k + r];
          for (std::size_t l = 0; l < n; ++l) {
            for (std::size_t c = 0; c < 6; ++c) {
              const auto [K, C] = entry(p.law, 6 * k + r, 6 * l + c);
              sum -= K * (displacements_[l].y[c] - p.law.length[6 * l + c]) + C * displacements_[l].rate[c];
            }
          }
          (r < 3 ? total.force[r] : total.torque[r - 3]) = sum;
        }
        // The force itself turns with J and its arms move; each marker adds what its displacement changes.
        apply(pairs_[k], spread(pairs_[k], total, eq.wants_partials()), eq);
        if (!eq.wants_partials()) continue;
        for (std::size_t l = 0; l < n; ++l) {
          RelativeWrench change;
          change.depends_on_rate = true;
          for (std::size_t r = 0; r < 6; ++r) {
            for (std::size_t c = 0; c < 6; ++c) {
              const auto [K, C] = entry(p.law, 6 * k + r, 6 * l + c);
              for (std::size_t i = 0; i < 6; ++i) {
                change.on_pose[r][i] -= K * displacements_[l].on_pose[c][i] + C * displacements_[l].rate_on_pose[c][i];
                change.on_rate[r][i] -= C * displacements_[l].rate_on_rate[c][i];
              }
            }
          }
          apply_cross_partials(pairs_[k], pairs_[l], spread(pairs_[l], change, true), eq);
        }
      }
    }
  }

  void remember(const Motion& motion, Memory& memory) const override {
    for (const Placed& p : laws_) {
      for (std::size_t k = 0; k < p.I.size(); ++k) {
        const auto at = static_cast<std::size_t>(p.memory[k]);
        const auto total = total_angles(pair_motion(motion, p.I[k], p.J), std::span(memory).subspan(at, 3));
        std::copy(total.begin(), total.end(), memory.begin() + static_cast<std::ptrdiff_t>(at));
      }
    }
  }

 private:
  struct Placed {
    Law law;
    std::vector<MarkerPlace> I;
    MarkerPlace J;
    std::vector<std::int32_t> memory;
  };
  static std::pair<double, double> entry(const Law& law, std::size_t row, std::size_t column) {
    const std::size_t at = column * law.size + row;
    return {law.K[at], law.C.empty() ? 0.0 : law.C[at]};
  }
  std::vector<Placed> laws_;
  mutable std::vector<PairMotion> pairs_;
  mutable std::vector<RelativeDisplacement> displacements_;
};

class NforceSet final : public TypedSet<Nforce> {
 public:
  using TypedSet::TypedSet;

  void read(std::size_t k, ElementReader& reader) override {
    Nforce& n = elements[k];
    if (!read_arguments(n, reader)) return;
    const std::string name = reader.label().text();
    if (!n.stiffness.valid()) {
      reader.error("missing-argument", reader.statement().at, fmt::format("{} needs KMATRIX", name));
    }
    if (n.ratio && n.damping.valid()) {
      reader.error("excluded-arguments", reader.at("CRATIO"),
                   fmt::format("{} takes CMATRIX or CRATIO, not both", name));
    }
    for (const std::int64_t id : n.ids) {
      if (const auto m = reader.marker({id, reader.at("IMARKERS")}, "IMARKERS")) n.markers.push_back(*m);
    }
  }

  void finish(Model& model, Diagnostics& diagnostics) override {
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const Nforce& n = elements[k];
      Law law{n.markers, n.j, 6 * n.markers.size(), {}, {}, {}, {}};
      for (const MarkerId i : n.markers) check_pair(model, labels[k], i, n.j, {true, true, true}, diagnostics);
      const auto take = [&](MatrixRef ref, std::string_view word, std::size_t columns) {
        if (!ref.valid()) return std::vector<double>();
        const Matrix& m = *model.get<Matrix>(ref);
        if (m.rows != law.size || m.columns != columns) {
          diagnostics.error("wrong-size", labels[k].at,
                            fmt::format("{} of {} must be {} × {}, {} is {} × {}", word, labels[k].text(), law.size,
                                        columns, model.label(ref).text(), m.rows, m.columns));
          return std::vector<double>(law.size * columns, 0.0);
        }
        return m.values;
      };
      law.K = take(n.stiffness, "KMATRIX", law.size);
      law.C = take(n.damping, "CMATRIX", law.size);
      if (n.ratio) {
        law.C = law.K;
        for (double& v : law.C) v *= *n.ratio;
      }
      law.length = take(n.length, "LENGTH", 1);
      law.force = take(n.force, "FORCE", 1);
      law.length.resize(law.size, 0.0);
      law.force.resize(law.size, 0.0);
      laws_.push_back(std::move(law));
    }
  }

  std::unique_ptr<Kernel> make_kernel(const Model&, Layout& layout) const override {
    return std::make_unique<NforceKernel>(laws_, layout);
  }

 private:
  std::vector<Law> laws_;
};

}  // namespace

extern constinit const Kind nforce = {
    "NFORCE",
    "",
    "Linear force among several markers as seen from one.",
    Kind::Role::element,
    detail::argument_infos<Nforce>,
    [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<NforceSet>(kind); }};

}  // namespace dynalin
