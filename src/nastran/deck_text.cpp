#include "nastran/deck_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <map>
#include <set>

#include "nastran/card_file.h"
#include "nastran/case_control.h"
#include "nastran/deck_matrices.h"
#include "nastran/file_names.h"
#include "nastran/frequency_response.h"
#include "nastran/model_cards.h"
#include "nastran/punch_file.h"
#include "nastran/unused_items.h"

namespace dynalin::nastran {

namespace {

// Letters and digits of a name, everything else a line below.
std::string file_part(const std::string& name, bool short_names) {
  std::string part = name;
  if (const std::size_t dot = part.rfind('.'); short_names && dot != std::string::npos && dot + 1 < part.size())
    part.erase(0, dot + 1);
  std::ranges::replace_if(
      part,
      [](char c) { return !((c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-'); },
      '_');
  return part;
}

// Which file each card goes to. The main file includes all others in the order in which they stand here.
class Files {
 public:
  Files(const Deck& deck, const ExportOptions& options, const std::string& file)
      : options_(options), names_(file, options) {
    main_ = &make(names_.main());
    if (!options.use_includes) return;
    if (options.file_name_style != FileStyle::C) {
      model_ = &make(names_.model());
      return;
    }
    property_ = &make(names_.of("PROPERTY"));
    std::set<std::string> taken = {"PROPERTY", "CONNECTIVITY", "RBE2", "DMIG"};
    for (const Body& body : deck.bodies) {
      const std::string wanted = file_part(body.name, options.use_short_part_file_names);
      std::string part = wanted;
      for (int k = 2; !taken.insert(part).second; ++k) part = fmt::format("{}_{}", wanted, k);
      bodies_.push_back(&make(names_.of(part)));
    }
    model_ = &make(names_.of("CONNECTIVITY"));
    if (options.export_rbe_connectivity) ties_ = &make(names_.of("RBE2"));
  }

  CardFile& main() { return *main_; }
  CardFile& of(CardGroup group, const Owner& owner, bool of_shapes) {
    if (!model_) return *main_;
    const bool in_bodies = !bodies_.empty() && owner.body >= 0;
    if (options_.file_name_style == FileStyle::C) {
      if (group == CardGroup::property) return *property_;
      if (group == CardGroup::tie && ties_) return *ties_;
      if (group == CardGroup::shape && options_.single_included_dmig) return collected();
      return in_bodies ? *bodies_[static_cast<std::size_t>(owner.body)] : *model_;
    }
    if (!of_shapes) return *model_;
    return options_.single_included_dmig ? collected() : named("GRAPHICS");
  }
  CardFile& of(const WrittenMatrix& matrix) {
    if (!model_) return *main_;
    if (options_.single_included_dmig) return collected();
    return options_.file_name_style == FileStyle::C ? *model_ : named(matrix.name);
  }
  const FileNames& names() const { return names_; }
  std::deque<CardFile>& list() { return list_; }

 private:
  CardFile& make(std::string name) {
    return list_.emplace_back(std::move(name), options_.use_long_format ? FieldWidth::large : FieldWidth::small,
                              options_.add_space_before_names ? " " : "");
  }
  // An included file of this name, made when first wanted.
  CardFile& named(const std::string& what) {
    CardFile*& file = named_[what];
    if (!file) file = &make(names_.included(what));
    return *file;
  }
  CardFile& collected() { return named("DMIG"); }

  const ExportOptions& options_;
  FileNames names_;
  std::deque<CardFile> list_;
  CardFile *main_ = nullptr, *model_ = nullptr, *property_ = nullptr, *ties_ = nullptr;
  std::vector<CardFile*> bodies_;
  std::map<std::string, CardFile*> named_;
};

class TextWriter {
 public:
  TextWriter(Deck deck, const ExportOptions& options, const std::string& file)
      : deck_(std::move(deck)), o_(options), files_(deck_, options, file) {}

  tl::expected<DeckText, std::vector<std::string>> write() {
    remove_unused(deck_, o_, made_.details);
    normalize_relations(deck_);
    const std::vector<WrittenMatrix> matrices = written_matrices(deck_, o_, made_.remarks, made_.details);
    Ids ids;
    const std::vector<MatrixSet> sets = matrix_sets(matrices, o_, ids);

    // The cards of the main file stand behind lines that are known only when the others are written.
    CardFile& main = files_.main();
    write_control_cards(deck_, o_, main);
    std::vector<ResponseCase> cases;
    if (o_.solution_number == 108) cases = write_response(deck_, o_, ids, main, made_.remarks);
    if (o_.export_spc_connectivity && o_.file_name_style == FileStyle::C)
      made_.remarks.warning("export-differs", {},
                            "RJOINT and CBUSH cards are comments, as export_spc_connectivity asks for: until a script "
                            "joins the bodies again, eigenvalues are those of bodies apart");
    write_model(deck_, o_,
                [&](CardGroup group, const Owner& owner) -> CardFile& { return files_.of(group, owner, false); });
    const FieldWidth width = o_.use_dmig_long_format ? FieldWidth::large : FieldWidth::small;
    for (const WrittenMatrix& m : matrices) nastran::write(m, width, files_.of(m));
    write_shapes(deck_,
                 [&](CardGroup group, const Owner& owner) -> CardFile& { return files_.of(group, owner, true); });
    return finish(control_text(deck_, o_, sets, cases));
  }

 private:
  tl::expected<DeckText, std::vector<std::string>> finish(const std::string& control) {
    std::vector<std::string> problems;
    bool has_wide_number = false;
    std::string includes;
    std::set<std::string> names;
    for (CardFile& file : files_.list()) {
      problems.insert(problems.end(), file.problems().begin(), file.problems().end());
      has_wide_number |= file.has_wide_number();
      if (!names.insert(file.name()).second)
        problems.push_back(fmt::format("two files of the export have the name {}", file.name()));
      if (&file == &files_.main()) continue;
      auto statement = files_.names().include(file.name());
      if (!statement)
        problems.push_back(std::move(statement.error()));
      else
        includes += *statement + "\n";
    }
    if (has_wide_number && deck_.open && o_.use_adams_ids)
      problems.emplace_back("use_adams_ids = no counts the cards, whatever the ids of the dataset are");
    if (!problems.empty()) return tl::unexpected(std::move(problems));
    const std::string title =
        fmt::format("$ Linear model at time {}, {}\n", deck_.time, deck_.open ? "OPENBOX" : "CLOSEDBOX");
    for (CardFile& file : files_.list()) {
      const bool main = &file == &files_.main();
      made_.files.push_back(
          {file.name(), title + (main ? control + file.text() + includes + "ENDDATA\n" : file.text())});
    }
    if (o_.export_mode_shapes && !deck_.modes.empty())
      made_.files.push_back({files_.names().punch(), punch_text(deck_, o_)});
    for (const DeckFile& f : made_.files)
      made_.details.push_back(fmt::format("{}: {} lines", f.name, std::ranges::count(f.text, '\n')));
    return std::move(made_);
  }

  Deck deck_;
  const ExportOptions& o_;
  Files files_;
  DeckText made_;
};

}  // namespace

tl::expected<DeckText, std::vector<std::string>> deck_text(Deck deck, const ExportOptions& options,
                                                           const std::string& file) {
  return TextWriter(std::move(deck), options, file).write();
}

}  // namespace dynalin::nastran
