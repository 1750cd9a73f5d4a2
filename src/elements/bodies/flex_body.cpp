// FLEX_BODY/id, {MNF_FILE= | MATRICES=} [, QG=, {REULER= | ZG=, XG=}, VX= … WZ=, VM=, WM=, EXACT=, CRATIO=,
// GENERALIZED_DAMPING=, DMODE=, VMODE=, MODAL_EXACT_DISP=, MODAL_EXACT_VEL=, INVARIANTS=, CHAR_LEN=, REPRESENTATION=]
//
// An elastic body by its modes: it moves as a whole with its BCS and deforms by the modal coordinates q, of which the
// file, or MATRIX statements, have shapes, generalized mass and stiffness. Deflections are small, motions of the whole
// are not. Velocities are those of the BCS, along the axes of VM (global) and WM (its own).
#include "elements/bodies/flex_body.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numbers>

#include "dataset/characters.h"
#include "elements/bodies/flex_body_file.h"
#include "elements/bodies/modal_ratio.h"
#include "elements/controls/matrix.h"
#include "elements/families/flexible_body.h"
#include "elements/families/orientation.h"
#include "elements/settings/time_unit.h"
#include "flexible/modal_matrices.h"
#include "model/schema.h"

namespace dynalin {

namespace {

struct FlexBody {
  std::string file, database, deck;
  std::vector<std::int64_t> matrices;
  std::optional<std::int64_t> index_in_database;
  Vector origin;
  std::optional<Vector> angles, z_point, x_point;
  std::optional<double> vx, vy, vz, wx, wy, wz;
  MarkerId vm, wm;
  std::vector<std::string> exact;
  std::string ratio, generalized_damping, representation;
  std::vector<double> displacements, rates;
  std::vector<std::int64_t> held_displacements, held_rates;
  std::vector<std::string> invariants;
  std::optional<double> dynamic_limit, stability_factor;
  double length = 0;
  Matrix3 axes = Matrix3::identity();
  std::vector<ElementHandle> data;  // the MATRIX statements
  // Where arguments stand that are looked at when the modes are known, and the expression of CRATIO, whose frequencies
  // are known when the units are.
  Span matrices_at, displacements_at, rates_at, held_displacements_at, held_rates_at, damping_at, invariants_at,
      ratio_at;
  bool adds_generalized_damping = false;
  std::shared_ptr<ModalBody> flexible;

