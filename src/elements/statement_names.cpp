// The statements of the language: those of the catalogue, and those that are refused by name. Readers of datasets ask
// for them (dataset/dataset.h), so that a new element is known there without another line.
#include <algorithm>
#include <array>

#include "dataset/dataset.h"
#include "elements/catalogue.h"

namespace dynalin {

namespace {

// Words that no Kind reads, or not yet.
constexpr std::array<std::string_view, 4> without_kind = {"END", "SURFACE", "TIRE", "UCON"};

std::vector<std::string_view> all_names() {
  std::vector<std::string_view> names(without_kind.begin(), without_kind.end());
  for (const Kind* kind : catalogue()) names.push_back(kind->statement);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace

std::span<const std::string_view> statement_names() {
  static const std::vector<std::string_view> names = all_names();
  return names;
}

}  // namespace dynalin
