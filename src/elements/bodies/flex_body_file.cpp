#include "elements/bodies/flex_body_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/read_file.h"
#include "flexible/body_file_type.h"

namespace dynalin {

namespace {

// Says what a file is that is no modal text.
void refuse(BodyFileType type, const std::string& path, const SourceText& file, ElementReader& reader) {
  const Span at = reader.at("MNF_FILE");
  if (type == BodyFileType::binary_modal) {
    reader.error("binary-body-file", at,
                 fmt::format("{} is a binary modal neutral file: this format is not public", path),
                 "write the modes of the body as a modal text file (.fem), reduce its mass and stiffness matrices to "
                 "one, or state the data themselves by MATRICES");
  } else if (type == BodyFileType::binary_cache) {
    reader.error("binary-body-file", at, fmt::format("{} is a binary copy of a modal text file", path),
                 "give the .fem text file that it was made from");
  } else {
    reader.error("body-file", {&file, 0, static_cast<std::uint32_t>(file.line(1).size())},
                 fmt::format("{} is no modal body file: no line of it begins with ** RECORD GROUP 1", path));
  }
}

}  // namespace

std::shared_ptr<ModalBody> read_body_file(const std::string& name, ElementReader& reader) {
  const std::string path = (std::filesystem::path(reader.folder()) / name).string();
  reader.reads(path);
  auto text = dynalin::read_file(path);
  if (!text) {
    reader.error("unreadable-file", reader.at("MNF_FILE"),
                 fmt::format("the file {} of {} cannot be read: {}", path, reader.label().text(), text.error()),
                 "`dynalin reduce` makes such a file out of a finite-element model; an example that needs one has a "
                 "script for it, prepare");
    return nullptr;
  }
  const BodyFileType type = body_file_type(*text);
  const auto source = std::make_shared<const SourceText>(path, std::move(*text));
  if (type != BodyFileType::modal_text) {
    reader.keep(source);
    refuse(type, path, *source, reader);
    return nullptr;
  }
  Diagnostics own;
  auto records = read_modal_text(*source, own);
  auto body = records ? modal_body_of(std::move(*records), *source, own) : std::nullopt;
  if (!own.items().empty()) reader.keep(source);
  reader.diagnostics().append(std::move(own));
  return body ? std::make_shared<ModalBody>(std::move(*body)) : nullptr;
}

double extent_of(const std::vector<Vector>& nodes) {
  if (nodes.empty()) return 0;
  Vector low = nodes.front(), high = low;
  for (const Vector& x : nodes) {
    for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], x[k]), high[k] = std::max(high[k], x[k]);
  }
  return norm(high - low);
}

}  // namespace dynalin
