// A file that appears under its name only when it is complete.
#pragma once

#include <fstream>
#include <string>
#include <tl/expected.hpp>

namespace dynalin {

class AtomicFile {
 public:
  explicit AtomicFile(std::string path);
  ~AtomicFile();  // removes what was not committed
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::string& path() const { return path_; }
  bool ok() const { return stream_.good(); }
  std::ostream& stream() { return stream_; }
  // Closes and renames; the error says which file and why.
  tl::expected<void, std::string> commit();

 private:
  std::string path_, temporary_;
  std::ofstream stream_;
  bool committed_ = false;
};

}  // namespace dynalin
