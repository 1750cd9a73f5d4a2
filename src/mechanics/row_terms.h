// What constraint rows say of themselves beyond their values: an angle with all its turns is large beside what is left
// of it in a row, and where a MOTION turns something the row knows it but for whole turns.
#pragma once

#include <optional>
#include <span>

#include "mechanics/motion.h"

namespace dynalin {

struct RowTerms {
  double size = 0;                     // of the terms that its value is a difference of, where poses do not tell
  std::optional<double> driven_angle;  // that it is driven to, with all turns
};

class RowTermsSource {
 public:
  // Into the places of its own rows among all.
  virtual void tell_row_terms(const Motion&, std::span<RowTerms> rows) const = 0;

 protected:
  ~RowTermsSource() = default;
};

}  // namespace dynalin
