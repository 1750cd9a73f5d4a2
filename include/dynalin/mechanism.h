// The library: load a mechanism, find an operating point, linearize about it, read plain values.
//
// Errors are thrown as dynalin::Error. A Mechanism may be moved but not copied; different ones may be used in different
// threads at the same time, one may not.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "dynalin/operating_state.h"
#include "dynalin/results.h"
#include "dynalin/units.h"

namespace dynalin {

// Wrong input or an analysis that failed. what() says all of it; `problems` holds the single messages.
class Error : public std::runtime_error {
 public:
  Error(const std::string& text, std::vector<std::string> messages)
      : std::runtime_error(text), problems(std::move(messages)) {}
  std::vector<std::string> problems;
};

// What LINEAR takes: ids of statements, nothing where an option is not used.
struct LinearRequest {
  std::optional<std::int64_t> pstate, pinput, poutput;
  std::optional<std::int64_t> rm;  // marker relative to which the coordinates are taken
  bool without_damping = false;    // forces and VARIABLEs lose what they see of velocities
  // The original implementation (ORIGINAL is all three):
  bool principal_states = false;        // positions of mass centres and 3-1-3 angles of principal axes
  bool without_rate_coupling = false;   // with without_damping: differential states lose what they see of velocities
  bool without_reconciliation = false;  // a static solution is taken as it was found, at rest
};

// What is decided before a model is made.
struct ReadingOptions {
  bool pade_delays = false;  // a DELAY as (1 − τs/2)/(1 + τs/2) with a state of its own, else as e − τ e′
  std::optional<double> user_value{};  // what takes the place of compiled user routines; nothing: they are errors
};

class Mechanism {
 public:
  // Reads an Adams dataset (.adm). Throws Error with every problem of the file.
  static Mechanism load(const std::string& path, const ReadingOptions& = {});
  // The same from text; `name` stands for the file in messages, and its folder is where MATRIX and SPLINE files lie.
  static Mechanism from_text(std::string dataset, std::string name = "dataset.adm", const ReadingOptions& = {});
  Mechanism(Mechanism&&) noexcept;
  Mechanism& operator=(Mechanism&&) noexcept;
  ~Mechanism();

  // Operating points. Every linear analysis before one of these begins with initial_conditions().
  void initial_conditions();
  // Throws where there is no equilibrium; returns the number of iterations. Afterwards the velocities that the dataset
  // states come back at the new pose if they are to be restored.
  int static_equilibrium(bool restore_velocities = true);
  // What the last static_equilibrium() found, and whether it is stable; throws if there was none after the last
  // initial_conditions().
  StaticResult static_result() const;

  StateSpace state_space(const LinearRequest& = {});
  EigenSolution eigensolution(const LinearRequest& = {});

  // The operating point: as drawn before any analysis, then what the last one left.
  OperatingState operating_state() const;
  std::vector<BodyState> bodies() const;  // of it
  // Value of a VARIABLE at the operating point.
  double variable(std::int64_t id) const;
  // Constraint rows that depend on others, "Zi.Xj in JOINT/3".
  const std::vector<std::string>& redundant_rows() const;
  const Units& units() const;
  // Remarks of reading and of all analyses so far.
  const std::vector<std::string>& warnings() const;

 private:
  struct State;
  explicit Mechanism(std::unique_ptr<State>);
  std::unique_ptr<State> state_;
};

}  // namespace dynalin
