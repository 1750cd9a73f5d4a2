// A file that appears under its name only when it is complete, and together with all others of its run or not at all.
#pragma once

#include <array>
#include <memory>
#include <ostream>
#include <sstream>
#include <streambuf>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "output/destination.h"
#include "output/temporary_file.h"

namespace dynalin {

class OutputFile {
 public:
  // Nothing can be seen of it before commit; the error says which file and why.
  static tl::expected<std::unique_ptr<OutputFile>, std::string> create(Destination);

  const Destination& destination() const { return destination_; }
  std::ostream& stream() { return *stream_; }
  // Whether what was written until now could be written.
  tl::expected<void, std::string> so_far() const;
  // Nothing more is written to it: all bytes are on the disk, under a temporary name, and it is closed.
  tl::expected<void, std::string> complete();

 private:
  // Writes to a descriptor and remembers the first error.
  class Buffer final : public std::streambuf {
   public:
    explicit Buffer(int descriptor) : descriptor_(descriptor) { setp(bytes_.data(), bytes_.data() + bytes_.size()); }
    int error() const { return error_; }

   private:
    int overflow(int c) override;
    int sync() override;
    int descriptor_;
    int error_ = 0;
    std::array<char, 65536> bytes_{};
  };
  using Result = tl::expected<void, std::string>;

  OutputFile(Destination destination) : destination_(std::move(destination)) {}
  tl::unexpected<std::string> failed(int error) const;
  Result deliver(std::ostream& standard_output) const;  // what is written to and not replaced
  Result appear();                                      // under its name; what was there is under the temporary one
  void vanish();                                        // takes the last back
  friend Result commit(const std::vector<std::unique_ptr<OutputFile>>&, std::ostream&);

  Destination destination_;
  std::unique_ptr<TemporaryFile> temporary_;  // of a file that is replaced
  std::unique_ptr<Buffer> buffer_;
  std::unique_ptr<std::ostream> stream_;  // into the buffer, or for all others into memory
  bool replaced_another_ = false;
};

// A file under a name as the user writes it.
tl::expected<std::unique_ptr<OutputFile>, std::string> create_output(const std::string& path);

// All of them or, after an error, none: what stood under their names before is back.
tl::expected<void, std::string> commit(const std::vector<std::unique_ptr<OutputFile>>&, std::ostream& standard_output);

}  // namespace dynalin
