// Everything that is shipped, through the program, the library and decks of its models.
#include "cases/decks.h"
#include "places/source_tree.h"

namespace dynalin::cases {
namespace {

using Examples = ProgramLibraryAndDecks;

// Every command file under examples. What a folder has to `prepare` first has a test of its own (tests/scripts).
TEST_F(Examples, run_through_program_library_and_decks) {
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(examples_folder())) {
    const auto prepare = entry.path().parent_path() / "prepare";
    if (entry.path().extension() == ".acf" && !std::filesystem::exists(prepare)) found.push_back(entry.path());
  }
  EXPECT_GE(found.size(), 6u);
  for (const std::filesystem::path& file : found) {
    SCOPED_TRACE(file);
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    const RunResult r = run_example(file.parent_path().filename(), file.filename());
    EXPECT_EQ(r.status, 0) << r.err;
  }
}

}  // namespace
}  // namespace dynalin::cases
