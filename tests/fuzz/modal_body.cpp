// Any bytes as the file of a flexible body: a body that can be simulated, or an error at its line.
#include "flexible/modal_body.h"

#include "flexible/body_file_type.h"
#include "target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  using namespace dynalin;
  const fuzz::TimeLimit limit;
  const SourceText file("body.fem", fuzz::text_of(bytes, count));
  (void)body_file_type(file.text());
  Diagnostics found;
  auto text = read_modal_text(file, found);
  fuzz::demand_sound(found);
  fuzz::demand(text.has_value() != found.has_errors(), "neither a text nor an error, or both");
  if (!text) return 0;
  const auto body = modal_body_of(std::move(*text), file, found);
  fuzz::demand_sound(found);
  fuzz::demand(body.has_value() != found.has_errors(), "neither a body nor an error, or both");
  if (!body) return 0;
  const OwnModes own = own_modes(*body, 1000);
  fuzz::demand(own.frequency.allFinite() && own.shapes.allFinite(), "a body without modes of its own");
  return 0;
}
