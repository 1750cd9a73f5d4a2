// The names of the files of an export in its style, and INCLUDE statements that lead to them.
#pragma once

#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "nastran/export_options.h"

namespace dynalin::nastran {

class FileNames {
 public:
  // `file` as LINEAR has it in FILE=.
  FileNames(const std::string& file, const ExportOptions&);

  const std::string& main() const { return main_; }
  std::string model() const { return of("MODEL"); }
  // With the extension of files of matrices and graphics in style A; of all others where there is one for all.
  std::string included(std::string_view what) const { return base_ + "_" + std::string(what) + included_; }
  std::string of(std::string_view what) const { return base_ + "_" + std::string(what) + model_; }
  std::string punch() const { return base_ + ".pch"; }
  // INCLUDE of one of these files, in lines of at most 72 columns that break behind a slash.
  tl::expected<std::string, std::string> include(const std::string& name) const;

 private:
  std::string base_, main_, model_, included_;
  std::string folder_;  // with its slash, empty for the folder of the deck
};

}  // namespace dynalin::nastran
