// Preloaded into the program under test: calls of the system that fail on demand, as a broken disk or a full one makes
// them fail. What the environment says:
//   FAULT_READ=name    reads of a file of that name fail with EIO after FAULT_BYTES bytes
//   FAULT_WRITE=name   writes likewise, with ENOSPC
//   FAULT_SYNC=name    fsync fails with EIO
//   FAULT_RENAME=name  renaming to it fails with EIO
// A name is any part of the path.
#include <dlfcn.h>
#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <string>

namespace {

template <class Function>
Function* original(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

bool meant(const char* variable, const std::string& path) {
  const char* name = std::getenv(variable);
  return name && path.find(name) != std::string::npos;
}

bool meant(const char* variable, int descriptor) {
  if (!std::getenv(variable)) return false;
  std::array<char, PATH_MAX> path{};
  const std::string link = "/proc/self/fd/" + std::to_string(descriptor);
  const ssize_t length = ::readlink(link.c_str(), path.data(), path.size());
  return length > 0 && meant(variable, std::string(path.data(), static_cast<std::size_t>(length)));
}

// How many of `wanted` bytes are still allowed; fewer than none mean the failure.
ssize_t allowance(std::size_t wanted) {
  static std::size_t left = [] {
    const char* text = std::getenv("FAULT_BYTES");
    return text ? static_cast<std::size_t>(std::atoll(text)) : std::size_t{0};
  }();
  if (left == 0 && wanted > 0) return -1;
  const std::size_t now = std::min(left, wanted);
  left -= now;
  return static_cast<ssize_t>(now);
}

}  // namespace

extern "C" {

ssize_t read(int descriptor, void* bytes, std::size_t count) {
  if (meant("FAULT_READ", descriptor)) {
    const ssize_t now = allowance(count);
    if (now < 0) return errno = EIO, -1;
    count = static_cast<std::size_t>(now);
  }
  return original<ssize_t(int, void*, std::size_t)>("read")(descriptor, bytes, count);
}

ssize_t write(int descriptor, const void* bytes, std::size_t count) {
  if (meant("FAULT_WRITE", descriptor)) {
    const ssize_t now = allowance(count);
    if (now < 0) return errno = ENOSPC, -1;
    count = static_cast<std::size_t>(now);
  }
  return original<ssize_t(int, const void*, std::size_t)>("write")(descriptor, bytes, count);
}

int fsync(int descriptor) {
  if (meant("FAULT_SYNC", descriptor)) return errno = EIO, -1;
  return original<int(int)>("fsync")(descriptor);
}

int rename(const char* from, const char* to) noexcept {
  if (meant("FAULT_RENAME", std::string(to))) return errno = EIO, -1;
  return original<int(const char*, const char*)>("rename")(from, to);
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned int flags) noexcept {
  if (meant("FAULT_RENAME", std::string(to))) return errno = EIO, -1;
  return original<int(int, const char*, int, const char*, unsigned int)>("renameat2")(from_folder, from, to_folder, to,
                                                                                      flags);
}
}
