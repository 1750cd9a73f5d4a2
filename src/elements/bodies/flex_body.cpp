// The set of all FLEX_BODY statements: what the statement says is made a body of the model.
#include "elements/bodies/flex_body.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <numbers>
#include <string_view>

#include "dataset/characters.h"
#include "elements/bodies/flex_body_file.h"
#include "elements/bodies/flex_body_statement.h"
#include "elements/bodies/modal_ratio.h"
#include "elements/controls/matrix.h"
#include "elements/families/flexible_body.h"
#include "elements/families/markers.h"
#include "elements/families/orientation.h"
#include "elements/settings/time_unit.h"
#include "flexible/modal_matrices.h"
#include "model/schema.h"
#include "model/told_beforehand.h"
#include "routine/routine_data.h"
#include "routine/statement_words.h"

namespace dynalin {

namespace {

// Of the pose and of the modes as states. Modes have numbers behind this one, their rates behind its double.
constexpr StateTypes flexible_types{StateType::flex_body, StateType::flex_body_relative, StateType::flex_body_euler};
constexpr std::int32_t modal_numbers = 1000000;
constexpr StartArguments modal_starts{"DMODE", "VMODE"};

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
    read_representation(f, reader);
    for (const std::string& word : f.exact) {
      if (!find_keyword(word, pose_names)) {
        reader.error("unknown-word", reader.at("EXACT"), fmt::format("EXACT has no coordinate {}", word),
                     "one of X, Y, Z, PSI, THETA, PHI");
      }
    }
    const auto axes = orientation({f.angles, f.z_point, f.x_point, "REULER", "ZG", "XG"}, f.origin, reader);
    if (axes) f.axes = *axes;
    for (const auto& [word, at] : {std::pair<std::string_view, Span*>{"MATRICES", &f.matrices_at},
                                   {modal_starts.displacement, &f.displacements_at},
                                   {modal_starts.velocity, &f.rates_at},
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
      check_velocity_axes(model, labels[k], f.vm, f.wm, diagnostics);
      Body& body = model.bodies[static_cast<std::size_t>(model.find_body("FLEX_BODY", labels[k].id)->index)];
      if (!f.data.empty()) f.flexible = of_matrices(f, labels[k].text(), model, diagnostics);
      if (!f.flexible) continue;
      body.pose = {f.origin, f.axes};
      const ModalInertia& I = f.flexible->inertia;
      body.user_mass = I.mass;
      body.mass = I.mass / model.units.ucf;
      body.J_BC = (1 / model.units.ucf) * I.tensor;
      body.velocity = std::make_shared<const StatedVelocity>(
          StatedVelocity{{f.vx, f.vy, f.vz}, {f.wx, f.wy, f.wz}, f.vm.valid() ? f.vm : global_frame, f.wm});
      for (const std::string& word : f.exact) {
        if (const auto at = find_keyword(word, pose_names)) body.exact[*at] = true;
      }
      BodyNature nature;
      nature.listed.role = BodyRole::shaped;
      nature.listed.states.types = flexible_types;
      nature.modal_kind = {flexible_types, ExtraRole::shape, modal_numbers, modal_starts};
      for (Eigen::Index m = 0; m < f.flexible->modes(); ++m) {
        const std::int64_t number = f.flexible->number[static_cast<std::size_t>(m)];
        nature.modal.push_back({.name = fmt::format("Modal generalized coordinate Q{}", number),
                                .initial = f.flexible->displacement(m),
                                .speed = f.flexible->reach(m),
                                .number = modal_numbers + static_cast<std::int32_t>(number)});
      }
      body.nature = std::make_shared<const BodyNature>(std::move(nature));
      f.flexible->lacks_inertia = lacks_inertia(I);
      f.flexible->length = f.length > 0 ? f.length : extent_of(f.flexible->position);
      set_damping(f, labels[k], model, diagnostics);
    }
  }

  std::unique_ptr<Kernel> make_kernel(const Model& model, Layout& layout) const override {
    return std::make_unique<FlexibleBodyKernel>(flexible_bodies(model), model, layout);
  }

 private:
  // In the order of the modal coordinates.
  static void tell_routines(RoutineData& data, const ElementLabel& label, const RatioModes& modes,
                            const ModalBody& body) {
    std::vector<std::pair<int, double>> all;
    for (std::size_t k = 0; k < modes.number.size(); ++k)
      all.emplace_back(static_cast<int>(modes.number[k]), modes.frequency[k]);
    std::ranges::sort(all);
    RoutineData::Modes& told = data.flexible_bodies[static_cast<int>(label.id)] = {};
    for (const auto& [number, frequency] : all) told.number.push_back(number), told.frequency.push_back(frequency);
    told.cases = static_cast<std::size_t>(body.loads.cols());
    told.loads.assign(body.loads.data(), body.loads.data() + body.loads.size());
  }

