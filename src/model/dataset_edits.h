// Statements changed by statements: NAME/id, ARG=… defines arguments of one anew, and elements are taken out of the
// model and into it again. A new model is made of what comes out.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>

#include "model/kind_finder.h"
#include "model/restated.h"

namespace dynalin {

struct EditedDataset {
  std::shared_ptr<const Dataset> dataset;  // the one before where no statement is another one
  Restated restated;
};

// Works on a copy of the statements, which share texts and tokens with those they come from. What is wrong with an edit
// itself is reported at its place; what its values lead to is found when the model is made.
class DatasetEditor {
 public:
  // `written` holds the statements that are applied.
  DatasetEditor(std::shared_ptr<const Dataset> base, std::shared_ptr<const Dataset> written, Catalogue, Diagnostics&);

  // The arguments that the statement gives, and another type of it; the others stay.
  void redefine(const Statement&);
  // CLASS, ID=… or RANGE=… of a statement that takes elements out, or in again. `classes` are listed where it names
  // none of those that can be.
  void switch_elements(const Statement&, bool inactive, std::span<const std::string_view> classes);

  EditedDataset finish() &&;

 private:
  std::optional<std::size_t> place_of(std::string_view statement, std::int64_t id) const;
  Statement& changed(std::size_t place);
  const Kind* kind_of(const Statement&) const;
  bool is_setting(std::string_view statement) const;
  void merge(Statement& target, const Statement&);
  void note_start(const Statement&, const ArgumentInfo&);
  bool read_class(const WrittenArgument&, const Statement&, std::string_view& statement,
                  std::span<const std::string_view> classes);
  void switch_range(const WrittenArgument& range, std::string_view statement, bool inactive);
  void switch_one(Statement&, bool inactive, const Span& at);

  bool is_as_before(std::size_t place) const;
  void drop_origins();

  KindFinder finder_;
  std::shared_ptr<const Dataset> base_;
  std::shared_ptr<Dataset> out_;
  Restated restated_;
  Diagnostics& diagnostics_;
  std::unordered_map<std::string, std::size_t> place_;
  std::set<std::size_t> touched_;  // statements
};

}  // namespace dynalin
