// What an element sees while its statement is read: the values as written, resolved references, and a place
// for diagnostics.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "dataset/dataset.h"
#include "expression/expression.h"
#include "mechanics/handles.h"

namespace dynalin {

struct Body;
struct Marker;

class ElementReader {
 public:
  ElementReader(const Statement& statement, const SourceText& source, Diagnostics& diagnostics,
                const ElementLabel& label)
      : statement_(&statement), source_(&source), diagnostics_(&diagnostics), label_(&label) {}
  virtual ~ElementReader() = default;

  const Statement& statement() const { return *statement_; }
  const SourceText& source() const { return *source_; }
  Diagnostics& diagnostics() { return *diagnostics_; }
  const ElementLabel& label() const { return *label_; }

  // How sentences about the statement begin: with its name, or with "it" where who reads them knows that already.
  std::string subject() const { return named_already_ ? "it" : label_->text(); }
  void name_already_said(bool is_so) { named_already_ = is_so; }

  // References; an id that does not exist is reported and yields nothing.
  virtual std::optional<MarkerId> marker(const WrittenInteger&, std::string_view argument) = 0;
  virtual std::optional<BodyId> body(std::string_view statement, const WrittenInteger&) = 0;
  virtual std::optional<ElementHandle> element(std::string_view statement, const WrittenInteger&) = 0;
  // A parsed expression whose every id exists.
  virtual std::optional<Expression> expression(const WrittenArgument&) = 0;
  virtual std::optional<VectorExpression> vector_expression(const WrittenArgument&) = 0;
  // The body statement that precedes this one in the file.
  virtual std::optional<BodyId> preceding_body() const = 0;
  // Keeps a further text alive as long as the model, for messages that point into it.
  virtual void keep(SourceRef) {}
  // A file that the model is made of, by its path: no result may take its place.
  virtual void reads(std::string) {}
  // The marker that the statement defines, null where it defines none.
  virtual Marker* own_marker() { return nullptr; }
  // The same of the body.
  virtual Body* own_body() { return nullptr; }
  // Folder of the dataset, for files it names.
  virtual std::string folder() const = 0;

  // Where the named argument stands, the statement itself if it was not written.
  Span at(std::string_view argument) const;
  bool given(std::string_view argument) const { return at_argument(argument).has_value(); }
  void error(std::string_view code, const Span& at, std::string message, std::string hint = {}) {
    diagnostics_->error(code, at, std::move(message), std::move(hint));
  }
  void warning(std::string_view code, const Span& at, std::string message, std::string hint = {}) {
    diagnostics_->warning(code, at, std::move(message), std::move(hint));
  }

  // Which written argument was read as which name; filled by read_arguments.
  struct Assignment {
    std::string_view name;
    Span at;
  };
  std::vector<Assignment> assignments;
  bool label_is_known = false;  // the remark on LABEL has been made, of whichever statement

 private:
  std::optional<Span> at_argument(std::string_view argument) const;

  const Statement* statement_;
  const SourceText* source_;
  Diagnostics* diagnostics_;
  const ElementLabel* label_;
  bool named_already_ = false;
};

}  // namespace dynalin
