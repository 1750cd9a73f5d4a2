#include "output/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string_view>

#include "base/working_folder.h"

namespace dynalin {

namespace {

// 0, or an errno.
int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return count < 0 ? errno : ENOSPC;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return 0;
}

mode_t mode_of_new_files() {
  const mode_t mask = ::umask(077);
  ::umask(mask);
  return 0666 & ~mask;
}

// The name itself must be on the disk as well. File systems that cannot do that say EINVAL.
int sync_folder(const std::string& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return 0;  // a folder may be written to and not read
  const int error = ::fsync(descriptor) == 0 || errno == EINVAL ? 0 : errno;
  ::close(descriptor);
  return error;
}

}  // namespace

int OutputFile::Buffer::sync() {
  const std::string_view bytes(pbase(), static_cast<std::size_t>(pptr() - pbase()));
  setp(bytes_.data(), bytes_.data() + bytes_.size());
  if (error_ == 0) error_ = write_all(descriptor_, bytes);
  return error_ == 0 ? 0 : -1;
}

int OutputFile::Buffer::overflow(int c) {
  if (sync() != 0) return traits_type::eof();
  if (!traits_type::eq_int_type(c, traits_type::eof())) {
    *pptr() = traits_type::to_char_type(c);
    pbump(1);
  }
  return traits_type::not_eof(c);
}

tl::unexpected<std::string> OutputFile::failed(int error) const {
  return tl::unexpected("cannot write " + destination_.name + ": " + std::strerror(error));
}

tl::expected<std::unique_ptr<OutputFile>, std::string> OutputFile::create(Destination destination) {
  std::unique_ptr<OutputFile> file(new OutputFile(std::move(destination)));
  if (file->destination_.kind != Destination::Kind::replaced) {
    file->stream_ = std::make_unique<std::ostringstream>();
    return file;
  }
  auto temporary = TemporaryFile::create(file->destination_.folder);
  if (!temporary) return file->failed(temporary.error());
  file->temporary_ = std::make_unique<TemporaryFile>(std::move(*temporary));
  file->buffer_ = std::make_unique<Buffer>(file->temporary_->descriptor());
  file->stream_ = std::make_unique<std::ostream>(file->buffer_.get());
  return file;
}

tl::expected<std::unique_ptr<OutputFile>, std::string> create_output(const std::string& path) {
  auto destination = find_destination(path);
  if (!destination) return tl::unexpected("cannot write " + path + ": " + destination.error());
  return OutputFile::create(std::move(*destination));
}

tl::expected<void, std::string> OutputFile::so_far() const {
  if (buffer_ && buffer_->error() != 0) return failed(buffer_->error());
  return {};
}

tl::expected<void, std::string> OutputFile::complete() {
  if (!buffer_) return {};
  return_to_working_folder();
  stream_->flush();
  if (buffer_->error() != 0) return failed(buffer_->error());
  const int descriptor = temporary_->descriptor();
  // A file that is replaced keeps its permissions and, where that is allowed, its owner.
  struct stat before {};
  const bool exists = ::lstat(destination_.path().c_str(), &before) == 0 && S_ISREG(before.st_mode);
  if (exists && ::fchown(descriptor, before.st_uid, before.st_gid) != 0) errno = 0;
  if (::fchmod(descriptor, exists ? before.st_mode & 0777 : mode_of_new_files()) != 0) return failed(errno);
  if (::fsync(descriptor) != 0 && errno != EINVAL) return failed(errno);
  buffer_.reset();
  if (const int error = temporary_->close(); error != 0) return failed(error);
  return {};
}

OutputFile::Result OutputFile::deliver(std::ostream& standard_output) const {
  if (temporary_) return {};
  const std::string bytes = static_cast<const std::ostringstream&>(*stream_).str();
  if (destination_.kind == Destination::Kind::standard_output) {
    standard_output << bytes << std::flush;  // whoever owns it looks at its state
    return {};
  }
  const int descriptor = ::open(destination_.name.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC | O_NOCTTY);
  if (descriptor < 0) return failed(errno);
  int error = write_all(descriptor, bytes);
  if (::close(descriptor) != 0 && error == 0 && errno != EINTR) error = errno;
  if (error != 0) return failed(error);
  return {};
}

OutputFile::Result OutputFile::appear() {
  if (!temporary_) return {};
  return_to_working_folder();
  const std::string path = destination_.path();
  const auto rename_with = [&](unsigned flags) {
    return ::renameat2(AT_FDCWD, temporary_->path(), AT_FDCWD, path.c_str(), flags) == 0;
  };
  // Another process may make or remove the same file at any moment.
  constexpr int attempts = 3;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    struct stat before {};
    const bool exists = ::lstat(path.c_str(), &before) == 0;
    if (exists && !S_ISREG(before.st_mode))
      return tl::unexpected("cannot write " + destination_.name + ": it is no regular file any more");
    // The exchange keeps what was there, should another file of the run fail.
    if (rename_with(exists ? RENAME_EXCHANGE : RENAME_NOREPLACE)) {
      replaced_another_ = exists;
      return {};
    }
    if (errno != EEXIST && errno != ENOENT) break;
  }
  const bool without_flags = errno == EINVAL || errno == ENOSYS;  // on this file system
  if (!without_flags || ::rename(temporary_->path(), path.c_str()) != 0) return failed(errno);
  return {};
}

void OutputFile::vanish() {
  if (!temporary_) return;
  const unsigned flags = replaced_another_ ? RENAME_EXCHANGE : 0;
  ::renameat2(AT_FDCWD, destination_.path().c_str(), AT_FDCWD, temporary_->path(), flags);
}

tl::expected<void, std::string> commit(const std::vector<std::unique_ptr<OutputFile>>& files,
                                       std::ostream& standard_output) {
  for (const auto& file : files) {
    if (auto result = file->complete(); !result) return result;
  }
  // What cannot be taken back comes when little can fail any more.
  for (const auto& file : files) {
    if (auto result = file->deliver(standard_output); !result) return result;
  }
  const WithoutSignals uninterrupted;
  for (std::size_t k = 0; k < files.size(); ++k) {
    auto result = files[k]->appear();
    if (result) continue;
    while (k-- > 0) files[k]->vanish();
    return result;
  }
  std::vector<std::string> folders;
  for (const auto& file : files) {
    if (file->temporary_) folders.push_back(file->destination_.folder);
    if (file->temporary_ && !file->replaced_another_) file->temporary_->keep();
  }
  std::sort(folders.begin(), folders.end());
  folders.erase(std::unique(folders.begin(), folders.end()), folders.end());
  for (const std::string& folder : folders) {
    if (const int error = sync_folder(folder); error != 0)
      return tl::unexpected("cannot write the folder " + folder + ": " + std::strerror(error));
  }
  return {};
}

}  // namespace dynalin
