// A study of a dataset in the library, as text.
#pragma once

#include <dynalin/study.h>

#include <string>

namespace dynalin {

inline library::Study study_of(std::string dataset, const ReadingOptions& options = {}) {
  return library::Study(library::Model::from_text(std::move(dataset), "dataset.adm", options));
}

}  // namespace dynalin
