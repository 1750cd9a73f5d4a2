// Where the bytes of a named output go. A regular file is replaced as a whole. A device or a pipe is written to and
// never replaced, and `-` is standard output. Links are followed: they stay links, and one file under several names is
// one.
#pragma once

#include <sys/types.h>

#include <map>
#include <string>
#include <tl/expected.hpp>
#include <tuple>

namespace dynalin {

struct Destination {
  enum class Kind { replaced, written_to, standard_output };

  std::string name;  // as the user wrote it
  Kind kind = Kind::replaced;
  std::string folder, leaf;  // of the file that is replaced, behind all links; the folder exists
  dev_t device = 0;          // with the leaf: what tells its place from all others
  ino_t folder_number = 0;

  std::string path() const { return folder + "/" + leaf; }
  using Place = std::tuple<dev_t, ino_t, std::string>;
  Place place() const { return {device, folder_number, leaf}; }  // one for one file that is replaced
};

// Nothing is written. The error is a reason to stand behind the name: "there is no folder out".
tl::expected<Destination, std::string> find_destination(const std::string& name);
// Whether it may be written, as far as permissions tell: empty, or a reason.
std::string why_not_writable(const Destination&);

// The files that a run reads: no result may take the place of one.
class InputFiles {
 public:
  // What is no regular file stays what it is in any case.
  void add(const std::string& name);
  // The name under which the file was read that would be replaced; null if none is.
  const std::string* replaced_by(const Destination&) const;

 private:
  std::map<Destination::Place, std::string> name_;
};

}  // namespace dynalin
