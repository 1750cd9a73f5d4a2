#include "reduction/reduce_program.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <memory>
#include <optional>

#include "base/read_file.h"
#include "dataset/characters.h"
#include "output/output_file.h"
#include "reduction/body_check.h"
#include "reduction/body_file_writer.h"
#include "reduction/coordinate_matrix.h"
#include "reduction/craig_bampton.h"
#include "reduction/direct_matrices.h"
#include "reduction/freedom_list.h"
#include "reduction/inertia_invariants.h"
#include "reduction/node_list.h"
#include "reduction/reduction_report.h"
#include "reduction/rigid_motion.h"
#include "reduction/text_scanner.h"

namespace dynalin::reduction {

namespace {

enum Status : int { done = 0, wrong_input = 1, failed = 2, wrong_usage = 3 };

// Bulk data begin with letters or $, coordinates with digits or %.
bool has_cards(const SourceText& file) {
  TextScanner scanner(file);
  while (scanner.next_line()) {
    const std::string_view word = scanner.word();
    if (word.empty()) continue;
    const auto c = static_cast<unsigned char>(word[0]);
    return c == '$' || (std::isalpha(c) != 0 && !upper_case(word).starts_with("MATRIXMARKET"));
  }
  return false;
}

std::string beside(const std::string& path, std::string_view extension) {
  const std::size_t slash = path.find_last_of('/'), point = path.find_last_of('.');
  const bool has_extension = point != std::string::npos && (slash == std::string::npos || point > slash);
  return (has_extension ? path.substr(0, point) : path) + std::string(extension);
}

// The items of a list that is separated by commas or blanks; none if a comma has nothing on one of its sides.
std::optional<std::vector<std::string>> items_of(const std::vector<std::string>& words) {
  std::vector<std::string> items;
  bool wanted = false;  // a comma stands before
  for (const std::string& word : words) {
    for (std::size_t at = 0; at < word.size();) {
      const std::size_t end = std::min(word.find_first_of(", ", at), word.size());
      if (end > at) {
        items.push_back(word.substr(at, end - at));
        wanted = false, at = end;
        continue;
      }
      if (word[at++] == ' ') continue;
      if (wanted || items.empty()) return std::nullopt;
      wanted = true;
    }
  }
  return wanted ? std::nullopt : std::optional(std::move(items));
}

class Program {
 public:
  Program(const ReduceOptions& options, std::ostream& out, std::ostream& err)
      : options_(options), out_(out), err_(err) {}

  int run() {
    if (!check_usage()) return wrong_usage;
    auto destination = find_destination(options_.output);
    if (!destination) {
      fmt::print(err_, "error: {} cannot be written: {}\n", options_.output, destination.error());
      return wrong_input;
    }
    if (!read_model()) return tell(wrong_input);
    InputFiles inputs;
    for (const auto& source : sources_) inputs.add(source->name());
    if (const std::string* input = inputs.replaced_by(*destination)) {
      fmt::print(err_, "error: --output would overwrite {}, which is read\n", *input);
      return wrong_input;
    }
    auto reduction = reduce_model(model_, request_, diagnostics_);
    if (!reduction) {
      if (!diagnostics_.has_errors()) fmt::print(err_, "error: the reduction failed: {}\n", reduction.error());
      return tell(diagnostics_.has_errors() ? wrong_input : failed);
    }
    const bool condensed =
        std::any_of(model_.freedoms.begin(), model_.freedoms.end(), [](const Freedom& f) { return f.direction == 0; });
    std::vector<NodeLabel> nodes = request_.interface;
    nodes.insert(nodes.end(), also_.begin(), also_.end());
    const BodyFile body = in_other_units(
        body_of(model_, *reduction, nodes, condensed ? InertiaOrder::undeformed : InertiaOrder::follows_deformation,
                fmt::format("reduced from {} freedoms", model_.freedoms.size())),
        {options_.length_factor, options_.mass_factor, options_.force_factor});
    if (!check_body(body, *reduction, options_.output, diagnostics_)) return tell(wrong_input);
    err_ << render(diagnostics_);
    print_report(out_, model_, request_, *reduction);
    if (options_.length_factor != 1 || options_.mass_factor != 1 || options_.force_factor != 1)
      fmt::print(out_, "all of these are in the units of the matrices, the body file is in others\n");
    if (condensed)
      fmt::print(out_,
                 "the matrices were condensed before: the inertia of the body file does not follow its deformation\n");
    return write(body, std::move(*destination));
  }

 private:
  int tell(Status status) const {
    err_ << render(diagnostics_);
    return status;
  }