  static constexpr std::array<Argument<FlexBody>, 29> arguments = {{
      {.name = "MNF_FILE",
       .slot = &FlexBody::file,
       .help = "modal body file: text of nodes, shapes, generalized mass and stiffness",
       .ends = "MATRICES"},
      {.name = "MATRICES",
       .slot = &FlexBody::matrices,
       .help = "MATRIX statements that hold the body, each by its NAME",
       .ends = "MNF_FILE"},
      {.name = "DB_FILE", .slot = &FlexBody::database, .help = "database of bodies: not available"},
      {.name = "INDEX_IN_DB", .slot = &FlexBody::index_in_database, .help = "which of DB_FILE: not available"},
      {.name = "BDF_FILE", .slot = &FlexBody::deck, .help = "nonlinear body: not available"},
      {.name = "QG",
       .slot = &FlexBody::origin,
       .unit = unit::length,
       .help = "origin of the BCS",
       .start = StatedStart::place},
      {.name = "REULER",
       .slot = &FlexBody::angles,
       .unit = unit::angle,
       .help = "3-1-3 angles of the BCS",
       .ends = "ZG XG",
       .start = StatedStart::place},
      {.name = "ZG",
       .slot = &FlexBody::z_point,
       .unit = unit::length,
       .help = "global point on +z of the BCS",
       .ends = "REULER",
       .start = StatedStart::place},
      {.name = "XG",
       .slot = &FlexBody::x_point,
       .unit = unit::length,
       .help = "global point in the x-z plane",
       .ends = "REULER",
       .start = StatedStart::place},
      {.name = "VX",
       .slot = &FlexBody::vx,
       .unit = unit::velocity,
       .help = "initial velocity of the BCS",
       .start = StatedStart::velocity},
      {.name = "VY",
       .slot = &FlexBody::vy,
       .unit = unit::velocity,
       .help = "the same along y",
       .start = StatedStart::velocity},
      {.name = "VZ",
       .slot = &FlexBody::vz,
       .unit = unit::velocity,
       .help = "the same along z",
       .start = StatedStart::velocity},
      {.name = "WX",
       .slot = &FlexBody::wx,
       .unit = unit::angular_velocity,
       .help = "initial angular velocity",
       .start = StatedStart::velocity},
      {.name = "WY",
       .slot = &FlexBody::wy,
       .unit = unit::angular_velocity,
       .help = "the same about y",
       .start = StatedStart::velocity},
      {.name = "WZ",
       .slot = &FlexBody::wz,
       .unit = unit::angular_velocity,
       .help = "the same about z",
       .start = StatedStart::velocity},
      {.name = "VM",
       .slot = &FlexBody::vm,
       .help = "axes of VX, VY, VZ; global by default",
       .start = StatedStart::velocity},
      {.name = "WM",
       .slot = &FlexBody::wm,
       .help = "axes of WX, WY, WZ; those of the BCS by default",
       .start = StatedStart::velocity},
      {.name = "EXACT", .slot = &FlexBody::exact, .help = "coordinates the assembly should keep: X:Y:Z:PSI:THETA:PHI"},
      {.name = "CRATIO",
       .slot = &FlexBody::ratio,
       .help = "damping of each mode in parts of the critical, an expression in FXFREQ (cycles/s) and FXMODE; 0.01 "
               "below 100 cycles/s, 0.1 below 1000 and 1 above by default"},
      {.name = "GENERALIZED_DAMPING",
       .slot = &FlexBody::generalized_damping,
       .help = "FULL or INTERNAL_ONLY adds the damping matrix of the file, OFF (default) does not"},
      {.name = "DMODE",
       .slot = &FlexBody::displacements,
       .help = "modal coordinates at the start; those of the file by default",
       .start = StatedStart::place},
      {.name = "VMODE",
       .slot = &FlexBody::rates,
       .help = "their rates at the start; those of the file by default",
       .start = StatedStart::velocity},
      {.name = "MODAL_EXACT_DISP", .slot = &FlexBody::held_displacements, .help = "modes that keep DMODE"},
      {.name = "MODAL_EXACT_VEL", .slot = &FlexBody::held_rates, .help = "modes that keep VMODE"},
      {.name = "INVARIANTS",
       .slot = &FlexBody::invariants,
       .help = "nine times T or F: which inertia invariants count; all by default"},
      {.name = "DYNAMIC_LIMIT", .slot = &FlexBody::dynamic_limit, .help = "modes without mass: not available"},
      {.name = "STABILITY_FACTOR", .slot = &FlexBody::stability_factor, .help = "their damping: not available"},
      {.name = "CHAR_LEN",
       .slot = &FlexBody::length,
       .unit = unit::length,
       .minimum = 0,
       .help = "length of the body, beside which it is bent little; of its nodes where it is not stated"},
      {.name = "REPRESENTATION", .slot = &FlexBody::representation, .help = "MODAL; nothing else is available"},
  }};
};

constexpr std::array<std::string_view, 6> pose_names = {"X", "Y", "Z", "PSI", "THETA", "PHI"};

class FlexBodySet final : public TypedSet<FlexBody> {
 public:
  using TypedSet::TypedSet;

