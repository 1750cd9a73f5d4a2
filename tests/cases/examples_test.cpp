// Everything that is shipped, through the program, the library and decks of its models.
#include "places/examples.h"

#include "cases/decks.h"

namespace dynalin::cases::examples_test {
namespace {

using Examples = ProgramLibraryAndDecks;

// Every command file under examples.
TEST_F(Examples, run_through_program_library_and_decks) {
  const std::vector<std::filesystem::path> found = files_of_examples(examples_folder(), ".acf");
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
}  // namespace dynalin::cases::examples_test
