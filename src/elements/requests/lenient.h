// Reading what a model can do without: errors become warnings that end in what is left out.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/reader.h"

namespace dynalin {

// Runs `read`; what it reports as errors is said as warnings of the element that is left out: "REQUEST/3 is left out:
// it refers to MARKER/9, which does not exist".
template <class Read>
bool leniently(ElementReader& reader, const Read& read) {
  Diagnostics& all = reader.diagnostics();
  Diagnostics before = std::exchange(all, {});
  reader.name_already_said(true);
  const bool ok = read();
  reader.name_already_said(false);
  Diagnostics found = std::exchange(all, std::move(before));
  for (const Diagnostic& d : found.items()) {
    if (d.severity == Severity::error)
      all.warning("request-left-out", d.at, reader.label().full_text() + " is left out: " + d.message, d.hint).notes =
          d.notes;
    else
      all.warning(d.code, d.at, d.message, d.hint).notes = d.notes;
  }
  return ok;
}

// The argument that was read under this name, null if it was not written.
const WrittenArgument* written_argument(const ElementReader&, std::string_view name);

// Texts with a separator between them, in quotes or not, any of them empty; a mark of continuation at the start of a
// line counts as one with a comma before it. With a separator of zero the whole is one text.
std::vector<std::string> split_texts(std::string_view written, char separator);
// The same with colons between them, as lists of words have, where there is no comma outside of quotes.
std::vector<std::string> split_names(std::string_view written);

}  // namespace dynalin
