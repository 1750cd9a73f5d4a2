// Which DIFFs are states, where their equations share rates.
//
// With h_i = 0 the equation of DIFF i (z′ − e, or e where it is implicit), the states are as many as the rank of
// M = ∂h/∂z′. A combination y with yᵀM = 0 everywhere is a condition yᵀh = 0 without rates: it stands in place of one
// equation and makes one z an algebraic unknown, whose rate follows from the derivative of the condition. That
// determines all rates where [M of the equations that stay; ∂(yᵀh)/∂z] is regular (index 1).
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
  enum class Fault : std::uint8_t { higher_index, varying };
  struct Refusal {
    Fault fault;
    std::vector<std::size_t> members;
  };
  std::vector<Role> roles;
  std::vector<Refusal> refusals;
};

RateReduction reduce_rates(const std::vector<DiffEquation>&);

}  // namespace dynalin
