#include "output/destination.h"

#include <fcntl.h>
#include <linux/magic.h>
#include <sys/stat.h>
#include <sys/statfs.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <cstring>

#include "base/working_folder.h"

namespace dynalin {

namespace {

// "a/b" is leaf b of folder a; "b" is leaf b of ".".
void split(const std::string& path, Destination& d) {
  const std::size_t slash = path.rfind('/');
  d.leaf = slash == std::string::npos ? path : path.substr(slash + 1);
  d.folder = slash == std::string::npos ? "." : slash == 0 ? "/" : path.substr(0, slash);
}

// Links such as /proc/self/fd/1, behind which there may be no name at all.
bool leads_to_descriptors(const std::string& folder) {
  struct statfs system {};
  return ::statfs(folder.c_str(), &system) == 0 && system.f_type == PROC_SUPER_MAGIC;
}

bool is_standard_output(const struct stat& status) {
  struct stat out {};
  return ::fstat(STDOUT_FILENO, &out) == 0 && out.st_dev == status.st_dev && out.st_ino == status.st_ino;
}

// Follows links until a name that is none; false where they lead into the descriptors of a process.
tl::expected<bool, std::string> follow_links(Destination& d) {
  constexpr int most_links = 40;
  for (int links = 0; links <= most_links; ++links) {
    struct stat status {};
    const std::string path = d.path();
    if (::lstat(path.c_str(), &status) != 0) {
      if (errno == ENOENT) return true;
      return tl::unexpected(std::string(std::strerror(errno)));
    }
    if (!S_ISLNK(status.st_mode)) return true;
    if (leads_to_descriptors(d.folder)) return false;
    std::array<char, PATH_MAX> target{};
    const ssize_t length = ::readlink(path.c_str(), target.data(), target.size());
    if (length < 0) return tl::unexpected(std::string(std::strerror(errno)));
    const std::string text(target.data(), static_cast<std::size_t>(length));
    split(text.starts_with('/') ? text : d.folder + "/" + text, d);
  }
  return tl::unexpected(std::string(std::strerror(ELOOP)));
}

}  // namespace

tl::expected<Destination, std::string> find_destination(const std::string& name) {
  return_to_working_folder();
  Destination d;
  d.name = name;
  if (name == "-") {
    d.kind = Destination::Kind::standard_output;
    return d;
  }
  if (name.empty()) return tl::unexpected(std::string("its name is empty"));
  struct stat status {};
  const bool exists = ::stat(name.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) return tl::unexpected(std::string("it is a directory"));
  split(name, d);
  if (d.leaf.empty()) return tl::unexpected(std::string("it is no name of a file"));
  if (exists && is_standard_output(status)) {
    d.kind = Destination::Kind::standard_output;
    return d;
  }
  const auto named = follow_links(d);
  if (!named) return tl::unexpected(named.error());
  if (exists && (!*named || !S_ISREG(status.st_mode))) {
    d.kind = Destination::Kind::written_to;
    return d;
  }
  struct stat folder {};
  if (::stat(d.folder.c_str(), &folder) != 0 || !S_ISDIR(folder.st_mode))
    return tl::unexpected("there is no folder " + d.folder);
  d.device = folder.st_dev;
  d.folder_number = folder.st_ino;
  return d;
}

std::string why_not_writable(const Destination& d) {
  const auto refused = [](const std::string& path, int mode) {
    return ::faccessat(AT_FDCWD, path.c_str(), mode, AT_EACCESS) != 0;
  };
  switch (d.kind) {
    case Destination::Kind::standard_output:
      return {};
    case Destination::Kind::written_to:
      return refused(d.name, W_OK) ? std::strerror(errno) : "";
    case Destination::Kind::replaced:
      break;
  }
  if (refused(d.folder, W_OK | X_OK)) return std::strerror(errno) + (": the folder " + d.folder);
  struct stat status {};
  const bool exists = ::lstat(d.path().c_str(), &status) == 0;
  return exists && refused(d.path(), W_OK) ? std::strerror(errno) : "";
}

void InputFiles::add(const std::string& name) {
  if (const auto d = find_destination(name); d && d->kind == Destination::Kind::replaced)
    name_.emplace(d->place(), name);
}

const std::string* InputFiles::replaced_by(const Destination& d) const {
  const auto found = name_.find(d.place());
  return d.kind == Destination::Kind::replaced && found != name_.end() ? &found->second : nullptr;
}

}  // namespace dynalin
