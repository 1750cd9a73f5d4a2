// TFSISO/id, X=, U=, Y=, NUMERATOR=, DENOMINATOR= [, IC=] [, STATIC_HOLD]
//
// A transfer function Σ b_j s^j / Σ a_j s^j with one input and one output, coefficients in ascending powers. With
// k = degree of the denominator, p = a/a_k and q = b/a_k it is realized in observer canonical form:
//
//         ⎡ −p(k−1) 1 0 … ⎤        ⎡ q(k−1) − p(k−1) q(k) ⎤
//     A = ⎢ −p(k−2) 0 1 … ⎥,   B = ⎢ q(k−2) − p(k−2) q(k) ⎥,   C = [1 0 … 0],   D = q(k)
//         ⎣   …           ⎦        ⎣   …                  ⎦
//
// so that 10/(1 + 0.005 s) is z′ = −200 z + 2000 u, y = z: the gain sits at the input.
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>

#include "elements/controls/array.h"
#include "elements/families/linear_states.h"
#include "model/model.h"
#include "model/schema.h"
#include "model/told_beforehand.h"

namespace dynalin {

namespace {

constexpr double widest_spread = 1e100;  // of poles: their squares, and sums of those, are numbers

struct Tfsiso {
  ArrayRef x, u, y, initial;
  std::vector<double> numerator, denominator;
  bool static_hold = false;
  LinearStates law;

  static constexpr std::array<Argument<Tfsiso>, 7> arguments = {{
      {.name = "X", .slot = &Tfsiso::x, .help = "ARRAY of type X for the states"},
      {.name = "U", .slot = &Tfsiso::u, .required = true, .help = "ARRAY of type U with one input"},
      {.name = "Y", .slot = &Tfsiso::y, .required = true, .help = "ARRAY of type Y for the output"},
      {.name = "NUMERATOR",
       .slot = &Tfsiso::numerator,
       .required = true,
       .unit = "y/u·time^j",
       .help = "b0, b1 … in ascending powers"},
      {.name = "DENOMINATOR",
       .slot = &Tfsiso::denominator,
       .required = true,
       .unit = "time^j",
       .help = "a0, a1 … in ascending powers"},
      {.name = "IC", .slot = &Tfsiso::initial, .help = "ARRAY with the initial states", .start = StatedStart::value},
      {.name = "STATIC_HOLD", .slot = &Tfsiso::static_hold, .help = "states keep their values in statics"},
  }};

  Eigen::Index degree() const { return static_cast<Eigen::Index>(denominator.size()) - 1; }

  // How many times as fast as the slowest pole that moves the fastest one is, by the corners of the coefficients'
  // sizes: the upper hull of log |a_j| over j has the slopes −log |s|.
  double spread() const {
    double slowest = std::numeric_limits<double>::infinity(), fastest = 0;
    std::size_t at = 0;
    while (at < denominator.size() && denominator[at] == 0.0) ++at;
    while (at + 1 < denominator.size()) {
      std::size_t next = at + 1;
      double corner = std::numeric_limits<double>::infinity();
      for (std::size_t j = at + 1; j < denominator.size(); ++j) {
        const double pole = std::pow(std::abs(denominator[at] / denominator[j]), 1.0 / static_cast<double>(j - at));
        if (pole <= corner) corner = pole, next = j;
      }
      slowest = std::min(slowest, corner), fastest = std::max(fastest, corner);
      at = next;
    }
    return slowest > 0 ? fastest / slowest : 0;
  }

  void realize() {
    const Eigen::Index k = degree();
    const auto p = [&](Eigen::Index j) { return denominator[static_cast<std::size_t>(j)] / denominator.back(); };
    const auto q = [&](Eigen::Index j) {
      const auto at = static_cast<std::size_t>(j);
      return at < numerator.size() ? numerator[at] / denominator.back() : 0.0;
    };
    law.A = Eigen::MatrixXd::Zero(k, k);
    law.B = Eigen::MatrixXd::Zero(k, 1);
    law.C = Eigen::MatrixXd::Zero(1, k);
    law.D = Eigen::MatrixXd::Constant(1, 1, q(k));
    for (Eigen::Index r = 0; r < k; ++r) {
      law.A(r, 0) = -p(k - 1 - r);
      if (r + 1 < k) law.A(r, r + 1) = 1.0;
      law.B(r, 0) = q(k - 1 - r) - p(k - 1 - r) * q(k);
    }
    if (k > 0) law.C(0, 0) = 1.0;
  }
};

class TfsisoSet final : public TypedSet<Tfsiso> {
 public:
  using TypedSet::TypedSet;

