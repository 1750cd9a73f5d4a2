#include "output/atomic_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace dynalin {

AtomicFile::AtomicFile(std::string path)
    : path_(std::move(path)),
      temporary_(path_ + ".part" + std::to_string(::getpid())),
      stream_(temporary_, std::ios::binary) {}

AtomicFile::~AtomicFile() {
  if (committed_) return;
  stream_.close();
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

tl::expected<void, std::string> AtomicFile::commit() {
  errno = 0;
  stream_.close();
  if (!stream_) {
    return tl::unexpected("cannot write " + path_ + (errno ? std::string(": ") + std::strerror(errno) : ""));
  }
  std::error_code error;
  std::filesystem::rename(temporary_, path_, error);
  if (error) return tl::unexpected("cannot write " + path_ + ": " + error.message());
  committed_ = true;
  return {};
}

}  // namespace dynalin
