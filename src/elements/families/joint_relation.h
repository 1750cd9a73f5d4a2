// A relation between displacements of joints, one position row: Σ factor_k q_k = constant, or a function of them that
// is held at zero.
#pragma once

#include <memory>
#include <optional>

#include "elements/families/pair_displacement.h"
#include "expression/routine.h"
#include "mechanics/bound_expression.h"
#include "mechanics/row_terms.h"
#include "mechanics/start_displacement_source.h"
#include "mechanics/wrench_source.h"

namespace dynalin {

struct JointRelation {
  struct Term {
    JointFreedom freedom;
    double factor = 1;
  };
  std::vector<Term> terms;
  double constant = 0;
  // In the place of factors and constant: of TIME, MODE and behind them the displacements, in the order of the terms.
  std::optional<Expression> function{};
  std::shared_ptr<const Routine> routine{};  // that it calls
};

// Σ factor_k q_k as drawn, angles as principal values.
double drawn_value(const Model&, const JointRelation&);

class JointRelationKernel final : public Kernel,
                                  public WrenchSource,
                                  public RowTermsSource,
                                  public StartDisplacementSource {
 public:
  JointRelationKernel(const std::vector<JointRelation>&, const std::vector<ElementLabel>&, std::string_view row_name,
                      Layout&);
  void bind(Binder&) override;
  void constraints(const Motion&, ConstraintRows&) const override;
  void equations(const Motion&, Equations&) const override;
  void tell_row_terms(const Motion&, std::span<RowTerms>) const override;
  void start_displacements(const Motion&, std::vector<StartDisplacements>&) const override;
  void undefined_values(const Motion&, UndefinedValues&) const override;
  // What each joint bears of the relation, on its marker I with the opposite on J.
  const WrenchSource* reported_wrenches() const override { return this; }
  std::size_t wrench_count(std::size_t) const override { return joints_.size(); }
  std::size_t element_of_wrench(std::size_t which) const override { return joints_[which].relation; }
  MarkerId marker_I(std::size_t which) const override { return joints_[which].i; }
  MarkerId marker_J(std::size_t which) const override { return joints_[which].j; }
  void wrench(const Motion&, std::size_t which, Partials wanted, MarkerWrench&) const override;

 private:
  struct Relation {
    std::vector<std::pair<PairDisplacement, double>> terms;
    std::vector<JointFreedom> freedoms;  // of the terms
    double constant;
    std::int32_t row;
    std::optional<Expression> written;
    std::shared_ptr<const Routine> routine;
    BoundExpression function{};
  };
  // ∂row/∂q of its displacements.
  static std::vector<double> slopes(const Relation&, const Motion&);

  std::vector<Relation> relations_;
  const std::vector<ElementLabel>* labels_;
  const Layout* layout_;
  struct Joint {
    std::size_t relation, first_term, terms;
    MarkerId i, j;
  };
  std::vector<Joint> joints_;
};

}  // namespace dynalin
