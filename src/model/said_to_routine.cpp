// What a statement says to the routine that it calls beside constants.
#include <algorithm>
#include <array>
#include <string>

#include "model/called_routines.h"
#include "routine/statement_words.h"

namespace dynalin {

class CalledRoutines::Words final : public StatementWords {
 public:
  Words(const CalledRoutines& routines, const Statement& s, const RoutineConstants& constants)
      : routines_(routines), statement_(s), constants_(constants) {}

  int id() const override { return static_cast<int>(statement_.id.value_or(0)); }
  const RoutineConstants& constants() const override { return constants_; }
  bool has(std::string_view argument) const override { return routines_.argument(statement_, argument) != nullptr; }
  int integer(std::string_view argument) const override { return routines_.integer(statement_, argument); }
  std::vector<int> integers(std::string_view argument) const override {
    return routines_.integers(statement_, argument);
  }
  double real(std::string_view argument, std::size_t which) const override {
    return routines_.real(statement_, argument, which);
  }
  std::string text(std::string_view argument) const override { return routines_.text(statement_, argument); }
  std::string_view written(std::string_view argument) const override {
    const WrittenArgument* w = routines_.argument(statement_, argument);
    return w && w->has_value ? w->value_span().text() : std::string_view();
  }
  std::optional<std::size_t> word_among(std::span<const std::string_view> words) const override {
    return word_of(statement_, words);
  }
  bool slides(int joint) const override {
    static constexpr std::array<std::string_view, 1> way = {"TRANSLATIONAL"};
    return std::ranges::any_of(routines_.dataset_.statements, [&](const Statement& j) {
      return j.name == "JOINT" && j.id == joint && word_of(j, way).has_value();
    });
  }

 private:
  static std::optional<std::size_t> word_of(const Statement& s, std::span<const std::string_view> words) {
    for (const WrittenArgument& w : s.arguments) {
      if (w.has_value) continue;
      if (const auto k = find_keyword(w.name.text(), words)) return k;
    }
    return std::nullopt;
  }

  const CalledRoutines& routines_;
  const Statement& statement_;
  const RoutineConstants& constants_;
};

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
