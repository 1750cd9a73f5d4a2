// A linear relation between displacements of joints, one position row:  Σ factor_k q_k = constant.
#pragma once

#include "elements/families/pair_displacement.h"

namespace dynalin {

struct JointRelation {
  struct Term {
    JointFreedom freedom;
    double factor = 1;
  };
  std::vector<Term> terms;
  double constant = 0;
};

// Σ factor_k q_k as drawn, angles as principal values.
double drawn_value(const Model&, const JointRelation&);

class JointRelationKernel final : public Kernel {
 public:
  JointRelationKernel(const std::vector<JointRelation>&, const std::vector<ElementLabel>&, std::string_view row_name,
                      Layout&);
  void constraints(const Motion&, ConstraintRows&) const override;
  void equations(const Motion&, Equations&) const override;
  void remember(const Motion&, Memory&) const override;

 private:
  struct Relation {
    std::vector<std::pair<PairDisplacement, double>> terms;
    double constant;
    std::int32_t row;
  };
  std::vector<Relation> relations_;
};

}  // namespace dynalin
