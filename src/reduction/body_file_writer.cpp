#include "reduction/body_file_writer.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <iterator>

namespace dynalin::reduction {

namespace {

using Eigen::Index;

// Six numbers a line.
class Numbers {
 public:
  explicit Numbers(std::ostream& out) : out_(out) {}
  void operator()(double value) {
    // -0 and 0 are one number.
    fmt::format_to(std::back_inserter(line_), "{:>25.16E}", value + 0.0);
    if (++count_ == 6) end();
  }
  void end() {
    if (count_ == 0) return;
    line_ += '\n';
    out_ << line_;
    line_.clear(), count_ = 0;
  }

 private:
  std::ostream& out_;
  std::string line_;
  int count_ = 0;
};

void begin_record(std::ostream& out, int number, std::string_view what) {
  fmt::print(out, "**\n** RECORD GROUP {}, {}\n", number, what);
}

void write_rows(std::ostream& out, int number, std::string_view what, const Eigen::MatrixXd& rows) {
  begin_record(out, number, what);
  Numbers numbers(out);
  for (Index r = 0; r < rows.rows(); ++r) {
    for (Index c = 0; c < rows.cols(); ++c) numbers(rows(r, c));
    numbers.end();
  }
}

void write_shapes(std::ostream& out, const BodyFile& body) {
  begin_record(out, 8, "MODE SHAPES");
  for (Index mode = 0; mode < body.shapes.cols(); ++mode) {
    fmt::print(out, "**    NORMAL MODE SHAPE #  {}\n", mode + 1);
    Numbers numbers(out);
    for (Index k = 0; k < body.shapes.rows(); ++k) numbers(body.shapes(k, mode));
    numbers.end();
  }
}

}  // namespace

void write_body_file(std::ostream& out, const BodyFile& body) {
  const Index n = static_cast<Index>(body.labels.size()), N = body.mass.rows();
  fmt::print(out,
             "** {}\n** RECORD GROUP 1, HEADER\n** REVISION, NODES, NORMAL, ATTACHMENT, CONSTRAINT, REJECTED MODES\n",
             body.title);
  fmt::print(out, "   REV0 {} {} 0 0 0\n", n, N);
  begin_record(out, 2, "NODES");
  for (Index k = 0; k < n; ++k)
    fmt::print(out, "{:>10}{}", body.labels[static_cast<std::size_t>(k)], k % 6 == 5 || k + 1 == n ? "\n" : "");
  write_rows(out, 5, "X OF NODES", body.places.row(0));
  write_rows(out, 6, "Y OF NODES", body.places.row(1));
  write_rows(out, 7, "Z OF NODES", body.places.row(2));
  write_shapes(out, body);
  write_rows(out, 9, "MODAL MASS", body.mass);
  write_rows(out, 10, "MODAL STIFFNESS", body.stiffness);
  begin_record(out, 12, "TOTAL MASS, CENTRE OF MASS, INERTIA ABOUT IT");
  fmt::print(out, "{:>25.16E}\n", body.total_mass);
  Numbers numbers(out);
  for (const double x : body.centre) numbers(x);
  numbers.end();
  for (Index r = 0; r < 3; ++r) {
    for (Index c = 0; c < 3; ++c) numbers(body.inertia(r, c));
    numbers.end();
  }
  write_rows(out, 14, "INVARIANT 3", body.i3);
  write_rows(out, 15, "INVARIANT 4", body.i4);
  if (body.i8.size() == 0) {
    fmt::print(out, "** END OF FILE\n");
    return;
  }
  write_rows(out, 16, "INVARIANT 8, NEGATIVE", -body.i8);
  write_rows(out, 17, "INVARIANT 5", body.i5);
  begin_record(out, 18, "INVARIANT 9");
  for (Index row = 0; row < 3; ++row) {
    for (Index j = 0; j < N; ++j) {
      for (Index k = 0; k < N; ++k) {
        for (Index column = 0; column < 3; ++column) numbers(body.i9(3 * j + row, 3 * k + column));
      }
    }
  }
  numbers.end();
  fmt::print(out, "** END OF FILE\n");
}

}  // namespace dynalin::reduction
