// State equations of compiled routines in a draw: of what the mechanism does, and pushing it.
#include <utility>

#include "generator.h"

namespace dynalin::oracle {

void Draw::draw_gse() {
  if (!must_call_) return;
  std::swap(random_, state_random_);
  const auto numbers = [&](int count, double size) {
    std::vector<double> list;
    for (int k = 0; k < count; ++k) list.push_back(uniform(-size, size));
    return list;
  };
  Gse e;
  e.id = 1;
  e.states = 1 + pick(2), e.inputs = 1 + pick(2), e.outputs = 1 + pick(2);
  e.implicit = chance(0.4);
  Array u{next_array_++, ArrayKind::u, {}, {}};
  for (int k = 0; k < e.inputs; ++k) u.variables.push_back(k > 0 && chance(0.5) ? one_of(inputs_) : one_of(features_));
  const Array x{next_array_++, ArrayKind::x, {}, {}}, y{next_array_++, ArrayKind::y, {}, {}},
      ic{next_array_++, ArrayKind::ic, {}, numbers(e.states, 1)};
  e.x = x.id, e.u = u.id, e.y = y.id, e.ic = ic.id;
  for (const Array& a : {u, x, y, ic}) m_.arrays.push_back(a);
  e.a = numbers(e.states * e.states, 1.5), e.b = numbers(e.states * e.inputs, 1);
  e.c = numbers(e.outputs * e.states, 0.7), e.d = numbers(e.outputs * e.inputs, 0.3);
  e.e = numbers(e.states, 1), e.g = numbers(e.outputs, 0.7);
  m_.gses.push_back(e);
  states_.push_back(aryval(e.y, 1 + pick(e.outputs)));
  states_.push_back(aryval(e.x, e.states));
  std::swap(random_, state_random_);
}

// Every output pushes something.
void Draw::read_gse() {
  if (!must_call_) return;
  std::swap(random_, state_random_);
  const Gse& e = m_.gses[0];
  for (int k = 1; k <= e.outputs; ++k) {
    Sforce& s = m_.sforces[static_cast<std::size_t>(pick(static_cast<int>(m_.sforces.size())))];
    const double size = s.direction == Direction::rotational ? 0.5 * F_ * L_ : F_;
    s.function = s.function + size * uniform(0.2, 0.7) * aryval(e.y, k);
  }
  std::swap(random_, state_random_);
}

}  // namespace dynalin::oracle
