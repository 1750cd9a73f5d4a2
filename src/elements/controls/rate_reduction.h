// Which DIFFs are states, where their equations share rates.
//
// With h_i = 0 the equation of DIFF i (z′ − e, or e where it is implicit), the states are as many as the rank of
// M = ∂h/∂z′. A combination y with yᵀM = 0 is a condition yᵀh = 0 without rates: it stands in place of one equation and
// makes one z an algebraic unknown, whose rate follows from the derivative of the condition.
//
// All of this is decided by how the equations are made, without values: combinations are those in which the partials
// cancel as they are written (FormalPartials; a linear combination of equations as of Tan, Nedialkov & Pryce 2017), the
// structure that comes out is Pryce's (signature_method.h), with conditions differentiated once (index 1), and its
// Jacobian [M of the equations that stay; ∂(yᵀh)/∂z] has to be regular with its numbers as they are and all else
// independent. Whether it is so where the model stands is asked there (FunctionEquationKernel).
#pragma once

#include <cstdint>
#include <vector>

#include "expression/expression.h"

namespace dynalin {

struct DiffEquation {
  std::int64_t id = 0;
  Expression function;
  bool implicit = false, reads_own_rate = false;
  bool opaque = false;  // reads rates in ways that its partials do not show: takes no part in conditions
  double initial = 0, initial_rate = 0;
  bool constant = false;  // z does not change, whatever its function says
};

struct RateReduction {
  struct Term {
    std::size_t of;  // the equation h of this DIFF
    double factor;
  };
  struct Role {
    bool is_state = true;
    std::vector<Term> condition;  // of an algebraic unknown: Σ factor · h = 0 with all rates left out
    std::size_t equation = 0;     // that stands for it otherwise, most often its own
  };
  struct Refusal {
    std::vector<std::size_t> members;
  };
  std::vector<Role> roles;
  std::vector<Refusal> refusals;
  std::vector<std::vector<std::size_t>> coupled;  // those that determine their rates together
};

RateReduction reduce_rates(const std::vector<DiffEquation>&);

}  // namespace dynalin
