#include "reduction/body_check.h"

#include <fmt/format.h>

#include "flexible/modal_body.h"

namespace dynalin::reduction {

namespace {

// Beyond this, rigid motions of the matrices have no mass that is one number.
constexpr double one_mass = 1e-6;

std::vector<double> row_by_row(const Eigen::MatrixXd& sums) {
  const Eigen::MatrixXd columns = sums.transpose();
  return {columns.data(), columns.data() + columns.size()};
}

// The records that masses and stiffness are looked at in: 9, 10, 12, 14 and 15.
ModalText records_of(const BodyFile& body) {
  ModalText t;
  t.displacement = t.rate = Eigen::VectorXd::Zero(body.mass.rows());
  t.mass = body.mass, t.stiffness = body.stiffness;
  ModalText::Whole whole;
  whole.mass = body.total_mass;
  whole.centre = {body.centre[0], body.centre[1], body.centre[2]};
  for (Eigen::Index r = 0; r < 3; ++r) {
    for (Eigen::Index c = 0; c < 3; ++c)
      whole.inertia(static_cast<std::size_t>(r), static_cast<std::size_t>(c)) = body.inertia(r, c);
  }
  t.whole = whole;
  t.translation_sums = row_by_row(body.i3), t.turning_sums = row_by_row(body.i4);
  return t;
}

std::string way_out(const Reduction& reduction) {
  std::string hint;
  const MassProperties& p = reduction.properties;
  if (p.uneven > one_mass)
    hint = fmt::format("the mass in the matrices differs between x, y and z by {:.1e}, a body has one mass", p.uneven);
  constexpr Eigen::Index all_motions = 6;
  if (reduction.rigid_removed == all_motions) return hint;
  if (!hint.empty()) hint += "; ";
  return hint + fmt::format(
                    "the matrices hold the body against {} of its 6 motions as a whole, and a FLEX_BODY has "
                    "all of these besides its modes: leave freedoms that were held in the matrices and hold "
                    "the body there by a JOINT at an interface node; leave springs to ground to BUSHINGs",
                    all_motions - reduction.rigid_removed);
}

}  // namespace

bool check_body(const BodyFile& body, const Reduction& reduction, const std::string& file, Diagnostics& diagnostics) {
  const SourceText text(file, "");
  Diagnostics found;
  if (modal_body_of(records_of(body), text, found)) return true;
  const std::string hint = way_out(reduction);
  for (const Diagnostic& d : found.items()) {
    if (d.severity == Severity::error)
      diagnostics.error("fe-body", Span{}, fmt::format("no FLEX_BODY would take the reduced body: {}", d.message),
                        hint.empty() ? d.hint : hint);
  }
  return false;
}

}  // namespace dynalin::reduction