  static std::shared_ptr<ModalBody> of_matrices(FlexBody& f, const std::string& name, const Model& model,
                                                Diagnostics& diagnostics) {
    std::vector<ModalMatrix> matrices;
    for (const ElementHandle& h : f.data) {
      const Matrix& m = *model.get<Matrix>(h);
      matrices.push_back({m.name,
                          model.label(h).text(),
                          {m.values.data(), static_cast<Eigen::Index>(m.rows), static_cast<Eigen::Index>(m.columns)},
                          model.label(h).at,
                          [&m](Eigen::Index row, Eigen::Index column) {
                            return place_of(m, static_cast<std::size_t>(row), static_cast<std::size_t>(column));
                          }});
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
    if (f.flexible && f.is_rigid) f.flexible->make_rigid();
  }

  static void read_representation(FlexBody& f, ElementReader& reader) {
    if (f.representation.empty()) return;
    static constexpr std::array<std::string_view, 3> words = {"MODAL", "RIGID", "NFORCE"};
    const auto word = find_keyword(f.representation, words);
    if (!word) {
      reader.error("unknown-word", reader.at("REPRESENTATION"),
                   fmt::format("REPRESENTATION is MODAL or RIGID, not {}", f.representation));
    } else if (*word == 2) {
      reader.error("argument-not-built", reader.at("REPRESENTATION"),
                   fmt::format("REPRESENTATION=NFORCE of {} is not available", reader.label().text()),
                   "MODAL, or RIGID: the body without its modes");
    } else {
      f.is_rigid = *word == 1;
    }
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
    take(f.displacements, modal_starts.displacement, f.displacements_at, b.displacement);
    take(f.rates, modal_starts.velocity, f.rates_at, b.rate);
    const auto hold = [&](const std::vector<std::int64_t>& modes, std::string_view word, const Span& at,
                          std::vector<bool>& held) {
      for (const std::int64_t m : modes) {
        const auto found = std::ranges::find(b.number, m);
        if (found == b.number.end()) {
          diagnostics.error("value-out-of-range", at, fmt::format("{} has no mode {}", name, m));
          continue;
        }
        const auto mode = static_cast<std::size_t>(found - b.number.begin());
        if (held[mode])
          diagnostics.error("duplicate-argument", at, fmt::format("{} of {} lists mode {} twice", word, name, m));
        held[mode] = true;
      }
    };
    hold(f.held_displacements, "MODAL_EXACT_DISP", f.held_displacements_at, b.holds_displacement);
    hold(f.held_rates, "MODAL_EXACT_VEL", f.held_rates_at, b.holds_rate);
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
    if (!check_modal_body(*f.flexible, {at, at, at, at, "what INVARIANTS leaves of the body", {}}, diagnostics))
      f.flexible = nullptr;
  }

  // What holds where CRATIO is not written, or what it says; nothing after an error.
  static std::optional<std::vector<double>> ratios(const FlexBody& f, const ElementLabel& label,
                                                   const RatioModes& modes, const Model& model, Diagnostics& out) {
    if (f.ratio_at.source) return written_ratios(f.ratio_at, modes, out);
    std::vector<double> ratio;
    for (const double hertz : modes.frequency) ratio.push_back(default_ratio(hertz));
    if (!model.routine_data) return ratio;
    const auto called = model.routine_data->damping.find(static_cast<int>(label.id));
    if (called != model.routine_data->damping.end() && !called_ratios(*called->second, label, modes, ratio, out))
      return std::nullopt;
    return ratio;
  }

  void set_damping(FlexBody& f, const ElementLabel& label, const Model& model, Diagnostics& diagnostics) const {
    ModalBody& b = *f.flexible;
    RatioModes modes{label.text(), {}, {}};
    if (b.modes() == 0) {
      if (model.routine_data) tell_routines(*model.routine_data, label, modes, b);
      return;
    }
    const OwnModes own = own_modes(b, model.units.ucf);
    // Coupled coordinates are no modes: their numbers in turn are given to those that the body has.
    std::vector<std::int64_t> number = b.number;
    if (own.coordinate.empty()) std::ranges::sort(number);
    for (Eigen::Index k = 0; k < b.modes(); ++k) {
      modes.frequency.push_back(own.frequency(k) / (2 * std::numbers::pi * seconds_in(model.units.time)));
      const auto at = static_cast<std::size_t>(k);
      const std::size_t mode = own.coordinate.empty() ? at : static_cast<std::size_t>(own.coordinate[at]);
      modes.number.push_back(static_cast<double>(number[mode]));
    }
    if (model.routine_data) tell_routines(*model.routine_data, label, modes, b);
    const auto ratio = ratios(f, label, modes, model, diagnostics);
    if (!ratio) return;
    b.damping = modal_damping(own, [&](Eigen::Index k) { return (*ratio)[static_cast<std::size_t>(k)]; });
    if (!f.adds_generalized_damping || b.generalized_damping.size() == 0) return;  // an error by now
    b.damping += b.generalized_damping;
    if (const std::string fed = b.fed_modes(); !fed.empty()) {
      diagnostics.warning("body-damping", f.damping_at,
                          fmt::format("the damping of {} feeds energy into {}", label.text(), fed),
                          fmt::format("{} has negative eigenvalues beyond the damping of CRATIO",
                                      f.matrices.empty() ? "RECORD GROUP 13 of its file" : "its MATRIX named GENDAMP"));
    }
  }
};

constexpr std::array<RoutineKind, 1> routines_of_flex_body = {
    {{.routine = "dmpsub", .values = 0, .arguments = RoutineArguments::damping, .argument = "CRATIO"}}};

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

namespace {

// A routine may give the damping, and nothing moves yet.
constexpr std::array<std::string_view, 3> not_for_modes = {"CRATIO", "VM", "WM"};
constexpr ToldBeforehand told_of_flex_body = {
    .data = [](const StatementWords& s, RoutineData& data) { data.flexible_bodies[s.id()]; },
    .has_modes = true,
    .makes_modes = true,
    .not_for_modes = not_for_modes};

}  // namespace

extern constinit const Kind flex_body =
    Kind{"FLEX_BODY",
         "",
         "An elastic body by its modes.",
         Kind::Role::body,
         detail::argument_infos<FlexBody>,
         [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<FlexBodySet>(kind); }}
        .calling(routines_of_flex_body)
        .telling(told_of_flex_body)
        .with_example("FLEX_BODY/2, CRATIO=0.02");

}  // namespace dynalin
