// Shared libraries with compiled routines, and what is found in them by name.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dynalin/user_routine.h"

namespace dynalin {

// Which of the two ways of include/dynalin/user_routine.h a routine is written in.
enum class RoutineConvention : std::uint8_t { addresses, statement_first };

class RoutineLibrary {
 public:
  // Null with a reason if the file is no shared library that can be loaded here.
  static std::shared_ptr<const RoutineLibrary> load(const std::string& file, std::string& reason);
  ~RoutineLibrary();
  RoutineLibrary(const RoutineLibrary&) = delete;
  RoutineLibrary& operator=(const RoutineLibrary&) = delete;

  const std::string& file() const { return file_; }
  void* symbol(const std::string& name) const;  // null if there is none

 private:
  RoutineLibrary(std::string file, void* handle) : file_(std::move(file)), handle_(handle) {}
  std::string file_;
  void* handle_;
};

struct FoundRoutine {
  std::shared_ptr<const RoutineLibrary> library;
  std::string name;  // as in the library
  void* address = nullptr;
  RoutineConvention convention = RoutineConvention::addresses;
  void (*derivatives)(const dynalin_course*) = nullptr;

  explicit operator bool() const { return address != nullptr; }
};

// The first of the libraries that has a routine of that name: as it is written, in lower case, so with an underscore
// behind it, in upper case, and with a capital.
FoundRoutine find_routine(std::span<const std::shared_ptr<const RoutineLibrary>>, std::string_view name);

}  // namespace dynalin
