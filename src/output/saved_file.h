// What SAVE writes and RELOAD reads: a text of our own, docs/saved.md is its manual. Numbers come back to the last bit.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

#include "model/restated.h"
#include "system/saved_point.h"

namespace dynalin {

struct SavedFile {
  // A dataset with the commands that edited it since, all as written.
  struct Model {
    std::string path;  // of the dataset, absolute: files that it names are relative to its folder
    std::string text;
    std::vector<std::string> edits;
    bool pade = false;  // how its DELAYs are read
    // Files that the dataset names, which are not part of this one.
    struct Further {
      std::string path, fingerprint;
    };
    std::vector<Further> further;
    std::vector<std::string> settings;  // commands that set something, in their order
    std::vector<std::string> environment;
  };
  struct Statics {
    int iterations = 0;
    double imbalance = 0;
    SavedPoint at_rest;
  };

  std::string title;        // TITLE of the command
  std::string model_title;  // of the dataset
  std::string fingerprint;  // of the dataset and its edits
  std::optional<Model> system;
  bool started = false, consistent = false;  // see StudyPoint
  Restated restated;
  std::vector<std::string> redundant_rows;
  SavedPoint point;
  std::optional<Statics> statics;
};

// The text of the file, or why there is none: a value that is no number.
tl::expected<std::string, std::string> saved_text(const SavedFile&);
// The error is a reason to stand behind the name: "it is cut off".
tl::expected<SavedFile, std::string> read_saved(std::string_view text);

// Sixteen hexadecimal digits that change with every byte.
std::string fingerprint(std::string_view text);
// Of a dataset and the commands that edited it.
std::string fingerprint(std::string_view text, const std::vector<std::string>& edits);

}  // namespace dynalin
