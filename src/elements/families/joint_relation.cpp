#include "elements/families/joint_relation.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dynalin {

double drawn_value(const Model& model, const JointRelation& relation) {
  double sum = 0;
  for (const JointRelation::Term& t : relation.terms) {
    sum += t.factor * displacement(t.freedom.kind, drawn_frame(model, t.freedom.i, t.freedom.j));
  }
  return sum;
}

JointRelationKernel::JointRelationKernel(const std::vector<JointRelation>& relations,
                                         const std::vector<ElementLabel>& labels, std::string_view row_name,
                                         Layout& layout)
    : labels_(&labels), layout_(&layout) {
  for (std::size_t k = 0; k < relations.size(); ++k) {
    Relation r{{},
               {},
               relations[k].constant,
               layout.add_row(labels[k], row_name),
               relations[k].function,
               relations[k].routine};
    for (const JointRelation::Term& t : relations[k].terms) {
      PairDisplacement q(layout.marker(t.freedom.i), layout.marker(t.freedom.j), t.freedom.kind);
      if (t.freedom.kind == Displacement::rotation)
        q.count_turns(layout.count_turns(Measure::AZ, t.freedom.i, t.freedom.j));
      r.terms.emplace_back(q, t.factor);
      r.freedoms.push_back(t.freedom);
      // Both freedoms of a CYLINDRICAL joint are one wrench.
      const bool again = !joints_.empty() && joints_.back().relation == k && joints_.back().i == t.freedom.i &&
                         joints_.back().j == t.freedom.j;
      if (again)
        ++joints_.back().terms;
      else
        joints_.push_back({k, r.terms.size() - 1, 1, t.freedom.i, t.freedom.j});
    }
    relations_.push_back(std::move(r));
  }
}

void JointRelationKernel::bind(Binder& binder) {
  for (Relation& r : relations_) {
    if (r.written) r.function = BoundExpression(*r.written, binder);
  }
}

void JointRelationKernel::constraints(const Motion& motion, ConstraintRows& rows) const {
  for (const Relation& r : relations_) {
    if (r.written) {
      rows.set(r.row, r.function.add_position(motion, rows, r.row));
      continue;
    }
    Taylor sum(-r.constant);
    for (const auto& [q, factor] : r.terms) {
      sum = sum + factor * q.along_motion(motion);
      q.add_to_row(motion, factor, r.row, rows);
    }
    rows.set(r.row, sum);
  }
}

void JointRelationKernel::equations(const Motion& motion, Equations& eq) const {
  if (!eq.wants(PartialBy::position)) return;
  for (const Relation& r : relations_) {
    eq.begin_constraint(r.row);
    const double lambda = motion.lambda[static_cast<std::size_t>(r.row)];
    if (r.written) {
      r.function.add_reaction_partials(motion, eq, lambda, RowLevel::position);
      continue;
    }
    for (const auto& [q, factor] : r.terms) q.add_reaction_partials(motion, factor * lambda, eq);
  }
}

// A routine says nothing that could be solved beforehand.
void JointRelationKernel::start_displacements(const Motion&, std::vector<StartDisplacements>& out) const {
  for (std::size_t k = 0; k < relations_.size(); ++k) {
    const Relation& r = relations_[k];
    if (r.written) continue;
    StartDisplacements s{.terms = {}, .constant = r.constant, .of = &(*labels_)[k], .argument = {}};
    for (std::size_t t = 0; t < r.terms.size(); ++t) {
      const JointFreedom& f = r.freedoms[t];
      s.terms.push_back({f.i, f.j, f.kind == Displacement::rotation, r.terms[t].second});
    }
    out.push_back(std::move(s));
  }
}

void JointRelationKernel::tell_row_terms(const Motion& motion, std::span<RowTerms> rows) const {
  for (const Relation& r : relations_) {
    double& size = rows[static_cast<std::size_t>(r.row)].size;
    size = std::abs(r.constant);
    const std::vector<double> slope = slopes(r, motion);
    for (std::size_t k = 0; k < r.terms.size(); ++k)
      size += std::abs(slope[k] * r.terms[k].first.along_motion(motion).value);
  }
}

std::vector<double> JointRelationKernel::slopes(const Relation& r, const Motion& motion) {
  std::vector<double> slope;
  if (!r.written) {
    for (const auto& [q, factor] : r.terms) slope.push_back(factor);
    return slope;
  }
  constexpr std::ptrdiff_t first_displacement = 2;
  ExpressionScratch scratch;
  const std::span<const double> all = r.function.partials(motion, scratch);
  slope.assign(all.begin() + first_displacement, all.end());
  return slope;
}

void JointRelationKernel::wrench(const Motion& motion, std::size_t which, Partials, MarkerWrench& out) const {
  const Joint& joint = joints_[which];
  const Relation& r = relations_[joint.relation];
  const double lambda = motion.lambda[static_cast<std::size_t>(r.row)];
  Vector force, torque;
  const std::vector<double> slope = slopes(r, motion);
  for (std::size_t k = joint.first_term; k < joint.first_term + joint.terms; ++k) {
    r.terms[k].first.wrench(motion, slope[k] * lambda, r.row, Partials::no, out);
    force += out.force.force, torque += out.force.torque;
  }
  out.force.force = force, out.force.torque = torque;
}

void JointRelationKernel::undefined_values(const Motion& motion, UndefinedValues& undefined) const {
  for (std::size_t k = 0; k < relations_.size(); ++k) {
    const Relation& r = relations_[k];
    if (!r.written) continue;
    const std::size_t before = undefined.values().size();
    r.function.find_undefined(motion, (*labels_)[k], undefined, BoundExpression::Derivatives::with_rates);
    if (undefined.values().size() > before || motion.mode != AnalysisMode::linear) continue;
    // A linear model takes one derivative more along the motion.
    ConstraintRows varied;
    varied.resize(*layout_, 1);
    r.function.add_position(motion, varied, 0);
    const auto finite = [](const ConstraintRows::Entry& e) { return std::isfinite(e.c.a0); };
    if (std::ranges::all_of(varied.row(0), finite)) continue;
    const std::array<double, 1> now = {motion.time};
    undefined.add(
        UndefinedValue{&(*labels_)[k], (*labels_)[k].full_text() + ": " + r.routine->reason_of_partials(now), false});
  }
}

}  // namespace dynalin
