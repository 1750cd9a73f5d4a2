// What stands behind the values that the library hands out.
#pragma once

#include "base/remark_of.h"
#include "dynalin/record.h"
#include "study/linearization.h"

namespace dynalin::library {

struct Model::Inside {
  std::shared_ptr<const System> system;  // and the model in it
  std::vector<Remark> remarks;
};

struct OperatingPoint::Inside {
  StudyPoint point;
  std::vector<Remark> remarks;
};

struct LinearModel::Inside {
  Linearization linear;
  OperatingPoint about;
  std::vector<Remark> remarks;
};

// `said` are remarks that came before, and that the error takes along.
[[noreturn]] void fail(const StudyFailure&, std::vector<Remark> said = {});
[[noreturn]] void fail_for_missing(const std::string& what);

template <class T>
T value_or_throw(StudyResult<T> result, const std::vector<Remark>& said = {}) {
  if (!result) fail(result.error(), said);
  return std::move(*result);
}

inline void append(std::vector<Remark>& to, std::vector<Remark> more) {
  to.insert(to.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace dynalin::library
