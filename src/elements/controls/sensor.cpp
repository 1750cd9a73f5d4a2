// SENSOR/id, FUNCTION= [, VALUE=] [, EQ | GE | LE] [, ERROR=] [, ANGULAR] [, EVALUATE=] [, HALT] [, RETURN] …
//
// Watches an expression f over time and acts on the simulation when it meets VALUE:
//
//     GE   f − VALUE becomes 0 upwards        EQ   f − VALUE becomes 0 either way        LE   downwards
//
// ANGULAR: f is an angle, and VALUE with any number of whole turns is met. The instant is located to rounding. ERROR
// says what counts as met where a simulation begins, and how far f leaves VALUE before the sensor is ready to trigger
// again; passing VALUE the other way makes it ready as well. A function that comes within ERROR of VALUE and turns back
// before it has passed it has met it where it leaves. SENVAL(id) reads what EVALUATE gave when the sensor last
// triggered, and 0 before that; it is remembered from one simulation to the next, as is whether the sensor is ready.
// Sensors watch dynamics and kinematics; no statics, no linear model.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mechanics/bound_expression.h"
#include "mechanics/event_source.h"
#include "model/schema.h"
#include "routine/statement_words.h"

namespace dynalin {

namespace {

struct Sensor {
  Expression function, evaluate;
  double value = 0, error = 1e-3;
  bool eq = false, ge = false, le = false, angular = false;
  bool halt = false, returns = false, restart = false, codgen = false, print = false, yydump = false;
  std::optional<double> dt, step_size, time_error;
  bool search = false;
  Obsolete text;
  bool evaluates = false;  // EVALUATE is given

  using E = Sensor;
  static constexpr std::array<Argument<E>, 22> arguments = {{
      {.name = "FUNCTION", .slot = &E::function, .required = true, .help = "what is watched"},
      {.name = "VALUE", .slot = &E::value, .help = "at which it triggers"},
      {.name = "EQ", .slot = &E::eq, .help = "triggers where FUNCTION passes VALUE (default)", .ends = "GE LE"},
      {.name = "GE", .slot = &E::ge, .help = "where it comes to VALUE from below", .ends = "EQ LE"},
      {.name = "LE", .slot = &E::le, .help = "where it comes to VALUE from above", .ends = "EQ GE"},
      {.name = "ERROR",
       .slot = &E::error,
       .minimum = 0,
       .help = "how near to VALUE is near enough at the start, and where FUNCTION turns back"},
      {.name = "TIME_ERROR", .slot = &E::time_error, .unit = "time", .minimum = 0, .help = "no effect: found exactly"},
      {.name = "ANGULAR", .slot = &E::angular, .help = "FUNCTION is an angle: whole turns do not count"},
      {.name = "BISECTION", .slot = &E::search, .help = "no effect: how the instant is searched for"},
      {.name = "INTERPOLATION", .slot = &E::search, .help = "no effect: the same"},
      {.name = "EVALUATE", .slot = &E::evaluate, .help = "what SENVAL reads after it triggered"},
      {.name = "HALT", .slot = &E::halt, .help = "ends the run"},
      {.name = "RETURN", .slot = &E::returns, .help = "ends the simulation"},
      {.name = "RESTART", .slot = &E::restart, .help = "begins the integration anew"},
      {.name = "CODGEN", .slot = &E::codgen, .help = "factors the Jacobian anew"},
      {.name = "PRINT", .slot = &E::print, .help = "writes a step of output"},
      {.name = "YYDUMP", .slot = &E::yydump, .help = "writes all values into the message file"},
      {.name = "DT", .slot = &E::dt, .unit = "time", .help = "time between outputs from then on"},
      {.name = "STEPSIZE", .slot = &E::step_size, .unit = "time", .help = "next step of the integration"},
      {.name = "LABEL", .slot = &E::text, .help = "a name"},
      {.name = "ROUTINE", .slot = &E::text, .help = "of a compiled FUNCTION"},
      {.name = "EVALUATE_ROUTINE", .slot = &E::text, .help = "of a compiled EVALUATE"},
  }};

  int direction() const { return ge ? 1 : le ? -1 : 0; }
};

class SensorKernel final : public Kernel, public EventSource {
 public:
  SensorKernel(const std::vector<Sensor>& sensors, const std::vector<ElementLabel>& labels) {
    for (std::size_t k = 0; k < sensors.size(); ++k) watches_.push_back({&sensors[k], &labels[k], {}, {}});
  }

