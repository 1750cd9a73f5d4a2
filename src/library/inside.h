// What stands behind the values that the library hands out.
#pragma once

#include <atomic>
#include <mutex>

#include "base/remark_of.h"
#include "dynalin/record.h"
#include "library/edit_history.h"
#include "study/linearization.h"
#include "study/model_source.h"

namespace dynalin::library {

struct Model::Inside : MadeModel {
  std::vector<Remark> remarks;
  ReadingOptions options;
  EditHistory edits;                 // that made it out of other models
  std::vector<std::string> changes;  // all since the dataset was read, as they were stated

  Inside(MadeModel, std::vector<Remark>, const ReadingOptions&, Statements, EditHistory = {},
         std::vector<std::string> changes = {});
  // The statements with their arguments. Those of a dataset as read have gone to bound its memory: the text, which
  // stays, is read once more when they are asked for.
  std::shared_ptr<const Dataset> statements() const;

 private:
  mutable std::once_flag read_;
  mutable std::shared_ptr<const Dataset> statements_;  // with their arguments
};

struct OperatingPoint::Inside {
  StudyPoint point;
  std::vector<Remark> remarks;
};

struct LinearModel::Inside {
  Linearization linear;  // without state matrix where selected modes are cheaper without
  OperatingPoint about;
  std::vector<Remark> remarks;

  Inside(Linearization, OperatingPoint about, std::vector<Remark>);
  // With the state matrix; throws where there is none.
  const Linearization& whole() const;
  // For who asks for matrices: throws where they are too large.
  const Linearization& whole_of_matrices() const;
  // What forming it had to say; nothing where nobody has asked for it.
  std::vector<Remark> remarks_of_whole() const;

 private:
  mutable std::once_flag formed_;
  mutable std::optional<Linearization> whole_;
  mutable std::atomic<bool> has_whole_ = false;
};

// `said` are remarks that came before, and that the error takes along.
[[noreturn]] void fail(const StudyFailure&, std::vector<Remark> said = {});
[[noreturn]] void fail_for_missing(const std::string& what);

ModelOptions model_options(const ReadingOptions&);

// What a point says of the model; throws if it is one of another.
const StudyPoint& point_of(const Model&, const OperatingPoint&);

template <class T>
T value_or_throw(StudyResult<T> result, const std::vector<Remark>& said = {}) {
  if (!result) fail(result.error(), said);
  return std::move(*result);
}

inline void append(std::vector<Remark>& to, std::vector<Remark> more) {
  to.insert(to.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace dynalin::library
