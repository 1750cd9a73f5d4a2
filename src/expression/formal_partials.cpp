#include "expression/formal_partials.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "expression/program.h"

namespace dynalin {

namespace {

using Kind = ExpressionNode::Kind;

constexpr double rounding_of_coefficients = 1e-13;  // what a sum of numbers that cancel may leave, of their sizes

// What a key is of, beside the kinds of nodes.
enum Of : std::uint64_t { inverse = 100, slope, selected, alone };

template <class T>
std::uint64_t word(T v) {
  if constexpr (std::is_pointer_v<T>)
    return reinterpret_cast<std::uintptr_t>(v);
  else if constexpr (std::is_same_v<T, double>)
    return std::bit_cast<std::uint64_t>(v);
  else
    return static_cast<std::uint64_t>(v);
}

template <class... Words>
std::vector<std::uint64_t> key(Words... words) {
  return {word(words)...};
}

std::size_t at(std::int32_t k) { return static_cast<std::size_t>(k); }

}  // namespace

FormalPartials::Value FormalPartials::value(Key k) {
  return values_.emplace(std::move(k), static_cast<Value>(values_.size())).first->second;
}

FormalPartials::Term FormalPartials::unlike_any() { return product(one, value(key(alone, values_.size()))); }

FormalPartials::Term FormalPartials::product(Term term, Value factor) {
  std::vector<Value> all = factors_[at(term)];
  all.insert(std::upper_bound(all.begin(), all.end(), factor), factor);
  const auto [it, fresh] = terms_.emplace(std::move(all), static_cast<Term>(terms_.size()));
  if (fresh) factors_.push_back(it->first);
  return it->second;
}

FormalPartials::Growing FormalPartials::times(const Growing& sum, Value factor) {
  const auto constant = constants_.find(factor);
  Growing result;
  for (const auto& [term, c] : sum) {
    if (constant == constants_.end())
      result[product(term, factor)] = c;
    else
      result[term] = {c.number * constant->second, c.size * std::abs(constant->second)};
  }
  return result;
}

FormalPartials::Value FormalPartials::node_value(const ExpressionProgram& program, std::size_t k,
                                                 const std::vector<Value>& before) {
  const ExpressionNode& node = program.nodes()[k];
  const auto of = [&](std::int32_t n) { return before[at(n)]; };
  Key all = key(node.kind);
  const auto add_operands = [&](std::int32_t count) {
    for (std::int32_t i = 0; i < count; ++i) all.push_back(word(of(program.operands()[at(node.b + i)])));
  };
  switch (node.kind) {
    case Kind::constant: {
      const Value v = value(key(node.kind, program.constant_of(node)));
      constants_[v] = program.constant_of(node);
      return v;
    }
    case Kind::atom: {
      const Atom a = program.atom(at(node.a));
      all.push_back(word(a.function)), all.push_back(word(a.delayed.get()));
      for (const std::int32_t i : a.argument) all.push_back(word(i));
      break;
    }
    case Kind::negate:
      all.push_back(word(of(node.a)));
      break;
    case Kind::add:
    case Kind::multiply:
      all.push_back(word(std::min(of(node.a), of(node.b)))), all.push_back(word(std::max(of(node.a), of(node.b))));
      break;
    case Kind::subtract:
    case Kind::divide:
      all.push_back(word(of(node.a))), all.push_back(word(of(node.b)));
      break;
    case Kind::power:
      all.push_back(word(of(node.a))), all.push_back(word(program.constant_of(node)));
      break;
    case Kind::call:
      all.push_back(word(&program.function_of(node)));
      add_operands(node.a);
      break;
    case Kind::spline: {
      const SplineUse& use = program.splines()[at(node.a)];
      all.insert(all.end(), {word(use.id), word(use.method), word(use.derivative), word(use.component.value_or(9))});
      if (use.spectrum) all.push_back(word(values_.size()));  // one that is like no other
      add_operands(2);
      break;
    }
    case Kind::routine: {
      const RoutineUse& use = program.routines()[at(node.a)];
      all.insert(all.end(), {word(use.routine.get()), word(use.which)});
      add_operands(static_cast<std::int32_t>(use.inputs));
      break;
    }
    case Kind::branch:
      return of(node.a);
    case Kind::jump:
      return value(key(node.kind));
    case Kind::merge:
      all.push_back(word(of(node.a)));
      add_operands(3);
      break;
  }
  return value(std::move(all));
}

// The chain rule at one node: its adjoint times each slope to what it is made of.
void FormalPartials::spread(const ExpressionProgram& program, std::size_t k, const std::vector<Value>& values,
                            std::vector<Growing>& adjoint) {
  const ExpressionNode& node = program.nodes()[k];
  const auto of = [&](std::int32_t n) { return values[at(n)]; };
  const Growing& whole = adjoint[k];
  const auto pass = [&](std::int32_t to, const Growing& sum, double number = 1) {
    for (const auto& [term, c] : sum) {
      Coefficient& into = adjoint[at(to)][term];
      into.number += number * c.number, into.size += std::abs(number) * c.size;
    }
  };
  const auto pass_slopes = [&](Key base, std::int32_t count) {
    for (std::int32_t i = 0; i < count; ++i) base.push_back(word(of(program.operands()[at(node.b + i)])));
    for (std::int32_t i = 0; i < count; ++i) {
      const std::int32_t to = program.operands()[at(node.b + i)];
      if (constants_.contains(of(to))) continue;
      Key by = base;
      by.push_back(word(i));
      pass(to, times(whole, value(std::move(by))));
    }
  };
  switch (node.kind) {
    case Kind::constant:
    case Kind::atom:
    case Kind::branch:
    case Kind::jump:
      return;
    case Kind::negate:
      return pass(node.a, whole, -1);
    case Kind::add:
      pass(node.a, whole);
      return pass(node.b, whole);
    case Kind::subtract:
      pass(node.a, whole);
      return pass(node.b, whole, -1);
    case Kind::multiply:
      pass(node.a, times(whole, of(node.b)));
      return pass(node.b, times(whole, of(node.a)));
    case Kind::divide: {
      const Value by = value(key(inverse, of(node.b)));
      if (const auto c = constants_.find(of(node.b)); c != constants_.end()) constants_[by] = 1 / c->second;
      const Growing divided = times(whole, by);
      pass(node.a, divided);
      return pass(node.b, times(divided, values[k]), -1);
    }
    case Kind::power: {
      const double exponent = program.constant_of(node);
      if (exponent == 0) return;
      if (exponent == 1) return pass(node.a, whole);
      const Value less = exponent == 2 ? of(node.a) : value(key(Kind::power, of(node.a), exponent - 1));
      return pass(node.a, times(whole, less), exponent);
    }
    case Kind::call:
      return pass_slopes(key(slope, &program.function_of(node)), node.a);
    case Kind::spline:
      return pass_slopes(key(slope, values[k]), 2);
    case Kind::routine:
      return pass_slopes(key(slope, values[k]), static_cast<std::int32_t>(program.routines()[at(node.a)].inputs));
    case Kind::merge:
      for (std::int32_t i = 0; i < 3; ++i)
        pass(program.operands()[at(node.b + i)], times(whole, value(key(selected, of(node.a), i))));
      return;
  }
}

std::vector<FormalPartials::Sum> FormalPartials::of(const Expression& e) {
  const ExpressionProgram& program = e.program();
  std::vector<Value> values;
  for (std::size_t k = 0; k < program.nodes().size(); ++k) values.push_back(node_value(program, k, values));
  std::vector<Growing> adjoint(program.nodes().size());
  adjoint.back()[one] = {1, 1};
  std::vector<Growing> whole(program.atom_count());
  for (std::size_t k = program.nodes().size(); k-- > 0;) {
    if (adjoint[k].empty()) continue;
    if (program.nodes()[k].kind != Kind::atom) {
      spread(program, k, values, adjoint);
      continue;
    }
    for (const auto& [term, c] : adjoint[k]) {
      Coefficient& into = whole[at(program.nodes()[k].a)][term];
      into.number += c.number, into.size += c.size;
    }
  }
  std::vector<Sum> sums(whole.size());
  for (std::size_t k = 0; k < whole.size(); ++k) {
    for (const auto& [term, c] : whole[k]) {
      if (std::abs(c.number) > rounding_of_coefficients * c.size) sums[k][term] = c.number;
    }
  }
  return sums;
}

}  // namespace dynalin