  void bind(Binder& binder) override {
    for (Watch& w : watches_) {
      w.function = BoundExpression(w.sensor->function, binder, Binding::observation);
      w.evaluate = BoundExpression(w.sensor->evaluate, binder, Binding::observation);
      w.value_kept = binder.sensor_value(w.label->id);
      w.state_kept = binder.add_memory(*w.label, "state", ready);
    }
  }
  void remember(const Motion& motion, Memory& memory) const override {
    ExpressionScratch scratch;
    for (const Watch& w : watches_) {
      double& state = memory[static_cast<std::size_t>(w.state_kept)];
      // What is near is left by an event.
      if (state != ready && state != near && w.is_past(w.distance(motion, scratch))) state = ready;
    }
  }

  // What has no value triggers nothing, and would do so in silence.
  std::string domain_violation(const Motion& motion) const override {
    if (motion.mode != AnalysisMode::dynamics && motion.mode != AnalysisMode::kinematics &&
        motion.mode != AnalysisMode::quasi_statics)
      return {};
    UndefinedValues undefined;
    for (const Watch& w : watches_) {
      w.function.find_undefined(motion, *w.label, undefined);
      // What it left behind when it triggered.
      if (!w.sensor->evaluates || std::isfinite(motion.memory[static_cast<std::size_t>(w.value_kept)])) continue;
      w.evaluate.find_undefined(motion, *w.label, undefined);
      undefined.add(UndefinedValue{
          w.label, fmt::format("EVALUATE of {} had no finite value when it triggered", w.label->full_text()), true});
    }
    const auto found = std::ranges::find_if(undefined.values(), &UndefinedValue::in_value);
    return found == undefined.values().end() ? std::string() : found->reason;
  }

  const EventSource* events() const override { return this; }
  // Of each VALUE, and the ends of what is near to it.
  std::size_t event_count() const override { return 3 * watches_.size(); }
  void crossings(const Motion& motion, ExpressionScratch& scratch, SwitchList& out) const override {
    for (const Watch& w : watches_) {
      const double g = w.function.value(motion, scratch) - w.sensor->value;
      for (const double from : {g, g + w.sensor->error, g - w.sensor->error})
        out.add(w.sensor->angular ? std::sin(from) : from);
    }
  }
  void act(const Motion& motion, std::span<const int> crossed, Memory& memory, EventAction& action) const override {
    ExpressionScratch scratch;
    for (std::size_t k = 0; k < watches_.size(); ++k) {
      const Watch& w = watches_[k];
      const double way = crossed[3 * k];
      const int lower = crossed[3 * k + 1], upper = crossed[3 * k + 2];
      if (way == 0 && lower == 0 && upper == 0) continue;
      // The sine of an angle is zero half a turn from VALUE as well: there it has been passed the other way.
      const bool opposite = w.sensor->angular && std::abs(w.distance(motion, scratch)) > 0.5 * std::numbers::pi;
      double& state = memory[static_cast<std::size_t>(w.state_kept)];
      const int wanted = w.sensor->direction();
      if (way != 0 && (opposite || (wanted != 0 && way != wanted))) {
        if (state == -way) state = ready;
      } else if (way != 0 && (state == ready || state == near || (wanted == 0 && state == -way))) {
        state = way;
        trigger(w, motion, scratch, memory, action);
      }
      if (opposite) continue;
      // From below upwards, or from above downwards.
      const bool comes = (wanted >= 0 && lower > 0) || (wanted <= 0 && upper < 0);
      const bool leaves = (wanted >= 0 && lower < 0) || (wanted <= 0 && upper > 0);
      if (comes && !leaves && state == ready) {
        state = near;
      } else if (leaves && state == near) {
        state = ready;
        trigger(w, motion, scratch, memory, action);
      }
    }
  }
  void act_at_start(const Motion& motion, Memory& memory, EventAction& action) const override {
    ExpressionScratch scratch;
    for (const Watch& w : watches_) {
      double& state = memory[static_cast<std::size_t>(w.state_kept)];
      const double g = w.distance(motion, scratch);
      const int wanted = w.sensor->direction();
      const bool holds = wanted == 0 ? std::abs(g) <= w.sensor->error : wanted * g >= -w.sensor->error;
      if (state == near && !holds) state = ready;
      if ((state != ready && state != near) || !holds) continue;
      state = wanted == 0 ? met_at_start : wanted;
      trigger(w, motion, scratch, memory, action);
    }
  }

 private:
  // What the memory holds of each: ready to trigger, near to VALUE without having met it, or the way in which it has.
  static constexpr double ready = 0, met_at_start = 2, near = 3;

  struct Watch {
    const Sensor* sensor;
    const ElementLabel* label;
    BoundExpression function, evaluate;
    std::int32_t value_kept = -1, state_kept = -1;

