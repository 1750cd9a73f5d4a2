// Steps of a simulation set aside until it ends: rows of numbers in a file that nobody sees, so that memory does not
// grow with their count.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "output/temporary_file.h"

namespace dynalin {

class RequestSpool {
 public:
  // In this folder, for rows of so many numbers. The error is an errno.
  static tl::expected<RequestSpool, int> create(const std::string& folder, std::size_t row_size);

  int add(std::span<const double> row);  // 0, or an errno
  std::size_t rows() const { return rows_; }
  // Calls with every row in turn; 0, or an errno.
  int read(const std::function<void(std::span<const double> row)>&);

 private:
  RequestSpool(TemporaryFile file, std::size_t row_size) : file_(std::move(file)), row_size_(row_size) {}
  int flush();

  TemporaryFile file_;
  std::size_t row_size_, rows_ = 0;
  std::vector<double> waiting_;
};

}  // namespace dynalin