  void read(std::size_t k, ElementReader& reader) override {
    Tfsiso& e = elements[k];
    if (!read_arguments(e, reader)) return;
    const std::string name = reader.label().text();
    if (e.denominator.back() == 0.0) {
      reader.error("zero-leading-coefficient", reader.at("DENOMINATOR"),
                   fmt::format("the last coefficient of the DENOMINATOR of {} is zero", name));
    } else if (e.numerator.size() > e.denominator.size()) {
      reader.error("improper-transfer-function", reader.at("NUMERATOR"),
                   fmt::format("{} has a NUMERATOR of higher degree than its DENOMINATOR", name));
    } else if (const double spread = e.spread(); spread > widest_spread) {
      reader.error(
          "spread-poles", reader.at("DENOMINATOR"),
          fmt::format("the poles of {} lie a factor of {:.0e} apart, more than numbers can hold", name, spread),
          "leave out the last coefficient, if it is meant as nothing");
    } else {
      e.realize();
    }
    if (e.degree() > 0 && !e.x.valid()) {
      reader.error("missing-argument", reader.statement().at, fmt::format("{} needs X", name));
    }
  }

  void finish(Model& model, Diagnostics& diagnostics) override {
    for (std::size_t k = 0; k < elements.size(); ++k) {
      Tfsiso& e = elements[k];
      e.law.type = StateType::tfsiso;
      e.law.held_in_statics = e.static_hold;
      const Array* u = input_array(model, e.u, labels[k], diagnostics);
      if (u && u->variables.size() != 1) {
        diagnostics.error("wrong-size", labels[k].at,
                          fmt::format("U of {} must have one entry, it has {}", labels[k].text(), u->variables.size()));
      }
      if (u) e.law.inputs = u->variables;
      const auto degree = static_cast<std::size_t>(e.degree());
      if (e.initial.valid()) {
        const Array& ic = *model.get<Array>(e.initial);
        if (ic.numbers.size() != degree) {
          diagnostics.error("wrong-size", labels[k].at,
                            fmt::format("IC of {} must hold {} numbers", labels[k].text(), degree));
        } else {
          e.law.initial = ic.numbers;
        }
      }
      const ElementHandle self = *model.find("TFSISO", labels[k].id);
      if (e.x.valid()) claim_array(model, e.x, 'X', degree, self, labels[k], diagnostics);
      claim_array(model, e.y, 'Y', 1, self, labels[k], diagnostics);
    }
  }

  std::unique_ptr<Kernel> make_kernel(const Model&, Layout& layout) const override {
    std::vector<LinearStates> laws;
    for (const Tfsiso& e : elements) laws.push_back(e.law);
    return std::make_unique<LinearStatesKernel>(std::move(laws), labels, layout);
  }
};

}  // namespace

namespace {

std::vector<FilledList> filled_by_tfsiso(const StatementWords& s) {
  const std::size_t coefficients = s.reals("DENOMINATOR").size();
  const auto states = coefficients > 0 ? std::optional(coefficients - 1) : std::nullopt;
  return {{ArrayClass::statement, s.integer("X"), states}, {ArrayClass::statement, s.integer("Y"), std::size_t{1}}};
}
constexpr ToldBeforehand told_of_tfsiso = {.fills = filled_by_tfsiso};

}  // namespace

extern constinit const Kind tfsiso =
    Kind{"TFSISO",
         "",
         "A transfer function with one input and one output.",
         Kind::Role::element,
         detail::argument_infos<Tfsiso>,
         [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<TfsisoSet>(kind); }}
        .telling(told_of_tfsiso)
        .with_example("TFSISO/1, NUMERATOR=2");

}  // namespace dynalin
