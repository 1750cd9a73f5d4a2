// What a statement says to the routine that it calls beside constants.
#include "model/called_words.h"

namespace dynalin {

std::string_view CalledRoutines::Words::written(std::string_view argument) const {
  const WrittenArgument* w = routines_.argument(statement_, argument);
  return w && w->has_value ? w->value_span().text() : std::string_view();
}

std::optional<std::size_t> CalledRoutines::Words::word_among(std::span<const std::string_view> words) const {
  for (const WrittenArgument& w : statement_.arguments) {
    if (w.has_value) continue;
    if (const auto k = find_keyword(w.name.text(), words)) return k;
  }
  return std::nullopt;
}

int CalledRoutines::Words::integer_of(std::string_view statement, int id, std::string_view argument) const {
  const Statement* s = routines_.statement(statement, id);
  return s ? routines_.integer(*s, argument) : 0;
}

bool CalledRoutines::Words::slides(int joint) const {
  const Statement* s = routines_.statement(JointClass::statement, joint);
  if (!s) return false;
  Diagnostics ignored;
  std::size_t which = 0;
  const Kind* kind = routines_.finder_.find(*s, which, ignored);
  return kind && kind->slides;
}

// Null where the modes are not known.
std::shared_ptr<const RoutineStatement::ModalLoad> CalledRoutines::modal_load_of(const Statement& s,
                                                                                 bool scaled) const {
  const RoutineData::Modes* modes = modes_of(integer(s, "FLEX_BODY"));
  if (!modes) return nullptr;
  return std::make_shared<const RoutineStatement::ModalLoad>(
      RoutineStatement::ModalLoad{integer(s, "FLEX_BODY"), modes->number.size(), modes->cases, modes->loads, scaled});
}

CurveStatement CalledRoutines::curve_of(const Statement& s, const RoutineStatement& what) const {
  CurveStatement c{what.element, what.id, *what.constants, argument(s, "CLOSED") != nullptr, integer(s, "ORDER")};
  if (argument(s, "MINPAR")) c.first = real(s, "MINPAR");
  if (argument(s, "MAXPAR")) c.last = real(s, "MAXPAR");
  return c;
}

std::optional<RoutineStatement> CalledRoutines::says(const Statement& s, const WrittenArgument* call,
                                                     const RoutineKind& kind) {
  RoutineStatement out;
  out.element = {std::string(s.name), s.id.value_or(0)};
  out.id = static_cast<int>(s.id.value_or(0));
  out.constant_arrays = constant_arrays_, out.data = data_;
  std::vector<double> constants;
  if (call) {
    auto read = constants_of(*call, out.element);
    if (!read) return std::nullopt;
    constants = std::move(*read);
  }
  out.constants = std::make_shared<const RoutineConstants>(constants);
  if (kind.told) out.told = kind.told(Words(*this, s, *out.constants));
  out.I = integer(s, "I"), out.J = integer(s, "J");
  return out;
}

}  // namespace dynalin