  void read(std::size_t k, ElementReader& reader) override {
    FlexBody& f = elements[k];
    if (!read_arguments(f, reader)) return;
    const std::string name = reader.label().text();
    for (const std::string_view word : {"DB_FILE", "INDEX_IN_DB", "BDF_FILE", "DYNAMIC_LIMIT", "STABILITY_FACTOR"}) {
      if (!reader.given(word)) continue;
      reader.error(
          "argument-not-built", reader.at(word), fmt::format("{} of {} is not available", word, name),
          word == "DYNAMIC_LIMIT" || word == "STABILITY_FACTOR" ? "" : "MNF_FILE= names a modal text file (.fem)");
      return;
    }
    if (!f.file.empty() && !f.matrices.empty()) {
      reader.error("excluded-arguments", reader.at("MATRICES"),
                   fmt::format("{} takes its data from MNF_FILE or from MATRICES, not from both", name));
      return;
    }
    if (f.file.empty() && f.matrices.empty()) {
      reader.error("missing-argument", reader.statement().at, fmt::format("{} needs MNF_FILE or MATRICES", name));
      return;
    }
    if (!f.representation.empty() && !equal_ignoring_case(f.representation, "MODAL")) {
      reader.error("argument-not-built", reader.at("REPRESENTATION"),
                   fmt::format("REPRESENTATION={} of {} is not available", f.representation, name));
    }
    for (const std::string& word : f.exact) {
      if (!find_keyword(word, pose_names)) {
        reader.error("unknown-word", reader.at("EXACT"), fmt::format("EXACT has no coordinate {}", word),
                     "one of X, Y, Z, PSI, THETA, PHI");
      }
    }
    const auto axes = orientation({f.angles, f.z_point, f.x_point, false, "REULER", "ZG", "XG"}, f.origin, reader);
    if (axes) f.axes = *axes;
    for (const auto& [word, at] : {std::pair{"MATRICES", &f.matrices_at},
                                   {"DMODE", &f.displacements_at},
                                   {"VMODE", &f.rates_at},
                                   {"MODAL_EXACT_DISP", &f.held_displacements_at},
                                   {"MODAL_EXACT_VEL", &f.held_rates_at},
                                   {"GENERALIZED_DAMPING", &f.damping_at},
                                   {"INVARIANTS", &f.invariants_at}}) {
      if (reader.given(word)) *at = reader.at(word);
    }
    read_damping(f, reader);
    for (const std::int64_t id : f.matrices) {
      if (const auto matrix = reader.element("MATRIX", {id, f.matrices_at})) f.data.push_back(*matrix);
    }
    if (!f.matrices.empty()) return;
    f.flexible = read_body_file(f.file, reader);
    if (f.flexible) use_modes(f, reader.label().text(), reader.diagnostics());
  }

  // Other statements have been read by now; damping needs the units of the model.
  void finish(Model& model, Diagnostics& diagnostics) override {
    for (std::size_t k = 0; k < elements.size(); ++k) {
      FlexBody& f = elements[k];
      if (!f.data.empty()) f.flexible = of_matrices(f, labels[k].text(), model, diagnostics);
      if (!f.flexible) continue;
      Body& body = model.bodies[static_cast<std::size_t>(model.find_body("FLEX_BODY", labels[k].id)->index)];
      body.pose = {f.origin, f.axes};
      const ModalInertia& I = f.flexible->inertia;
      body.user_mass = I.mass;
      body.mass = I.mass / model.units.ucf;
      body.J_BC = (1 / model.units.ucf) * I.tensor;
      body.velocity = {{f.vx, f.vy, f.vz}, {f.wx, f.wy, f.wz}, f.vm.valid() ? f.vm : global_frame, f.wm};
      for (const std::string& word : f.exact) {
        if (const auto at = find_keyword(word, pose_names)) body.exact[*at] = true;
      }
      for (Eigen::Index m = 0; m < f.flexible->modes(); ++m) {
        body.modal.push_back(
            {fmt::format("Modal generalized coordinate Q{}", f.flexible->number[static_cast<std::size_t>(m)]),
             f.flexible->displacement(m), f.flexible->reach(m)});
      }
      f.flexible->lacks_inertia = lacks_inertia(I);
      f.flexible->length = f.length > 0 ? f.length : extent_of(f.flexible->position);
      set_damping(f, labels[k], model.units, diagnostics);
    }
  }