  bool check_usage() {
    const auto usage = [&](const std::string& what) {
      fmt::print(err_, "error: {}\n", what);
      return false;
    };
    for (const double factor : {options_.length_factor, options_.mass_factor, options_.force_factor}) {
      if (!(factor > 0) || !std::isfinite(factor)) return usage("factors of units are positive numbers");
    }
    if (!(options_.frequency_limit > 0)) return usage("the frequency up to which modes are taken is positive");
    const auto interface = items_of(options_.interface), also = items_of(options_.also);
    if (!interface || !also) return usage(fmt::format("{} has an empty item", interface ? "--also" : "--interface"));
    for (const std::string& word : *interface) {
      const std::size_t colon = word.find(':');
      const auto node = TextScanner::integer<NodeLabel>(std::string_view(word).substr(0, colon));
      if (!node) return usage(fmt::format("'{}' is not a node, or node:rotation-node", word));
      request_.interface.push_back(*node);
      if (colon == std::string::npos) continue;
      const auto rotation = TextScanner::integer<NodeLabel>(std::string_view(word).substr(colon + 1));
      if (!rotation) return usage(fmt::format("'{}' is not a node, or node:rotation-node", word));
      rotations_.push_back({*node, *rotation});
    }
    for (const std::string& word : *also) {
      const auto node = TextScanner::integer<NodeLabel>(word);
      if (!node) return usage(fmt::format("'{}' is not a node", word));
      if (std::find(request_.interface.begin(), request_.interface.end(), *node) == request_.interface.end() &&
          std::find(also_.begin(), also_.end(), *node) == also_.end())
        also_.push_back(*node);
    }
    constexpr Eigen::Index usual = 20;
    const bool limited = std::isfinite(options_.frequency_limit);
    request_.modes = options_.modes >= 0 ? options_.modes : limited ? std::numeric_limits<Eigen::Index>::max() : usual;
    request_.highest_frequency = options_.frequency_limit;
    request_.rotations_required = !options_.translations_only;
    return true;
  }

  // Sources live as long as the diagnostics that point into them.
  const SourceText* open(const std::string& path) {
    auto text = read_file(path);
    if (!text) {
      diagnostics_.error("fe-file", Span{}, fmt::format("{} cannot be read: {}", path, text.error()));
      return nullptr;
    }
    return sources_.emplace_back(std::make_unique<SourceText>(path, std::move(*text))).get();
  }

  bool read_model() {
    const SourceText* nodes = open(options_.nodes);
    const SourceText* stiffness = open(options_.stiffness);
    const SourceText* mass = options_.mass == options_.stiffness ? stiffness : open(options_.mass);
    if (!nodes || !stiffness || !mass) return false;
    auto list = read_nodes(*nodes, diagnostics_);
    if (!list) return false;
    model_.nodes = std::move(list->nodes);
    const std::vector<RotationNode> asked_for = rotations_;
    rotations_.insert(rotations_.end(), list->rotation_nodes.begin(), list->rotation_nodes.end());
    if (has_cards(*stiffness)) {
      auto matrices =
          read_direct_matrices(*stiffness, options_.stiffness_name, *mass, options_.mass_name, diagnostics_);
      if (!matrices) return false;
      model_.freedoms = std::move(matrices->freedoms);
      model_.stiffness = std::move(matrices->stiffness), model_.mass = std::move(matrices->mass);
      const auto listed = [](std::vector<Span> places) {
        return [places = std::move(places)](Eigen::Index row) { return places[static_cast<std::size_t>(row)]; };
      };
      model_.stiffness_at = listed(std::move(matrices->stiffness_at)),
      model_.mass_at = listed(std::move(matrices->mass_at));
    } else if (!read_coordinates(*stiffness, *mass)) {
      return false;
    }
    return have_freedoms(asked_for) && turn_rotation_nodes() && check_nodes();
  }

  bool read_coordinates(const SourceText& stiffness, const SourceText& mass) {
    const SourceText* freedoms =
        open(options_.freedoms.empty() ? beside(options_.stiffness, ".dof") : options_.freedoms);
    if (!freedoms) return false;
    auto rows = read_freedoms(*freedoms, diagnostics_);
    if (!rows) return false;
    model_.freedoms = std::move(*rows);
    const auto n = static_cast<Eigen::Index>(model_.freedoms.size());
    auto k = read_coordinate_matrix(stiffness, n, diagnostics_);
    auto m = k ? read_coordinate_matrix(mass, n, diagnostics_) : std::nullopt;
    if (!m) return false;
    // CalculiX writes exact zeros as well.
    const auto by_calculix = [](const SourceText& file, std::string_view suffix) {
      return std::string_view(file.name()).ends_with(suffix) && !file.text().starts_with("%%");
    };
    if (by_calculix(stiffness, ".sti") && by_calculix(mass, ".mas") && k->nonZeros() != m->nonZeros()) {
      diagnostics_.error("fe-matrix-size", Span{&mass, 0, 0},
                         fmt::format("{} has fewer or more entries than {}, they have the same places", options_.mass,
                                     options_.stiffness),
                         "one of the files may be cut off, or of another model");
      return false;
    }
    model_.stiffness = std::move(*k), model_.mass = std::move(*m);
    model_.stiffness_at = [&stiffness, n](Eigen::Index row) { return diagonal_entry(stiffness, n, row); };
    model_.mass_at = [&mass, n](Eigen::Index row) { return diagonal_entry(mass, n, row); };
    return true;
  }

