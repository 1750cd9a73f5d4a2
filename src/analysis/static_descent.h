// One way downhill from a point to rest: Newton's method where it helps, else implicit steps of a damped motion.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "analysis/first_freedoms.h"
#include "analysis/rest_judgement.h"
#include "analysis/static_history.h"
#include "analysis/statics.h"

namespace dynalin {

// Beyond all proportion to the model: balance is an illusion of forces that vanish or grow without end.
bool escaped(const System&, const OperatingPoint& from, const OperatingPoint& to);

class Descent {
 public:
  Descent(StaticEquations& equations, const StaticsOptions& options, StaticHistory& history)
      : equations_(equations), system_(equations.system()), options_(options), history_(history) {}

  // Whether it came to rest; `op` is the last point in any case. Without `loose`, nothing was moved before: what
  // nothing holds may then rest where it is. Otherwise only unknowns that `loose` has may be held by nothing, and those
  // that rest where they were there as well.
  bool run(OperatingPoint& op, const FirstFreedoms* loose = nullptr);

  // Whether a point that another search has come near is at rest; it is taken there exactly. What may be held by
  // nothing is the same.
  bool polish(OperatingPoint& op, const FirstFreedoms& loose);

  const OperatingPoint& lowest() const { return lowest_; }
  bool held_states() const { return held_states_; }
  // What kept the last points that were nearly balanced from being accepted, empty if there were none.
  const std::string& doubt() const { return doubt_; }

 private:
  // Residuals in units of rounding: those that say nothing, those that Newton's steps alone may settle, and those of a
  // force that certainly acted.
  static constexpr double residual_noise = 100, little_excess = 1e4, certain_excess = 1e5;
  // Of the size of an unknown: moves that are at rest, and steps that change what rounding decides.
  static constexpr double settled_move = 1e-6, last_digits = 1e-12;
  static constexpr double nearer = 0.8;  // of the least merit or step so far: progress

  std::optional<Eigen::VectorXd> solve(double hold);
  bool newton(OperatingPoint& op, double level);
  bool implicit(OperatingPoint& op);
  bool finish(OperatingPoint& op);
  bool finish_at(OperatingPoint& op, const FirstFreedoms& loose);
  bool rests_put_back(OperatingPoint& op);
  Eigen::VectorXd determined_step(const RestJudgement&);
  Eigen::VectorXd without_undetermined(Eigen::VectorXd step) const;
  Eigen::VectorXd without_drift(const Eigen::VectorXd& step);
  Eigen::VectorXd held_part(const Eigen::VectorXd& step);
  bool is_driven(const Eigen::VectorXd& way, const Eigen::VectorXd& residual, const Eigen::VectorXd& rounding) const;
  bool came_to_rest(const RestJudgement&);
  bool faded_where_it_is(const RestJudgement&) const;
  void note_arrivals();
  void note_move(const Eigen::VectorXd& step, double factor);
  void change_yardstick();
  double level() const;

  StaticEquations& equations_;
  const System& system_;
  const StaticsOptions& options_;
  StaticHistory& history_;
  const FirstFreedoms* loose_ = nullptr;
  bool may_put_back_ = true;
  int iteration_ = 0, improved_ = 0, converging_ = 0, stalled_ = 0;
  OperatingPoint first_, lowest_;
  double way_ = 0, first_force_ = 0, lowest_merit_ = std::numeric_limits<double>::infinity();
  double force_ = 0, merit_ = 0, hold_ = 1, before_ = std::numeric_limits<double>::infinity();
  SparseLu lu_;
  bool held_states_ = false, transient_ = false, inputs_lead_ = false;
  // By unknown: the last step that was taken, relative; residuals of the last two iterations in units of rounding; and
  // whether balance came at once from far off, as where a contact opens, and not little by little.
  Eigen::VectorXd move_, excess_, excess_before_;
  std::vector<bool> arrived_;
  // The last steps that forces made, and by unknown the number of the one that is its last.
  struct Move {
    int at = -1;
    Eigen::VectorXd step;
    Eigen::VectorXd residual, rounding;  // before it
  };
  std::array<Move, 4> moves_;
  std::vector<int> moved_at_;
  int pushes_ = 0;
  Eigen::VectorXd pushing_, blur_;
  Eigen::VectorXd acted_;  // by equation, the most that its terms have been
  double turned_ = 0, turned_before_ = 0, steady_ = 0;
  double smallest_move_ = std::numeric_limits<double>::infinity();
  std::string doubt_;
};

}  // namespace dynalin
