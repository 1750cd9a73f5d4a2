#include "system/row_terms.h"

#include "system/sources.h"

namespace dynalin {

std::vector<RowTerms> row_terms(const System& system, const Motion& motion) {
  std::vector<RowTerms> rows(system.layout().rows.size());
  for_each_source<RowTermsSource>(
      system, [&](const ElementSet&, const RowTermsSource& source) { source.tell_row_terms(motion, rows); });
  return rows;
}

}  // namespace dynalin
