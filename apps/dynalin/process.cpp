#include "process.h"

#include <dlfcn.h>
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
#include <string_view>
#include <thread>

#include "base/dense_products.h"
#include "dynalin/threads.h"

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

// With a variable of the environment that libraries have read by now. Returns where that cannot be.
void begin_anew(char** arguments, const char* variable, const char* value) {
  std::array<char, PATH_MAX> program{};
  if (::setenv(variable, value, 1) == 0 && ::readlink("/proc/self/exe", program.data(), program.size() - 1) > 0)
    ::execv(program.data(), arguments);
}

// Those of OpenBLAS that this processor is able to run, null for what is there anyway.
const char* kernels_of_processor() {
#ifdef __x86_64__
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512cd"))
    return "SkylakeX";
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "Haswell";
#endif
  return nullptr;
}

}  // namespace

void use_kernels_of_processor(char** arguments) {
  constexpr const char* kernels = "OPENBLAS_CORETYPE";
  constexpr std::string_view oldest = "Prescott";
  const auto in_use = reinterpret_cast<const char* (*)()>(::dlsym(RTLD_DEFAULT, "openblas_get_corename"));
  const char* const better = kernels_of_processor();
  if (!std::getenv(kernels) && better && in_use && in_use() == oldest) begin_anew(arguments, kernels, better);
}

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

bool has_memory_for_threads() {
  return memory_limit() >= (std::thread::hardware_concurrency() + 1) * buffer + 1024 * mebibyte;
}

bool prepare_for_limited_memory(char** arguments) {
  if (memory_limit() == RLIM_INFINITY) return true;
  const bool enough_for_threads = has_memory_for_threads();
  constexpr const char* threads = "OPENBLAS_NUM_THREADS";
  const char* const now = std::getenv(threads);
  const bool alone = now && std::strcmp(now, "1") == 0;
  if (!enough_for_threads && !alone) begin_anew(arguments, threads, "1");
  // Each of ours takes such a buffer as soon as it calls for a product.
  if (!enough_for_threads) dynalin::set_thread_count(1);
  if (!can_have(buffer + 16 * mebibyte)) return false;
  constexpr Eigen::Index size = 200;  // small products need none
  const Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(size, size);
  return dynalin::transposed_product(ones, ones)(0, 0) > 0;
}
