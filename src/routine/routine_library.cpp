#include "routine/routine_library.h"

#include <dlfcn.h>

#include <algorithm>
#include <cctype>

#include "routine/routine_context.h"

namespace dynalin {

namespace {

std::string in_case(std::string_view name, int (*change)(int)) {
  std::string out(name);
  for (char& c : out) c = static_cast<char>(change(static_cast<unsigned char>(c)));
  return out;
}

// A capital, and letters that are small: Sfosub.
RoutineConvention convention_of(std::string_view name) {
  const bool capital = std::isupper(static_cast<unsigned char>(name.front())) != 0;
  const bool small = std::any_of(name.begin(), name.end(), [](unsigned char c) { return std::islower(c) != 0; });
  return capital && small ? RoutineConvention::statement_first : RoutineConvention::addresses;
}

}  // namespace

std::shared_ptr<const RoutineLibrary> RoutineLibrary::load(const std::string& file, std::string& reason) {
  // Without a slash the loader would look for it elsewhere.
  const std::string path = file.find('/') == std::string::npos ? "./" + file : file;
  const std::string loading = "what " + file + " does when it is loaded";
  const RoutineContext::Named named(loading.c_str());
  void* handle = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle) {
    const char* why = ::dlerror();
    reason = why ? why : "it cannot be loaded";
    return nullptr;
  }
  return std::shared_ptr<const RoutineLibrary>(new RoutineLibrary(file, handle));
}

RoutineLibrary::~RoutineLibrary() { ::dlclose(handle_); }

void* RoutineLibrary::symbol(const std::string& name) const { return ::dlsym(handle_, name.c_str()); }

FoundRoutine find_routine(std::span<const std::shared_ptr<const RoutineLibrary>> libraries, std::string_view name) {
  if (name.empty()) return {};
  const std::string lower = in_case(name, std::tolower);
  std::string capital = lower;
  capital.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(capital.front())));
  for (const auto& library : libraries) {
    for (const std::string& candidate :
         {std::string(name), lower, lower + "_", in_case(name, std::toupper), capital, std::string(name) + "_"}) {
      void* const address = library->symbol(candidate);
      if (!address) continue;
      FoundRoutine found{library, candidate, address, convention_of(candidate), nullptr};
      const std::string plain = candidate.ends_with('_') ? candidate.substr(0, candidate.size() - 1) : candidate;
      found.derivatives = reinterpret_cast<void (*)(const dynalin_course*)>(library->symbol(plain + "_derivatives"));
      return found;
    }
  }
  return {};
}

}  // namespace dynalin
