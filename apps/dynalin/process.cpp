#include "process.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <Eigen/Core>
#include <array>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>

#include "linear/dense_products.h"

namespace {

bool memory_is_limited() {
  struct rlimit limit {};
  for (const auto which : {RLIMIT_AS, RLIMIT_DATA}) {
    if (::getrlimit(which, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) return true;
  }
  return false;
}

bool can_have(std::size_t bytes) {
  void* const memory = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  return memory != MAP_FAILED && ::munmap(memory, bytes) == 0;
}

}  // namespace

void open_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) >= 0 || errno != EBADF) continue;
    const int opened = ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
    if (opened >= 0 && opened != stream) ::close(opened);
  }
}

bool has_piped_input() {
  struct stat input {};
  return ::fstat(STDIN_FILENO, &input) == 0 && (S_ISFIFO(input.st_mode) || S_ISREG(input.st_mode));
}

tl::expected<std::string, std::string> read_commands() {
  constexpr std::size_t longest = std::size_t{16} << 20, at_once = 65536;
  std::string text;
  for (;;) {
    const std::size_t length = text.size();
    if (length > longest) return tl::unexpected(std::string("it is longer than 16 MiB"));
    text.resize(length + at_once);
    const ssize_t count = ::read(STDIN_FILENO, text.data() + length, at_once);
    const int error = errno;
    text.resize(length + static_cast<std::size_t>(count > 0 ? count : 0));
    if (count == 0) return text;
    if (count < 0 && error != EINTR) return tl::unexpected(std::string(std::strerror(error)));
  }
}

bool prepare_for_limited_memory(char** arguments) {
  if (!memory_is_limited()) return true;
  constexpr const char* threads = "OPENBLAS_NUM_THREADS";
  const char* const now = std::getenv(threads);
  std::array<char, PATH_MAX> program{};
  if ((!now || std::strcmp(now, "1") != 0) && ::setenv(threads, "1", 1) == 0 &&
      ::readlink("/proc/self/exe", program.data(), program.size() - 1) > 0)
    ::execv(program.data(), arguments);
  // The buffer of a thread, and something to work with.
  constexpr std::size_t buffer = std::size_t{128} << 20, least = std::size_t{16} << 20;
  if (!can_have(buffer + least)) return false;
  constexpr Eigen::Index size = 200;  // small products need none
  const Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(size, size);
  return dynalin::transposed_product(ones, ones)(0, 0) > 0;
}
