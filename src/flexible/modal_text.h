// Modal body files: the text that programs write of a reduced finite-element body (`.fem`), record by record as it
// stands. What is made of them is modal_body.h.
//
// A record begins with a line `** RECORD GROUP n`; lines behind its numbers are comments. Record 1 comes first.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "base/source.h"
#include "base/vec3.h"

namespace dynalin {

struct ModalText {
  static constexpr std::size_t records = 20;  // numbered from 1

  std::vector<Span> node_at;  // their labels, record 2
  std::vector<std::string> labels;
  Eigen::VectorXd displacement, rate;      // of the modes at the start, records 3 and 4; 0 where they are missing
  std::vector<Vector> position;            // records 5, 6, 7
  Eigen::MatrixXd translation, rotation;   // record 8: x, y, z of each node in turn, a column for each mode
  Eigen::MatrixXd mass, stiffness;         // records 9 and 10
  std::optional<Eigen::MatrixXd> damping;  // 13
  std::optional<std::vector<std::array<double, 6>>> lumped;  // 11: mass along x, y, z, inertia about x, y, z
  struct Whole {
    double mass = 0;
    Vector centre;
    Matrix3 inertia;  // about the centre
  };
  std::optional<Whole> whole;  // 12
  // 14 to 18, in the order of the file: rows of x, y, z one behind the other.
  std::optional<std::vector<double>> translation_sums, turning_sums, tensor_sums, turning_products, tensor_products;

  std::array<Span, records> at{};  // where each record begins

  std::size_t nodes() const { return labels.size(); }
  Eigen::Index modes() const { return displacement.size(); }
};

// Reads all records; nothing after an error, which stands at its line of the file.
std::optional<ModalText> read_modal_text(const SourceText&, Diagnostics&);

}  // namespace dynalin
