// Angles have kinks and jumps where what is made of them has none: COS(THETA(i,j)) is the product of two axes. A
// program that combines angles in one of these ways reads the combination as one quantity instead.
//
//     COS(THETA)                      z_i·z_j
//     SIN(PITCH)                      entry (3,1)
//     SIN(THETA) * SIN or COS(PSI)    entries (1,3) and −(2,3)
//     SIN(THETA) * SIN or COS(PHI)    entries (3,1) and (3,2)
//     COS(PITCH) * SIN or COS(YAW)    entries (2,1) and (1,1)
//     COS(PITCH) * SIN or COS(ROLL)   entries (3,2) and (3,3)
//     PSI ± PHI, YAW ± ROLL           of the quantities that both turns share
//     COS(INCANG)
//     THETA ** 2n, THETA * THETA, the same of INCANG
//
// The entries are those of the matrix whose columns are the axes of i in the axes of j; sums and products may have
// other terms and factors before the two. Angles that are combined otherwise stay what they are.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "expression/program_builder.h"

namespace dynalin {

namespace {

using Kind = ExpressionNode::Kind;

// Functions of angles.
enum class Wave : std::uint8_t { sine, cosine };
bool is_call_of(Wave wave, const DraftNode& n) {
  static const std::array functions = {find_function("SIN"), find_function("COS")};
  return n.kind == Kind::call && n.function == functions[static_cast<std::size_t>(wave)];
}

using enum Measure;

struct Product {
  Wave of_first;
  Measure first;
  Wave of_second;
  Measure second, entry;
  double sign;
};
// UVX_Z is the component z, axes of j, of the axis x of i: entry (3, 1).
constexpr std::array products = {
    // clang-format off
    Product{Wave::sine, THETA, Wave::sine, PSI, UVZ_X, 1},
    Product{Wave::sine, THETA, Wave::cosine, PSI, UVZ_Y, -1},
    Product{Wave::sine, THETA, Wave::sine, PHI, UVX_Z, 1},
    Product{Wave::sine, THETA, Wave::cosine, PHI, UVY_Z, 1},
    Product{Wave::cosine, PITCH, Wave::sine, YAW, UVX_Y, 1},
    Product{Wave::cosine, PITCH, Wave::cosine, YAW, UVX_X, 1},
    Product{Wave::cosine, PITCH, Wave::sine, ROLL, UVY_Z, 1},
    Product{Wave::cosine, PITCH, Wave::cosine, ROLL, UVZ_Z, 1},
    // clang-format on
};

constexpr std::array squares = {std::pair{THETA, THETA_SQUARED}, std::pair{INCANG, INCANG_SQUARED}};

class Rewriting {
 public:
  explicit Rewriting(ProgramDraft& program) : p_(program) {}

  void run() {
    for (std::size_t k = 0; k < p_.nodes.size(); ++k) {
      switch (p_.nodes[k].kind) {
        case Kind::power:
          square(k, p_.nodes[k].a, p_.nodes[k].constant);
          break;
        case Kind::multiply:
          multiply(k);
          break;
        case Kind::add:
        case Kind::subtract:
          sum(k);
          break;
        default:
          break;
      }
    }
    for (std::size_t k = 0; k < p_.nodes.size(); ++k) {
      if (const Atom* a = angle_of_call(k, Wave::cosine, THETA)) put(k, UVZ_Z, *a);
      if (const Atom* a = angle_of_call(k, Wave::sine, PITCH)) put(k, UVX_Z, *a);
      if (const Atom* a = angle_of_call(k, Wave::cosine, INCANG)) put(k, INCANG_COSINE, *a);
    }
    if (changed_) clear_unused();
  }

 private:
  const DraftNode& node(std::int32_t k) const { return p_.nodes[static_cast<std::size_t>(k)]; }
  const Atom* atom(std::int32_t k, Measure measure) const {
    if (node(k).kind != Kind::atom) return nullptr;
    const Atom& a = p_.atoms[static_cast<std::size_t>(node(k).a)];
    return a.function->measure == measure ? &a : nullptr;
  }
  // That angle, whose sine or cosine this node is.
  const Atom* angle_of_call(std::size_t k, Wave wave, Measure angle) const {
    const DraftNode& n = p_.nodes[k];
    return is_call_of(wave, n) ? atom(p_.operands[static_cast<std::size_t>(n.b)], angle) : nullptr;
  }
  static bool same_markers(const Atom& a, const Atom& b) { return a.argument == b.argument; }

