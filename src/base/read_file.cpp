#include "base/read_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>

#include "base/working_folder.h"

namespace dynalin {

namespace {

constexpr std::size_t longest = std::numeric_limits<std::uint32_t>::max();

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

const char* kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "it is a directory";
  if (S_ISFIFO(mode)) return "it is a pipe";
  if (S_ISSOCK(mode)) return "it is a socket";
  return "it is a device";
}

}  // namespace

tl::expected<std::string, std::string> read_file(const std::string& path) {
  const auto failed = [](int error) { return tl::unexpected(std::string(std::strerror(error))); };
  return_to_working_folder();
  // Without O_NONBLOCK a pipe that nobody writes to would hold the program here.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  if (file.get() < 0) return failed(errno);
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) return failed(errno);
  if (!S_ISREG(status.st_mode)) return tl::unexpected(std::string(kind_of(status.st_mode)));
  const auto too_long = [] { return tl::unexpected(std::string("it is longer than 4 GiB")); };
  if (static_cast<std::uintmax_t>(status.st_size) >= longest) return too_long();

  // The stated size is only a first guess: files of the kernel state none, and others may be written to meanwhile.
  constexpr std::size_t least = 4096;
  std::string text(std::max(least, static_cast<std::size_t>(status.st_size) + 1), '\0');
  std::size_t length = 0;
  for (;;) {
    const ssize_t count = ::read(file.get(), text.data() + length, text.size() - length);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return failed(errno);
    if (count == 0) break;
    length += static_cast<std::size_t>(count);
    if (length < text.size()) continue;
    if (length >= longest) return too_long();
    text.resize(std::min(longest, 2 * length));
  }
  text.resize(length);
  if (text.capacity() > 2 * length + least) text.shrink_to_fit();
  return text;
}

}  // namespace dynalin
