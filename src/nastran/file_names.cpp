#include "nastran/file_names.h"

#include <fmt/format.h>

#include <filesystem>

namespace dynalin::nastran {

namespace {

constexpr std::size_t columns = 72;

}  // namespace

FileNames::FileNames(const std::string& file, const ExportOptions& options) : base_(file) {
  namespace fs = std::filesystem;
  if (options.file_name_style == FileStyle::B) {
    const std::string extension = fs::path(file).extension().string();
    base_.resize(file.size() - extension.size());
    main_ = file;
    model_ = included_ = extension;
  } else {
    main_ = file + options.main_file_include_extension;
    model_ = options.model_include_extension;
    included_ = options.file_name_style == FileStyle::A ? options.file_include_extension : model_;
  }
  // Relative to the deck a name alone is found whatever folder the program runs in.
  const fs::path path(file);
  folder_ = options.include_directory ? *options.include_directory
            : path.is_absolute()      ? path.parent_path().string()
                                      : std::string();
  if (!folder_.empty() && !folder_.ends_with('/')) folder_ += '/';
}

tl::expected<std::string, std::string> FileNames::include(const std::string& name) const {
  const std::string path = folder_ + std::filesystem::path(name).filename().string();
  if (path.find_first_of("'$\n\r") != std::string::npos)
    return tl::unexpected(fmt::format("the name {} has a character that an INCLUDE statement cannot have", path));
  std::string text = "INCLUDE '", line = text;
  for (std::size_t at = 0; at < path.size();) {
    const std::size_t end = std::min(path.find('/', at), path.size() - 1) + 1;
    const std::string part = path.substr(at, end - at) + (end == path.size() ? "'" : "");
    if (part.size() > columns)
      return tl::unexpected(fmt::format("{} is too long for an INCLUDE statement, which has lines of {} columns",
                                        path.substr(at, end - at), columns));
    if (line.size() + part.size() > columns) {
      text += '\n';
      line.clear();
    }
    text += part;
    line += part;
    at = end;
  }
  return text;
}

}  // namespace dynalin::nastran
