#include "nastran/export.h"

#include "nastran/closed_box.h"
#include "nastran/file_names.h"
#include "nastran/open_box.h"

namespace dynalin::nastran {

StudyResult<ExportedDeck> export_deck(const Linearization& linear, Box box, const ExportOptions& options,
                                      const std::string& file) {
  ExportedDeck made;
  auto deck = box == Box::open ? open_box(linear, options, made.remarks) : closed_box(linear, options, made.remarks);
  if (!deck) {
    StudyFailure failure = std::move(deck.error());
    made.remarks.append(std::move(failure.remarks));
    failure.remarks = std::move(made.remarks);
    return tl::unexpected(std::move(failure));
  }
  auto text = deck_text(std::move(*deck), options, file);
  if (!text)
    return tl::unexpected(
        StudyFailure({"export", "the deck cannot be written", std::move(text.error())}, std::move(made.remarks)));
  made.files = std::move(text->files);
  made.remarks.append(std::move(text->remarks));
  made.details = std::move(text->details);
  return made;
}

std::vector<std::string> expected_files(Box box, const ExportOptions& options, const std::string& file) {
  const FileNames names(file, options);
  std::vector<std::string> list = {names.main()};
  if (options.export_mode_shapes && box == Box::open) list.push_back(names.punch());
  if (!options.use_includes) return list;
  if (options.file_name_style == FileStyle::C)
    list.insert(list.end(), {names.of("PROPERTY"), names.of("CONNECTIVITY")});
  else
    list.push_back(names.model());
  return list;
}

}  // namespace dynalin::nastran
