#include "output/saved_study.h"

#include <iostream>

#include "base/read_file.h"
#include "dynalin/study.h"
#include "library/inside.h"
#include "output/output_file.h"

namespace dynalin::library {

namespace {

[[noreturn]] void refuse_saving(std::string why) { fail(Failure{"saving", std::move(why), {}, "unwritable-file"}); }
[[noreturn]] void refuse_reloading(std::string why) { fail(Failure{"reloading", std::move(why), {}, "unusable-save"}); }

std::string fingerprint_of(const Model::Inside& model) {
  return dynalin::fingerprint_of(*model.model, model.dataset->source->text(), model.changes);
}

// `name` stands for the text in messages.
OperatingPoint point_in(const Model::Inside& model, const std::string& text, const std::string& name) {
  const auto saved = read_saved(text);
  if (!saved) refuse_reloading(name + " cannot be reloaded: " + saved.error());
  ReloadedPoint found = reloaded(*saved, model.system, fingerprint_of(model), name);
  return OperatingPoint(std::make_shared<const OperatingPoint::Inside>(
      OperatingPoint::Inside{std::move(found.point), remarks_of(found.remarks)}));
}

}  // namespace

std::string Study::saved_text(const OperatingPoint& point, const std::string& title) const {
  SavedFile saved = saved_study(point_of(model_, point), fingerprint_of(model_.inside()));
  saved.title = title;
  auto text = dynalin::saved_text(saved);
  if (!text) refuse_saving(text.error());
  return std::move(*text);
}

void Study::save(const OperatingPoint& point, const std::string& path, const std::string& title) const {
  const std::string text = saved_text(point, title);
  auto destination = find_destination(path);
  if (!destination) refuse_saving("cannot write " + path + ": " + destination.error());
  std::vector<std::unique_ptr<OutputFile>> files;
  auto made = OutputFile::create(std::move(*destination));
  if (!made) refuse_saving(made.error());
  (*made)->stream() << text;
  if (const auto complete = (*made)->complete(); !complete) refuse_saving(complete.error());
  files.push_back(std::move(*made));
  if (const auto committed = commit(files, std::cout); !committed) refuse_saving(committed.error());
}

OperatingPoint Study::from_saved_text(const std::string& text) const {
  return point_in(model_.inside(), text, "the saved text");
}

OperatingPoint Study::reload(const std::string& path) const {
  const auto text = read_file(path);
  if (!text) refuse_reloading(path + " cannot be reloaded: " + text.error());
  return point_in(model_.inside(), *text, path);
}

}  // namespace dynalin::library
