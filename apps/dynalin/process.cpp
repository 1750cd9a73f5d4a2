#include "process.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <thread>

#include "linear/dense_products.h"

namespace {

constexpr std::size_t mebibyte = std::size_t{1} << 20, buffer = 128 * mebibyte;  // of each thread of OpenBLAS

rlim_t memory_limit() {
  struct rlimit limit {};
  rlim_t least = RLIM_INFINITY;
  for (const auto which : {RLIMIT_AS, RLIMIT_DATA}) {
    if (::getrlimit(which, &limit) == 0) least = std::min(least, limit.rlim_cur);
  }
  return least;
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
  const rlim_t limit = memory_limit();
  if (limit == RLIM_INFINITY) return true;
  const bool enough_for_threads = limit >= (std::thread::hardware_concurrency() + 1) * buffer + 1024 * mebibyte;
  constexpr const char* threads = "OPENBLAS_NUM_THREADS";
  const char* const now = std::getenv(threads);
  const bool alone = now && std::strcmp(now, "1") == 0;
  std::array<char, PATH_MAX> program{};
  if (!enough_for_threads && !alone && ::setenv(threads, "1", 1) == 0 &&
      ::readlink("/proc/self/exe", program.data(), program.size() - 1) > 0)
    ::execv(program.data(), arguments);
  if (!can_have(buffer + 16 * mebibyte)) return false;
  constexpr Eigen::Index size = 200;  // small products need none
  const Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(size, size);
  return dynalin::transposed_product(ones, ones)(0, 0) > 0;
}