  // The node becomes that quantity, of the markers of an atom in it.
  void put(std::size_t k, Measure measure, const Atom& of) {
    Atom quantity = of;
    quantity.function = &atom_function(measure);
    quantity.at = p_.places[k];
    const auto found = std::ranges::find_if(
        p_.atoms, [&](const Atom& a) { return a.function == quantity.function && a.argument == quantity.argument; });
    const auto index = static_cast<std::int32_t>(found - p_.atoms.begin());
    if (found == p_.atoms.end()) p_.atoms.push_back(quantity);
    p_.nodes[k] = {.kind = Kind::atom, .a = index};
    changed_ = true;
  }

  void square(std::size_t k, std::int32_t of, double exponent) {
    const bool even = exponent > 0 && std::fmod(exponent, 2.0) == 0.0;
    for (const auto& [angle, squared] : squares) {
      const Atom* a = even ? atom(of, angle) : nullptr;
      if (!a) continue;
      if (exponent == 2.0) return put(k, squared, *a);
      // The angle itself stands nowhere else: nodes are used once.
      if (users(of) > 1) return;
      put(static_cast<std::size_t>(of), squared, *a);
      p_.nodes[k].constant = exponent / 2;
      return;
    }
  }

  // What two factors are together: a quantity, of the markers of an atom, with a sign.
  struct Together {
    Measure quantity;
    double sign;
    Atom of;
  };
  std::optional<Together> together(std::int32_t x, std::int32_t y) const {
    for (const auto& [angle, squared] : squares) {
      const Atom *a = atom(x, angle), *b = atom(y, angle);
      if (a && b && same_markers(*a, *b)) return Together{squared, 1, *a};
    }
    for (const auto& [m, n] : {std::pair{x, y}, std::pair{y, x}}) {
      for (const Product& product : products) {
        const Atom* a = angle_of_call(static_cast<std::size_t>(m), product.of_first, product.first);
        const Atom* b = angle_of_call(static_cast<std::size_t>(n), product.of_second, product.second);
        if (a && b && same_markers(*a, *b)) return Together{product.entry, product.sign, *a};
      }
    }
    return std::nullopt;
  }

  // x y, or (rest x) y.
  void multiply(std::size_t k) {
    const std::int32_t y = p_.nodes[k].b;
    if (const auto both = together(p_.nodes[k].a, y)) {
      if (both->sign > 0) return put(k, both->quantity, both->of);
      const std::int32_t argument = p_.operands[static_cast<std::size_t>(node(y).b)];
      if (users(argument) > 1) return;
      p_.places[static_cast<std::size_t>(argument)] = p_.places[k];
      put(static_cast<std::size_t>(argument), both->quantity, both->of);
      p_.nodes[k] = {.kind = Kind::negate, .a = argument};
      return;
    }
    const DraftNode inner = node(p_.nodes[k].a);
    if (inner.kind != Kind::multiply || users(p_.nodes[k].a) > 1 || users(y) > 1) return;
    const auto both = together(inner.b, y);
    if (!both) return;
    const Span at = join(p_.places[static_cast<std::size_t>(inner.b)], p_.places[static_cast<std::size_t>(y)]);
    std::int32_t place = y;
    if (both->sign < 0) {
      place = p_.operands[static_cast<std::size_t>(node(y).b)];
      if (users(place) > 1) return;
      p_.nodes[static_cast<std::size_t>(y)] = {.kind = Kind::negate, .a = place};
    }
    p_.places[static_cast<std::size_t>(place)] = at;
    put(static_cast<std::size_t>(place), both->quantity, both->of);
    p_.nodes[k].a = inner.a;
  }