  std::unique_ptr<Kernel> make_kernel(const Model& model, Layout& layout) const override {
    return std::make_unique<FlexibleBodyKernel>(model, layout);
  }

 private:
  static std::shared_ptr<ModalBody> of_matrices(FlexBody& f, const std::string& name, const Model& model,
                                                Diagnostics& diagnostics) {
    std::vector<ModalMatrix> matrices;
    for (const ElementHandle& h : f.data) {
      const Matrix& m = *model.get<Matrix>(h);
      matrices.push_back({m.name,
                          model.label(h).text(),
                          {m.values.data(), static_cast<Eigen::Index>(m.rows), static_cast<Eigen::Index>(m.columns)}});
    }
    auto body = modal_body_of(matrices, f.matrices_at, name, diagnostics);
    if (!body) return nullptr;
    f.flexible = std::make_shared<ModalBody>(std::move(*body));
    use_modes(f, name, diagnostics);
    return f.flexible;
  }

  // What the statement says of the modes; no body is left after an error in its inertia.
  static void use_modes(FlexBody& f, const std::string& name, Diagnostics& diagnostics) {
    read_start(f, name, diagnostics);
    if (f.adds_generalized_damping && f.flexible->generalized_damping.size() == 0 && f.flexible->modes() > 0) {
      diagnostics.error("missing-argument", f.damping_at,
                        f.matrices.empty() ? fmt::format("the file of {} has no damping, RECORD GROUP 13", name)
                                           : fmt::format("{} has no damping, a MATRIX named GENDAMP", name));
    }
    read_invariants(f, diagnostics);
  }

  static void read_start(FlexBody& f, const std::string& name, Diagnostics& diagnostics) {
    ModalBody& b = *f.flexible;
    const auto count = static_cast<std::size_t>(b.modes());
    const auto take = [&](const std::vector<double>& given, std::string_view word, const Span& at,
                          Eigen::VectorXd& start) {
      if (given.empty()) return;
      if (given.size() == count) {
        start = Eigen::Map<const Eigen::VectorXd>(given.data(), b.modes());
      } else {
        diagnostics.error("wrong-count", at,
                          fmt::format("{} has {} values, {} has {} modes", word, given.size(), name, count));
      }
    };
    take(f.displacements, "DMODE", f.displacements_at, b.displacement);
    take(f.rates, "VMODE", f.rates_at, b.rate);
    const auto hold = [&](const std::vector<std::int64_t>& modes, const Span& at, std::vector<bool>& held) {
      for (const std::int64_t m : modes) {
        const auto found = std::ranges::find(b.number, m);
        if (found != b.number.end()) {
          held[static_cast<std::size_t>(found - b.number.begin())] = true;
        } else {
          diagnostics.error("value-out-of-range", at, fmt::format("{} has no mode {}", name, m));
        }
      }
    };
    hold(f.held_displacements, f.held_displacements_at, b.holds_displacement);
    hold(f.held_rates, f.held_rates_at, b.holds_rate);
  }

  static void read_damping(FlexBody& f, ElementReader& reader) {
    if (reader.given("CRATIO")) {
      const Span at = reader.at("CRATIO");
      for (const WrittenArgument& w : reader.statement().arguments) {
        if (w.name.offset == at.offset && w.name.source == at.source) f.ratio_at = w.value_span();
      }
    }
    if (f.generalized_damping.empty()) return;
    static constexpr std::array<std::string_view, 3> words = {"OFF", "FULL", "INTERNAL_ONLY"};
    const auto word = find_keyword(f.generalized_damping, words);
    if (!word) {
      reader.error("unknown-word", f.damping_at,
                   fmt::format("GENERALIZED_DAMPING is OFF, FULL or INTERNAL_ONLY, not {}", f.generalized_damping));
      return;
    }
    f.adds_generalized_damping = *word > 0;
  }

