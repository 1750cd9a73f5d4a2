#include "output/request_spool.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>

namespace dynalin {

tl::expected<RequestSpool, int> RequestSpool::create(const std::string& folder, std::size_t row_size) {
  auto file = TemporaryFile::create(folder);
  if (!file) return tl::unexpected(file.error());
  return RequestSpool(std::move(*file), row_size);
}

int RequestSpool::flush() {
  const char* bytes = reinterpret_cast<const char*>(waiting_.data());
  std::size_t left = waiting_.size() * sizeof(double);
  while (left > 0) {
    const ssize_t count = ::write(file_.descriptor(), bytes, left);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return count < 0 ? errno : ENOSPC;
    bytes += count, left -= static_cast<std::size_t>(count);
  }
  waiting_.clear();
  return 0;
}

int RequestSpool::add(std::span<const double> row) {
  constexpr std::size_t enough = 8192;
  waiting_.insert(waiting_.end(), row.begin(), row.end());
  ++rows_;
  return waiting_.size() < enough ? 0 : flush();
}

int RequestSpool::read(const std::function<void(std::span<const double>)>& use) {
  if (const int error = flush(); error != 0) return error;
  const std::size_t bytes = rows_ * row_size_ * sizeof(double);
  if (bytes == 0) return 0;
  void* map = ::mmap(nullptr, bytes, PROT_READ, MAP_SHARED, file_.descriptor(), 0);
  if (map == MAP_FAILED) return errno;
  const auto* numbers = static_cast<const double*>(map);
  for (std::size_t k = 0; k < rows_; ++k) use({numbers + k * row_size_, row_size_});
  ::munmap(map, bytes);
  return 0;
}

}  // namespace dynalin
