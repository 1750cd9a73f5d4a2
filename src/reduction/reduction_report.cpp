#include "reduction/reduction_report.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <cmath>
#include <numbers>

#include "base/cycle.h"

namespace dynalin::reduction {

namespace {

void print_frequencies(std::ostream& out, std::string_view title, const Eigen::VectorXd& squares) {
  fmt::print(out, "{}, cycles per unit of time\n", title);
  for (Eigen::Index k = 0; k < squares.size(); ++k) {
    const bool last = k % 5 == 4 || k + 1 == squares.size();
    fmt::print(out, "{:>16.9g}{}", std::sqrt(squares[k]) / cycle, last ? "\n" : "");
  }
}

}  // namespace

void print_report(std::ostream& out, const FiniteElementModel& model, const ReductionRequest& request,
                  const Reduction& r) {
  const MassProperties& p = r.properties;
  fmt::print(out, "{} freedoms, {} interface node{} with {} of them\n", model.freedoms.size(), request.interface.size(),
             request.interface.size() == 1 ? "" : "s", r.constraint_modes);
  fmt::print(out, "{} constraint modes + {} fixed-interface modes - {} rigid motions = {} modes\n", r.constraint_modes,
             r.fixed_interface.size(), r.rigid_removed, r.shapes.cols());
  if (r.massless > 0)
    fmt::print(out,
               "{} of them without mass, the last ones: they yield at the interface, as if they vibrated at 100 times "
               "the highest frequency of the others\n",
               r.massless);
  if (r.rigid_removed < 6)
    fmt::print(
        out,
        "the matrices hold the body: only {} of 6 rigid motions strain nothing\n"
        "a FLEX_BODY is free all the same: hold it again where they do, by a joint at a node of the file (--also), "
        "or leave springs to ground to BUSHINGs\n",
        r.rigid_removed);
  fmt::print(out, "rigid motions strain it by {:.1e} of its stiffness; modes are orthogonal to {:.1e}\n",
             r.strain_of_rigid, r.off_diagonal);
  fmt::print(out, "mass {:.12g}, in x, y and z equal to {:.1e}\n", p.mass, p.uneven);
  fmt::print(out, "centre {:.12g} {:.12g} {:.12g}\n", p.centre[0], p.centre[1], p.centre[2]);
  const Eigen::Matrix3d& J = p.inertia;
  fmt::print(out, "inertia tensor about it, xx yy zz xy xz yz: {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g}\n", J(0, 0),
             J(1, 1), J(2, 2), J(0, 1), J(0, 2), J(1, 2));
  if (r.fixed_interface.size() > 0) print_frequencies(out, "frequencies with the interface held", r.fixed_interface);
  if (r.squares.size() == r.massless) return;
  print_frequencies(out, r.rigid_removed == 6 ? "frequencies of the free body" : "frequencies of the body",
                    r.squares.head(r.squares.size() - r.massless));
}

}  // namespace dynalin::reduction
