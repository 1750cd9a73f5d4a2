// Any bytes as a dataset: read, every argument read in every way, and a model made of it.
#include "dataset/dataset.h"

#include <memory>

#include "elements/catalogue.h"
#include "model/model.h"
#include "target.h"

namespace dynalin::fuzz {
namespace {

void use(const Dataset& dataset, Diagnostics diagnostics) {
  const SourceText& source = *dataset.source;
  const std::size_t limit = source.text().size();
  for (const Statement& statement : dataset.statements) {
    demand(std::size_t{statement.at.offset} + statement.at.length <= limit, "a statement outside its source");
    for (const WrittenArgument& argument : statement.arguments) {
      demand(std::size_t{argument.value_span().offset} + argument.value_span().length <= limit, "a value outside");
      for (const Token& token : argument.value()) demand(std::size_t{token.offset} + token.length <= limit, "a token");
      read_real(argument, source, diagnostics);
      read_reals(argument, source, diagnostics, 3);
      read_integer(argument, source, diagnostics);
      read_integers(argument, source, diagnostics);
      read_word(argument, source, diagnostics);
      read_words(argument, source, diagnostics);
      read_text(argument, source, diagnostics);
    }
  }
  demand_sound(diagnostics);
}

// Sources of other files would make the outcome depend on this machine.
bool names_files(const Dataset& dataset) {
  for (const Statement& s : dataset.statements) {
    if (s.name != "MATRIX" && s.name != "SPLINE") continue;
    for (const WrittenArgument& a : s.arguments) {
      if (a.name.text().starts_with('F') || a.name.text().starts_with('f')) return true;
    }
  }
  return false;
}

}  // namespace
}  // namespace dynalin::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  using namespace dynalin;
  const fuzz::TimeLimit limit;
  const auto source = std::make_shared<const SourceText>("fuzz.adm", fuzz::text_of(bytes, count));
  auto parsed = parse_dataset(source);
  fuzz::demand_sound(parsed.diagnostics);
  fuzz::use(parsed.value, parsed.diagnostics);
  if (fuzz::names_files(parsed.value)) return 0;
  const auto dataset = std::make_shared<const Dataset>(std::move(parsed.value));
  for (const auto& options : {BuildOptions{}, BuildOptions{.user_value = 0.5}}) {
    const auto built = build_model(dataset, catalogue(), options);
    fuzz::demand_sound(built.diagnostics);
    fuzz::demand(built.value != nullptr, "no model");
  }
  return 0;
}
