// LSE/id, X=, A= [, U=, B=] [, Y=, C=] [, D=] [, IC=] [, STATIC_HOLD]
//
// Linear state equations z′ = A z + B u, y = C z + D u. A is n × n; U needs B or D, C or D need Y. IC is an array of n
// initial values, zero by default.
#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "elements/controls/array.h"
#include "elements/controls/matrix.h"
#include "elements/families/linear_states.h"
#include "model/model.h"
#include "model/schema.h"
#include "model/told_beforehand.h"

namespace dynalin {

namespace {

struct Lse {
  ArrayRef x, u, y, initial;
  MatrixRef A, B, C, D;
  bool static_hold = false;
  LinearStates law;  // filled when all matrices are known

  static constexpr std::array<Argument<Lse>, 9> arguments = {{
      {.name = "X", .slot = &Lse::x, .required = true, .help = "ARRAY of type X for the states"},
      {.name = "A", .slot = &Lse::A, .required = true, .help = "MATRIX n × n"},
      {.name = "U", .slot = &Lse::u, .help = "ARRAY of type U with the inputs"},
      {.name = "B", .slot = &Lse::B, .help = "MATRIX n × number of inputs"},
      {.name = "Y", .slot = &Lse::y, .help = "ARRAY of type Y for the outputs"},
      {.name = "C", .slot = &Lse::C, .help = "MATRIX number of outputs × n"},
      {.name = "D", .slot = &Lse::D, .help = "MATRIX number of outputs × number of inputs"},
      {.name = "IC", .slot = &Lse::initial, .help = "ARRAY with the initial states", .start = StatedStart::value},
      {.name = "STATIC_HOLD", .slot = &Lse::static_hold, .help = "states keep their values in statics"},
  }};
};

class LseSet final : public TypedSet<Lse> {
 public:
  using TypedSet::TypedSet;

  void read(std::size_t k, ElementReader& reader) override {
    const Lse& e = elements[k];
    if (!read_arguments(elements[k], reader)) return;
    const std::string name = reader.label().text();
    const auto need = [&](bool wrong, std::string_view argument, std::string_view needed) {
      if (wrong) {
        reader.error("missing-argument", reader.at(argument), fmt::format("{} of {} needs {}", argument, name, needed));
      }
    };
    need(e.u.valid() && !e.B.valid() && !e.D.valid(), "U", "B or D");
    need(e.B.valid() && !e.u.valid(), "B", "U");
    need(e.C.valid() && !e.y.valid(), "C", "Y");
    need(e.D.valid() && (!e.y.valid() || !e.u.valid()), "D", "Y and U");
    need(e.y.valid() && !e.C.valid() && !e.D.valid(), "Y", "C or D");
  }

  void finish(Model& model, Diagnostics& diagnostics) override {
    for (std::size_t k = 0; k < elements.size(); ++k) complete(k, model, diagnostics);
  }

  std::unique_ptr<Kernel> make_kernel(const Model&, Layout& layout) const override {
    std::vector<LinearStates> laws;
    for (const Lse& e : elements) laws.push_back(e.law);
    return std::make_unique<LinearStatesKernel>(std::move(laws), labels, layout);
  }

 private:
  void complete(std::size_t k, Model& model, Diagnostics& diagnostics) {
    Lse& e = elements[k];
    LinearStates& law = e.law;
    law.type = StateType::lse;
    law.held_in_statics = e.static_hold;
    const Matrix& A = *model.get<Matrix>(e.A);
    const std::size_t n = A.rows;
    if (e.u.valid()) {
      const Array* u = input_array(model, e.u, labels[k], diagnostics);
      if (!u) return;
      law.inputs = u->variables;
    }
    const std::size_t inputs = law.inputs.size();
    const std::size_t outputs = e.C.valid()   ? model.get<Matrix>(e.C)->rows
                                : e.D.valid() ? model.get<Matrix>(e.D)->rows
                                              : 0;
    const auto take = [&](MatrixRef ref, char name, std::size_t rows, std::size_t columns) {
      Eigen::MatrixXd out = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
      if (!ref.valid()) return out;
      const Matrix& m = *model.get<Matrix>(ref);
      if (m.rows != rows || m.columns != columns) {
        diagnostics.error("wrong-size", labels[k].at,
                          fmt::format("{} of {} must be {} × {}, {} is {} × {}", name, labels[k].text(), rows, columns,
                                      model.label(ref).text(), m.rows, m.columns));
        return out;
      }
      for (std::size_t r = 0; r < rows; ++r) {
        for (std::size_t c = 0; c < columns; ++c) {
          out(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = m(r, c);
        }
      }
      return out;
    };
    law.A = take(e.A, 'A', n, n);
    law.B = take(e.B, 'B', n, inputs);
    law.C = take(e.C, 'C', outputs, n);
    law.D = take(e.D, 'D', outputs, inputs);
    if (e.initial.valid()) {
      const Array& ic = *model.get<Array>(e.initial);
      if (ic.u || ic.x || ic.y || ic.numbers.size() != n) {
        diagnostics.error("wrong-size", labels[k].at,
                          fmt::format("IC of {} must hold {} numbers", labels[k].text(), n));
      } else {
        law.initial = ic.numbers;
      }
    }
    const ElementHandle self = *model.find("LSE", labels[k].id);
    claim_array(model, e.x, 'X', n, self, labels[k], diagnostics);
    if (e.y.valid()) claim_array(model, e.y, 'Y', outputs, self, labels[k], diagnostics);
  }
};

}  // namespace

namespace {

// As many as the matrices have rows, where that is written.
std::vector<FilledList> filled_by_lse(const StatementWords& s) {
  std::vector<FilledList> lists;
  const auto take = [&](std::string_view array, std::string_view matrix) {
    const auto rows = known_size(
        static_cast<std::size_t>(std::max(s.integer_of(MatrixClass::statement, s.integer(matrix), "ROWS"), 0)));
    if (rows) lists.push_back({ArrayClass::statement, s.integer(array), rows});
  };
  take("X", "A"), take("Y", s.integer("C") > 0 ? "C" : "D");
  return lists;
}
constexpr ToldBeforehand told_of_lse = {.fills = filled_by_lse};

}  // namespace

extern constinit const Kind lse = Kind{
    "LSE",
    "",
    "Linear state equations.",
    Kind::Role::element,
    detail::argument_infos<Lse>,
    [](const Kind& kind) -> std::unique_ptr<ElementSet> {
      return std::make_unique<LseSet>(kind);
    }}.telling(told_of_lse);

}  // namespace dynalin
