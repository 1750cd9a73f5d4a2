#include "command/run_files.h"

#include <fmt/format.h>

#include <ctime>

namespace dynalin {

RunFiles::Result RunFiles::add(const std::vector<Planned>& planned) {
  std::vector<std::unique_ptr<OutputFile>> made;
  for (const Planned& p : planned) {
    auto file = create_output(p.path);
    if (!file) return tl::unexpected(file.error());
    if (auto free = no_input((*file)->destination()); !free) return free;
    p.content((*file)->stream());
    if (auto complete = (*file)->complete(); !complete) return complete;
    made.push_back(std::move(*file));
  }
  for (auto& file : made) keep(std::move(file));
  return {};
}

RunFiles::Result RunFiles::add(std::unique_ptr<OutputFile> file) {
  if (auto free = no_input(file->destination()); !free) return free;
  if (auto complete = file->complete(); !complete) return complete;
  keep(std::move(file));
  return {};
}

RunFiles::Result RunFiles::no_input(const Destination& d) const {
  const std::string* input = inputs_.replaced_by(d);
  if (!input) return {};
  return tl::unexpected(fmt::format("{} would overwrite {}, which the run reads", d.name, *input));
}

void RunFiles::keep(std::unique_ptr<OutputFile> file) {
  const Destination& d = file->destination();
  const auto [place, fresh] = place_of_file_.emplace(d.place(), files_.size());
  if (d.kind == Destination::Kind::replaced && !fresh) {
    files_[place->second] = std::move(file);
  } else {
    files_.push_back(std::move(file));
  }
}

RunFiles::Result RunFiles::commit(std::ostream& standard_output) {
  auto result = dynalin::commit(files_, standard_output);
  if (result) committed_ = names();
  files_.clear();
  place_of_file_.clear();
  return result;
}

std::vector<std::string> RunFiles::names() const {
  std::vector<std::string> list = committed_;
  for (const auto& file : files_) {
    if (file->destination().kind == Destination::Kind::replaced) list.push_back(file->destination().name);
  }
  return list;
}

std::vector<RunFiles::Planned> matrix_files(const std::string& base, const std::string& format,
                                            const std::vector<NamedMatrix>& matrices) {
  if (format != "MATLAB") return {{base, [&](std::ostream& out) { write_fsave(out, matrices, std::time(nullptr)); }}};
  std::vector<RunFiles::Planned> list;
  for (const NamedMatrix& m : matrices)
    list.push_back({base + m.suffix, [&m](std::ostream& out) { write_matlab(out, m); }});
  return list;
}

}  // namespace dynalin