  // x ± y, or (rest ± x) ± y, with x and y two turns about axes that may coincide.
  void sum(std::size_t k) {
    const DraftNode outer = p_.nodes[k];
    const double sign_y = outer.kind == Kind::add ? 1 : -1;
    if (const auto pair = turns(outer.a, outer.b)) {
      const auto& [with_plus, with_minus, swapped] = *pair;
      if (sign_y > 0) return put(k, with_plus, *of(outer.a));
      if (!swapped) return put(k, with_minus, *of(outer.a));
      if (users(outer.b) > 1) return;
      const Atom angle = *of(outer.b);
      p_.places[static_cast<std::size_t>(outer.b)] = p_.places[k];
      put(static_cast<std::size_t>(outer.b), with_minus, angle);
      p_.nodes[k] = {.kind = Kind::negate, .a = outer.b};
      return;
    }
    const DraftNode inner = node(outer.a);
    if ((inner.kind != Kind::add && inner.kind != Kind::subtract) || users(outer.a) > 1 || users(outer.b) > 1) return;
    const auto pair = turns(inner.b, outer.b);
    if (!pair) return;
    const auto& [with_plus, with_minus, swapped] = *pair;
    const double sign_x = inner.kind == Kind::add ? 1 : -1;
    // sign_x x + sign_y y = sign (x + y), or sign (first − last).
    const bool plus = sign_x == sign_y;
    const double sign = plus ? sign_x : swapped ? sign_y : sign_x;
    const Atom angle = *of(outer.b);
    p_.places[static_cast<std::size_t>(outer.b)] = join(of(inner.b)->at, angle.at);
    put(static_cast<std::size_t>(outer.b), plus ? with_plus : with_minus, angle);
    p_.nodes[k] = {.kind = sign > 0 ? Kind::add : Kind::subtract, .a = inner.a, .b = outer.b};
  }

  struct Turns {
    Measure plus, minus;
    bool swapped;  // the last of the three angles stands first
  };
  std::optional<Turns> turns(std::int32_t x, std::int32_t y) const {
    for (const auto& [first, last, plus, minus] :
         {std::array{PSI, PHI, PSI_PLUS_PHI, PSI_MINUS_PHI}, std::array{YAW, ROLL, YAW_PLUS_ROLL, YAW_MINUS_ROLL}}) {
      for (const bool swapped : {false, true}) {
        const Atom *a = atom(x, swapped ? last : first), *b = atom(y, swapped ? first : last);
        if (a && b && same_markers(*a, *b)) return Turns{plus, minus, swapped};
      }
    }
    return std::nullopt;
  }
  const Atom* of(std::int32_t k) const { return &p_.atoms[static_cast<std::size_t>(node(k).a)]; }

  template <class Visit>
  void for_operands(const DraftNode& n, Visit&& visit) const {
    const auto listed = [&](std::int32_t count) {
      for (std::int32_t k = 0; k < count; ++k) visit(p_.operands[static_cast<std::size_t>(n.b + k)]);
    };
    switch (n.kind) {
      case Kind::constant:
      case Kind::atom:
      case Kind::jump:
        return;
      case Kind::negate:
      case Kind::power:
      case Kind::branch:
        return visit(n.a);
      case Kind::add:
      case Kind::subtract:
      case Kind::multiply:
      case Kind::divide:
        visit(n.a);
        return visit(n.b);
      case Kind::call:
        return listed(n.a);
      case Kind::spline:
        return listed(2);
      case Kind::routine:
        return listed(static_cast<std::int32_t>(p_.routines[static_cast<std::size_t>(n.a)].inputs));
      case Kind::merge:
        visit(n.a);
        return listed(3);
    }
  }
  std::size_t users(std::int32_t of) const {
    std::size_t count = 0;
    for (const DraftNode& n : p_.nodes) for_operands(n, [&](std::int32_t k) { count += k == of; });
    return count;
  }

  // What nothing reads any more is the constant 0: its atoms are not looked at.
  void clear_unused() {
    std::vector<std::size_t> count(p_.nodes.size(), 0);
    for (const DraftNode& n : p_.nodes) {
      for_operands(n, [&](std::int32_t k) { ++count[static_cast<std::size_t>(k)]; });
    }
    for (std::size_t k = p_.nodes.size() - 1; k-- > 0;) {
      DraftNode& n = p_.nodes[k];
      const bool is_flow = n.kind == Kind::jump || n.kind == Kind::branch || n.kind == Kind::merge;
      if (count[k] > 0 || is_flow) continue;
      for_operands(n, [&](std::int32_t of) { --count[static_cast<std::size_t>(of)]; });
      n = {.kind = Kind::constant};
    }
  }

  ProgramDraft& p_;
  bool changed_ = false;
};

}  // namespace

void ProgramBuilder::join_angles() {
  const bool has_angles = std::ranges::any_of(program_.atoms, [](const Atom& a) {
    constexpr std::array angles = {THETA, PSI, YAW, PITCH, INCANG, ROLL};
    return a.function->measure && std::ranges::find(angles, *a.function->measure) != angles.end();
  });
  if (has_angles) Rewriting(program_).run();
}

}  // namespace dynalin
