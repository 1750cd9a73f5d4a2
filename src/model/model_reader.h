// What an element sees of the model while its statement is read (reader.h): ids as handles, expressions whose every id
// exists, files and texts that are kept.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "model/model.h"
#include "model/reader.h"
#include "model/user_routines.h"

namespace dynalin {

// One statement of the dataset on its way into the model.
struct Placement {
  const Statement* statement;
  ElementSet* set;                // nullptr: it makes no element, which is reported
  std::int32_t index;             // in the set
  std::int32_t variant_argument;  // the written argument that chose the kind, or no_variant
  BodyId preceding_body;

  static constexpr std::int32_t no_variant = -1;
  std::size_t at() const { return static_cast<std::size_t>(index); }
};

// Statements of which an atom function needs an argument, by name and id.
using ExaminedStatements = std::map<std::pair<std::string_view, std::int64_t>, const Statement*>;
bool is_examined(std::string_view statement);

class ModelReader final : public ElementReader {
 public:
  // All must outlive this.
  ModelReader(Model& model, const Placement& placement, const ExaminedStatements& examined,
              const DatasetWithRoutines& routines, ProgramShapes& shapes, const SourceText& source,
              Diagnostics& diagnostics);
  std::optional<MarkerId> marker(const WrittenInteger& id, std::string_view argument) override;
  std::optional<BodyId> body(std::string_view statement, const WrittenInteger& id) override;
  std::optional<ElementHandle> element(std::string_view statement, const WrittenInteger& id) override;
  std::optional<Expression> expression(const WrittenArgument& written) override;
  std::optional<VectorExpression> vector_expression(const WrittenArgument& written) override;
  std::optional<BodyId> preceding_body() const override;
  void keep(SourceRef source) override { model_.further_sources.push_back(std::move(source)); }
  void reads(std::string path) override { model_.input_files.push_back(std::move(path)); }
  Marker* own_marker() override {
    // Marker k of its set is marker k + 1 of the model.
    const bool is_marker = placement_.set->kind().role == Kind::Role::marker;
    return is_marker ? &model_.markers[placement_.at() + 1] : nullptr;
  }
  Body* own_body() override {
    // A body is the one that precedes what stands behind it.
    const bool is_body = placement_.set->kind().role == Kind::Role::body;
    return is_body ? &model_.bodies[static_cast<std::size_t>(placement_.preceding_body.index)] : nullptr;
  }
  std::string folder() const override { return std::filesystem::path(source().name()).parent_path().string(); }

 private:
  const Expression& routine_at(const WrittenArgument& written) const;
  void report_missing(std::string_view statement, std::string_view code, const WrittenInteger& id);
  void report_once(std::string_view code, const Span& at, std::string message, std::string hint = {});
  // "MARKER/112 and MARKER/1211 exist": ids that differ by one digit more, less or other. These few are looked up, so
  // that the hint costs the same in models of any size.
  std::string near_ids(std::string_view statement, std::int64_t id) const;

  void check_id(const Atom& atom, std::size_t k, std::string_view statement);
  // SENVAL reads what an argument of its SENSOR yields, so that must be there.
  void check_required_argument(const Atom& atom);
  void check_references(const Expression& e);
  void check_atom(const Atom& atom);

  Model& model_;
  const Placement& placement_;
  const ExaminedStatements& examined_;
  const DatasetWithRoutines& routines_;
  ProgramShapes& shapes_;
};

}  // namespace dynalin
