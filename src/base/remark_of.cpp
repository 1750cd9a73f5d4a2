#include "base/remark_of.h"

namespace dynalin {

Remark remark_of(const Diagnostic& d) {
  Remark remark;
  remark.severity = d.severity == Severity::error     ? Remark::Severity::error
                    : d.severity == Severity::warning ? Remark::Severity::warning
                                                      : Remark::Severity::note;
  remark.code = d.code, remark.message = d.message, remark.hint = d.hint;
  if (d.at.source) {
    const SourceText::Place place = d.at.source->place(d.at.offset);
    remark.file = d.at.source->name(), remark.line = place.line, remark.column = place.column;
  }
  return remark;
}

std::vector<Remark> remarks_of(const Diagnostics& all) {
  std::vector<Remark> remarks;
  for (const Diagnostic& d : all.items()) remarks.push_back(remark_of(d));
  return remarks;
}

}  // namespace dynalin