  bool have_freedoms(const std::vector<RotationNode>& asked_for) {
    for (const RotationNode& r : asked_for) {
      if (std::ranges::any_of(model_.freedoms, [&](const Freedom& f) { return f.node == r.rotation; })) continue;
      diagnostics_.error("fe-node", Span{},
                         fmt::format("node {}, which is to turn node {}, has no freedoms", r.rotation, r.reference),
                         fmt::format("--interface {} alone, if it has rotations of its own", r.reference));
      return false;
    }
    return true;
  }

  // Translations of a rotation node are rotations of the node it turns.
  bool turn_rotation_nodes() {
    std::map<NodeLabel, NodeLabel> reference, rotation;
    for (const RotationNode& r : rotations_) {
      const NodeLabel turned = reference.try_emplace(r.rotation, r.reference).first->second;
      const NodeLabel turning = rotation.try_emplace(r.reference, r.rotation).first->second;
      if (turned == r.reference && turning == r.rotation) continue;
      const std::string what = turned != r.reference
                                   ? fmt::format("node {} turns node {} and node {}", r.rotation, turned, r.reference)
                                   : fmt::format("node {} and node {} turn node {}", turning, r.rotation, r.reference);
      diagnostics_.error("fe-node", Span{}, what,
                         "a rotation node belongs to one node and to none else, as *RIGID BODY lines and "
                         "node:rotation-node of --interface say");
      return false;
    }
    std::map<Freedom, int> seen;
    for (Freedom& f : model_.freedoms) {
      const auto turned = reference.find(f.node);
      if (turned != reference.end() && f.direction >= 1 && f.direction <= 3) f = {turned->second, f.direction + 3};
      if (++seen[f] == 1) continue;
      diagnostics_.error("fe-freedom", Span{},
                         fmt::format("node {} has two freedoms in direction {}: its own and one of a rotation node",
                                     f.node, f.direction));
      return false;
    }
    return true;
  }

  bool check_nodes() {
    const auto refuse = [&](NodeLabel label, std::string_view what) {
      diagnostics_.error("fe-node", Span{}, fmt::format("{} {} is not in {}", what, label, options_.nodes));
      return false;
    };
    // What CalculiX adds inside elements, as the modes of C3D8I, has numbers behind those of the nodes: no motion of
    // the whole body moves it.
    std::vector<NodeLabel> inside;
    for (Freedom& f : model_.freedoms) {
      if (f.direction == 0 || model_.nodes.contains(f.node)) continue;
      if (inside.empty() || inside.back() != f.node) inside.push_back(f.node);
      f.direction = 0;
    }
    if (!inside.empty()) {
      constexpr Eigen::Index all_motions = 6;
      if (free_motions(model_, rigid_motions(model_)).directions.cols() < all_motions)
        return refuse(inside.front(), "the place of node");
      diagnostics_.warning("fe-node", Span{},
                           fmt::format("{} node{} without a place in {}, {} the first: taken for coordinates inside "
                                       "elements, as no motion of the body as a whole needs them",
                                       inside.size(), inside.size() == 1 ? "" : "s", options_.nodes, inside.front()));
    }
    for (const NodeLabel label : also_) {
      if (!model_.nodes.contains(label)) return refuse(label, "node");
    }
    return true;
  }

  int write(const BodyFile& body, Destination destination) {
    const auto fail = [&](const std::string& reason) {
      fmt::print(err_, "error: {}\n", reason);
      return static_cast<int>(failed);
    };
    auto file = OutputFile::create(std::move(destination));
    if (!file) return fail(file.error());
    write_body_file((*file)->stream(), body);
    if (const auto complete = (*file)->complete(); !complete) return fail(complete.error());
    std::vector<std::unique_ptr<OutputFile>> files;
    files.push_back(std::move(*file));
    if (const auto written = commit(files, out_); !written) return fail(written.error());
    return done;
  }

  const ReduceOptions& options_;
  std::ostream& out_;
  std::ostream& err_;
  Diagnostics diagnostics_;
  std::vector<std::unique_ptr<SourceText>> sources_;
  ReductionRequest request_;
  std::vector<NodeLabel> also_;
  std::vector<RotationNode> rotations_;
  FiniteElementModel model_;
};

}  // namespace

int reduce(const ReduceOptions& options, std::ostream& out, std::ostream& err) {
  return Program(options, out, err).run();
}

}  // namespace dynalin::reduction
