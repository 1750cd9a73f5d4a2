// Analyses of a model: operating points, and linear models about them.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dynalin/linear_model.h"
#include "dynalin/model.h"
#include "dynalin/operating_point.h"
#include "dynalin/simulation.h"

namespace dynalin {

// What a static analysis takes; a value that is not stated is that of EQUILIBRIUM in the dataset, or its default.
struct StaticRequest {
  bool restore_velocities = true;  // afterwards the velocities that the dataset states come back at the new pose
  // What is taken where no exact equilibrium is found: Newton's step in lengths of the model, radians and sizes of
  // states; unbalanced forces, and moments by the length of the model [force].
  std::optional<double> error{}, imbalance{};
  std::optional<double> translation_limit{}, rotation_limit{};  // of a step [length], [rad]
  std::optional<std::int64_t> iteration_limit{};
  std::optional<bool> newton{};                // Newton's method first, as METHOD=ORIGINAL says
  std::optional<double> stability{};           // of it, a multiple of masses and dampings that holds what is free
  std::optional<std::vector<bool>> pattern{};  // of it, which iterations evaluate the Jacobian, over and over
  std::optional<bool> by_motion{};             // a damped motion first, as DYNAMIC says
  std::optional<double> global_damping{};      // of it, of every part [force·time/length]
  // Of it: where it may be at rest [length/time²], [mass·length²/time²]; the longest that it lasts [time].
  std::optional<double> acceleration_error{}, kinetic_energy_error{}, settling_time{};
  std::function<void(int iteration, double imbalance)> progress{};  // called with every iteration [force]
};

// What finding a consistent point takes; nothing: the value of IC in the dataset, or its default.
struct InitialConditionRequest {
  std::optional<double>
      error{};  // how far redundant constraints may be from agreeing: part of the model's length, or rad
};

namespace library {

// Holds nothing but its model: analyses take a point and return another one, so that several points of one run, and
// studies in several threads, stand beside each other. A point of another model throws, like all that fails, Error.
class Study {
 public:
  explicit Study(Model model) : model_(std::move(model)) {}
  const Model& model() const { return model_; }

  OperatingPoint as_drawn() const;
  // A point of a model that this one was made of by Model::edited and Model::with, once or several times, as far as it
  // goes on: by class and id of the elements. What is new, or was stated anew since, begins as the dataset has it;
  // since the first of the models, if the point is of none of them. It is not consistent; one of this model stays as it
  // is.
  OperatingPoint continued(const OperatingPoint& of_a_model_before) const;
  // Positions, velocities, accelerations and reactions that agree with constraints and forces; from the point as drawn,
  // or from another, which stays as it is if it is consistent already.
  OperatingPoint initial_conditions() const { return initial_conditions(as_drawn()); }
  OperatingPoint initial_conditions(const OperatingPoint& from, const InitialConditionRequest& = {}) const;
  // Where all forces balance at rest, from the pose of a point.
  OperatingPoint static_equilibrium(const StaticRequest& request = {}) const {
    return static_equilibrium(as_drawn(), request);
  }
  OperatingPoint static_equilibrium(const OperatingPoint& from, const StaticRequest& = {}) const;

  // Through time, from the present one of a point on, which is made consistent first if it is not.
  Simulation simulate(const SimulationRequest& request) const { return simulate(as_drawn(), request); }
  Simulation simulate(const OperatingPoint& from, const SimulationRequest&) const;

  // Values of function expressions, "DX(21,1)", "JOINT(3,0,2,0)/1000": of markers and elements by id, in the units of
  // the dataset and radians, along the axes that the function names. Each in the order asked for; the model knows
  // nothing of them afterwards. Of a point that is not consistent those of the one that agrees with constraints and
  // forces. Throws Error where a function cannot be read, refers to what the model does not have, or has no value.
  std::vector<double> measured(const OperatingPoint&, const std::vector<std::string>& functions) const;

  // Writes all values of a point into a file, as SAVE/STATES of a command file does (docs/saved.md), to the last bit.
  // It is there whole or, where Error is thrown, not at all; one of that name is replaced. `title` is kept in it.
  void save(const OperatingPoint&, const std::string& path, const std::string& title = {}) const;
  // The point of such a file, also of one of SAVE/SYSTEM. Values go to the elements of the same class and id. In the
  // model that was saved, unchanged, it is what it was; in any other it is not consistent, and remarks of the point
  // name what is not in both. Throws Error where the file cannot be read, was not written by SAVE, or was altered.
  OperatingPoint reload(const std::string& path) const;
  // The same as the text of such a file.
  std::string saved_text(const OperatingPoint&, const std::string& title = {}) const;
  OperatingPoint from_saved_text(const std::string& text) const;

  // A point that is not consistent is made so first. A model without states has a linear model where plant inputs and
  // outputs are both named: D alone.
  LinearModel linearize(const LinearRequest& request = {}) const { return linearize(as_drawn(), request); }
  LinearModel linearize(const OperatingPoint&, const LinearRequest& = {}) const;

 private:
  Model model_;
};

}  // namespace library
}  // namespace dynalin