    double distance(const Motion& motion, ExpressionScratch& scratch) const {
      const double g = function.value(motion, scratch) - sensor->value;
      return sensor->angular ? std::remainder(g, 2 * std::numbers::pi) : g;
    }
    // Whether the condition has ceased to hold.
    bool is_past(double g) const {
      const int wanted = sensor->direction();
      return wanted == 0 ? std::abs(g) > sensor->error : wanted * g < -sensor->error;
    }
  };

  static void trigger(const Watch& w, const Motion& motion, ExpressionScratch& scratch, Memory& memory,
                      EventAction& action) {
    const Sensor& s = *w.sensor;
    action.restart = action.restart || s.restart;
    action.output = action.output || s.print;
    action.returns = action.returns || s.returns;
    action.halts = action.halts || s.halt;
    action.refactor = action.refactor || s.codgen;
    action.dump = action.dump || s.yydump;
    if (s.dt) action.output_step = s.dt;
    if (s.step_size) action.step_size = s.step_size;
    action.text += fmt::format("{} triggers at time {:.10g}: FUNCTION is {:.6g}", w.label->full_text(), motion.time,
                               w.function.value(motion, scratch));
    if (s.evaluates) {
      double& kept = memory[static_cast<std::size_t>(w.value_kept)];
      const double now = w.evaluate.value(motion, scratch);
      action.restart = action.restart || now != kept;  // what reads SENVAL jumps
      kept = now;
      action.text += fmt::format(", EVALUATE is {:.6g}", now);
    }
    if (s.halt || s.returns) action.text += s.halt ? ", and ends the run (HALT)" : ", and ends the simulation (RETURN)";
    action.text += '\n';
  }

  std::vector<Watch> watches_;
};

class SensorSet final : public TypedSet<Sensor> {
 public:
  using TypedSet::TypedSet;
  void read(std::size_t k, ElementReader& reader) override {
    Sensor& s = elements[k];
    if (!read_arguments(s, reader)) return;
    s.evaluates = reader.given("EVALUATE");
    if (s.eq + s.ge + s.le > 1) {
      reader.error("excluded-arguments", reader.at(s.le ? "LE" : "GE"),
                   fmt::format("{} takes one of EQ, GE and LE", reader.label().text()));
    }
    for (const auto& [name, value] : {std::pair{"DT", s.dt}, std::pair{"STEPSIZE", s.step_size}}) {
      if (value && !(*value > 0)) {
        reader.error("value-out-of-range", reader.at(name),
                     fmt::format("{} of {} must be positive", name, reader.label().text()));
      }
    }
  }
  std::unique_ptr<Kernel> make_kernel(const Model&, Layout&) const override {
    return std::make_unique<SensorKernel>(elements, labels);
  }
};

ToldToRoutine told_of_sensor(const StatementWords& s) {
  static constexpr std::array<std::string_view, 3> conditions = {"EQ", "GE", "LE"};
  const std::string_view condition = conditions[s.word_among(conditions).value_or(0)];
  const double error = s.has("ERROR") ? s.real("ERROR") : Sensor{}.error;
  return {std::make_shared<const sAdamsSensor>(sAdamsSensor{
      s.id(), s.constants().count(), s.constants().data(), s.real("VALUE"), error, {condition[0], condition[1]}})};
}
constexpr RoutineKind sensor_routine = {.routine = "sensub",
                                        .values = 1,
                                        .arguments = RoutineArguments::plain,
                                        .told = told_of_sensor,
                                        .constants = value_of_function};
constexpr std::array<ValueArgument, 1> value_of_evaluate = {{{"EVALUATE"}}};
constexpr RoutineKind evaluate_routine = {.routine = "sevsub",
                                          .values = 1,
                                          .arguments = RoutineArguments::plain,
                                          .told = told_of_sensor,
                                          .argument = "EVALUATE",
                                          .names_routine = "EVALUATE_ROUTINE",
                                          .constants = value_of_evaluate};
constexpr std::array<RoutineKind, 2> sensor_routines = {sensor_routine, evaluate_routine};

}  // namespace

extern constinit const Kind sensor =
    Kind{"SENSOR",
         "",
         "Watches an expression over time and stops or changes a simulation when it meets a value.",
         Kind::Role::element,
         detail::argument_infos<Sensor>,
         [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<SensorSet>(kind); }}
        .deactivatable()
        .calling(sensor_routines)
        .giving(Kind::Gives::events)
        .with_example("SENSOR/1, VALUE=0.5");

}  // namespace dynalin
