// Partial derivatives of expressions by how they are made, without values: sums of numbers times terms, where a term is
// a product of what the program computes. All expressions that one FormalPartials looks at share its terms, so that
// what is written alike in several of them cancels, whatever its value.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "expression/expression.h"

namespace dynalin {

class FormalPartials {
 public:
  using Term = std::int32_t;
  static constexpr Term one = 0;  // the product of nothing
  using Sum = std::map<Term, double>;

  FormalPartials() : terms_{{{}, one}}, factors_(1) {}
  // With respect to each atom of the expression.
  std::vector<Sum> of(const Expression&);
  // A term that is like no other.
  Term unlike_any();

 private:
  using Value = std::int32_t;  // what a node computes; alike nodes have the same one
  using Key = std::vector<std::uint64_t>;
  struct Coefficient {
    double number = 0, size = 0;  // of what it is the sum
  };
  using Growing = std::map<Term, Coefficient>;

  Value value(Key);
  Value node_value(const ExpressionProgram&, std::size_t node, const std::vector<Value>& before);
  void spread(const ExpressionProgram&, std::size_t node, const std::vector<Value>&, std::vector<Growing>& adjoint);
  Growing times(const Growing&, Value);
  Term product(Term, Value);

  std::map<Key, Value> values_;
  std::map<Value, double> constants_;
  std::map<std::vector<Value>, Term> terms_;  // by factors in ascending order
  std::vector<std::vector<Value>> factors_;
};

}  // namespace dynalin
