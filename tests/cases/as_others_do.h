// What tests of the library have in common; public headers only.
#pragma once

#include <dynalin/dynalin.h>
#include <gtest/gtest.h>

#include <string>

namespace dynalin::as_others_do {

inline Study study_of(const std::string& text) { return Study(Model::from_text(text)); }

// The single problem of what is thrown.
template <class Action>
Error error_of(const Action& action) {
  try {
    action();
  } catch (const Error& e) {
    return e;
  }
  ADD_FAILURE() << "nothing was thrown";
  return Error("", {});
}

}  // namespace dynalin::as_others_do