  static void read_invariants(FlexBody& f, Diagnostics& diagnostics) {
    if (f.invariants.empty()) return;
    static constexpr std::array<std::string_view, 2> words = {"TRUE", "FALSE"};
    std::array<bool, 9> which{};
    const Span& at = f.invariants_at;
    if (f.invariants.size() != which.size()) {
      diagnostics.error("wrong-count", at, fmt::format("INVARIANTS has {} values, it takes 9", f.invariants.size()));
      return;
    }
    for (std::size_t k = 0; k < which.size(); ++k) {
      const auto word = find_keyword(f.invariants[k], words);
      if (!word) {
        diagnostics.error("unknown-word", at, fmt::format("INVARIANTS is T or F nine times, not {}", f.invariants[k]));
        return;
      }
      which[k] = *word == 0;
    }
    f.flexible->inertia.keep(which);
    // What is left of modes without mass and without a share in the motion of the body is rigid: T:T:F:F:F:F:T:F:F.
    const auto of_modes = {which[2], which[3], which[4], which[5], which[7], which[8]};
    if (std::ranges::none_of(of_modes, std::identity())) f.flexible->make_rigid();
    if (!check_modal_body(*f.flexible, {at, at, at, "what INVARIANTS leaves of the body"}, diagnostics))
      f.flexible = nullptr;
  }

  void set_damping(FlexBody& f, const ElementLabel& label, const Units& units, Diagnostics& diagnostics) const {
    ModalBody& b = *f.flexible;
    if (b.modes() == 0) return;
    const OwnModes own = own_modes(b, units.ucf);
    std::vector<double> hertz, numbers;
    for (Eigen::Index k = 0; k < b.modes(); ++k) {
      hertz.push_back(own.frequency(k) / (2 * std::numbers::pi * seconds_in(units.time)));
      Eigen::Index mode = 0;
      own.shapes.col(k).cwiseProduct(own.mass.diagonal().cwiseSqrt()).cwiseAbs().maxCoeff(&mode);
      numbers.push_back(static_cast<double>(b.number[static_cast<std::size_t>(own.diagonal ? mode : k)]));
    }
    std::vector<double> ratio;
    if (f.ratio_at.source) {
      auto written = written_ratios(f.ratio_at, {label.text(), hertz, numbers}, diagnostics);
      if (!written) return;
      ratio = std::move(*written);
    } else {
      for (const double x : hertz) ratio.push_back(default_ratio(x));
    }
    b.damping = modal_damping(own, [&](Eigen::Index k) { return ratio[static_cast<std::size_t>(k)]; });
    if (f.adds_generalized_damping) b.damping += b.generalized_damping;
  }
};

}  // namespace

std::vector<FlexibleBody> flexible_bodies(const Model& model) {
  std::vector<FlexibleBody> list;
  for (const auto& set : model.sets) {
    const auto* bodies = dynamic_cast<const FlexBodySet*>(set.get());
    for (std::size_t k = 0; bodies && k < bodies->elements.size(); ++k) {
      const auto id = model.find_body("FLEX_BODY", bodies->labels[k].id);
      if (id) list.push_back({*id, bodies->elements[k].flexible.get(), 0});
    }
  }
  std::ranges::sort(list, {}, [](const FlexibleBody& f) { return f.body.index; });
  std::size_t next = 0;
  for (FlexibleBody& f : list) {
    f.first = next;
    if (f.flexible) next += static_cast<std::size_t>(f.flexible->modes());
  }
  return list;
}

std::vector<const ModalBody*> flexible_by_body(const Model& model) {
  std::vector<const ModalBody*> list(model.bodies.size(), nullptr);
  for (const FlexibleBody& f : flexible_bodies(model)) list[static_cast<std::size_t>(f.body.index)] = f.flexible;
  return list;
}

extern constinit const Kind flex_body = Kind{
    "FLEX_BODY",
    "",
    "An elastic body by its modes.",
    Kind::Role::body,
    detail::argument_infos<FlexBody>,
    [](const Kind& kind) -> std::unique_ptr<ElementSet> {
      return std::make_unique<FlexBodySet>(kind);
    }}.with_example("FLEX_BODY/2, CRATIO=0.02");

}  // namespace dynalin
