#include "dynalin/nastran_deck.h"

#include <iostream>

#include "library/inside.h"
#include "nastran/configuration.h"
#include "nastran/export.h"
#include "output/output_file.h"

namespace dynalin::library {

NastranDeck nastran_deck(const LinearModel& model, NastranBox which, const std::string& name,
                         const std::string& configuration) {
  const nastran::Box box = which == NastranBox::open ? nastran::Box::open : nastran::Box::closed;
  auto read = nastran::read_configuration(std::make_shared<const SourceText>("configuration", configuration), box);
  nastran::check_references(read.value, model.inside().linear.system->model(), read.diagnostics);
  if (read.diagnostics.has_errors()) throw Error(render(read.diagnostics), remarks_of(read.diagnostics));
  // An open box is put together element by element.
  const bool of_elements = box == nastran::Box::open && !read.value.options.export_mode_shapes;
  const Linearization& linear = of_elements ? model.inside().linear : model.inside().whole();
  NastranDeck deck;
  deck.remarks = remarks_of(read.diagnostics);
  nastran::ExportedDeck made =
      value_or_throw(nastran::export_deck(linear, box, read.value.options, name), deck.remarks);
  append(deck.remarks, remarks_of(made.remarks));
  for (nastran::DeckFile& file : made.files) deck.files.push_back({std::move(file.name), std::move(file.text)});
  return deck;
}

NastranDeck export_nastran(const LinearModel& model, NastranBox which, const std::string& name,
                           const std::string& configuration) {
  NastranDeck deck = nastran_deck(model, which, name, configuration);
  const auto refuse = [&](const std::string& why) { fail(Failure{"export", why, {}}, deck.remarks); };
  std::vector<std::unique_ptr<OutputFile>> files;
  for (const NastranDeck::File& file : deck.files) {
    auto destination = find_destination(file.name);
    if (!destination) refuse("cannot write " + file.name + ": " + destination.error());
    auto made = OutputFile::create(std::move(*destination));
    if (!made) refuse(made.error());
    (*made)->stream() << file.text;
    if (auto complete = (*made)->complete(); !complete) refuse(complete.error());
    files.push_back(std::move(*made));
  }
  if (auto committed = commit(files, std::cout); !committed) refuse(committed.error());
  return deck;
}

}  // namespace dynalin::library
