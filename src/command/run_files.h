// The files of a run: made one after the other, and put under their names together.
#pragma once

#include <functional>
#include <iosfwd>
#include <map>
#include <memory>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "output/matrices.h"
#include "output/output_file.h"

namespace dynalin {

class RunFiles {
 public:
  // None of them may take the place of one of these, which live as long.
  explicit RunFiles(const InputFiles& inputs) : inputs_(inputs) {}

  using Result = tl::expected<void, std::string>;
  struct Planned {
    std::string path;
    std::function<void(std::ostream&)> content;
  };
  // All of them, or none. A file that an earlier call made under the same name is replaced.
  Result add(const std::vector<Planned>&);
  // One that grew as the run went on.
  Result add(std::unique_ptr<OutputFile>);
  // Under their names, or after an error none. What is added later is committed by itself.
  Result commit(std::ostream& standard_output);
  // Of files that are replaced as a whole, as the user wrote them, in the order of their making.
  std::vector<std::string> names() const;
  const InputFiles& inputs() const { return inputs_; }

 private:
  Result no_input(const Destination&) const;
  void keep(std::unique_ptr<OutputFile>);

  const InputFiles& inputs_;
  std::vector<std::string> committed_;
  std::vector<std::unique_ptr<OutputFile>> files_;
  std::map<Destination::Place, std::size_t> place_of_file_;  // among files_
};

// State matrices in one of the two formats; `base` is the file, or what the names of the files begin with.
std::vector<RunFiles::Planned> matrix_files(const std::string& base, const std::string& format,
                                            const std::vector<NamedMatrix>&);

}  // namespace dynalin
