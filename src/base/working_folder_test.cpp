// Files are where their names say, whatever becomes of the working folder meanwhile.
#include "base/working_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace dynalin::working_folder_test {
namespace {

TEST(WorkingFolder, is_that_which_was_kept) {
  EXPECT_EXIT(
      {
        const auto before = std::filesystem::current_path();
        return_to_working_folder();
        const bool stays = std::filesystem::current_path() == before;
        keep_working_folder();
        std::filesystem::current_path("/");
        return_to_working_folder();
        std::_Exit(stays && std::filesystem::current_path() == before ? 0 : 1);
      },
      ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace dynalin::working_folder_test
