// What edits have stated anew since a point was found, for a point of any of the models before.
#include "library/edit_history.h"

#include <gtest/gtest.h>

#include "system/model_test_support.h"

namespace dynalin::library::edit_history_test {
namespace {

using SystemRef = std::shared_ptr<const System>;
SystemRef a_system() { return system_test::system_of(""); }
Restated one(std::int64_t id) {
  Restated restated;
  restated.begin({"PART", id});
  return restated;
}
std::set<std::int64_t> parts(const Restated& restated) {
  std::set<std::int64_t> ids;
  for (const auto& [statement, id] : restated.anew()) ids.insert(id);
  return ids;
}
using Ids = std::set<std::int64_t>;

TEST(EditHistory, tells_what_came_after_a_model) {
  const SystemRef first = a_system(), second = a_system(), third = a_system();
  const EditHistory history = EditHistory().after(first, one(1)).after(second, one(2)).after(third, one(3));
  EXPECT_EQ(parts(history.restated_since(first)), (Ids{1, 2, 3}));
  EXPECT_EQ(parts(history.restated_since(second)), (Ids{2, 3}));
  EXPECT_EQ(parts(history.restated_since(third)), (Ids{3}));
  EXPECT_EQ(parts(history.restated_since(a_system())), (Ids{1, 2, 3}));
  EXPECT_TRUE(EditHistory().restated_since(first).empty());
}

TEST(EditHistory, of_a_model_does_not_change_with_those_made_of_it) {
  const SystemRef first = a_system(), second = a_system();
  const EditHistory before = EditHistory().after(first, one(1));
  const EditHistory after = before.after(second, one(2));
  EXPECT_EQ(parts(before.restated_since(first)), (Ids{1}));
  EXPECT_EQ(parts(after.restated_since(first)), (Ids{1, 2}));
}

// Nobody has a point of a model that is gone: its edit counts with the one before, so that long chains stay short.
TEST(EditHistory, keeps_what_models_that_are_gone_have_stated) {
  const SystemRef first = a_system(), last = a_system();
  EditHistory history = EditHistory().after(first, one(1));
  {
    const SystemRef passing = a_system();
    history = history.after(passing, one(2));
  }
  history = history.after(last, one(3));
  EXPECT_EQ(parts(history.restated_since(first)), (Ids{1, 2, 3}));
  EXPECT_EQ(parts(history.restated_since(last)), (Ids{3}));
  EditHistory without_first;
  {
    const SystemRef gone = a_system();
    without_first = EditHistory().after(gone, one(8));
  }
  without_first = without_first.after(last, one(9));
  EXPECT_EQ(parts(without_first.restated_since(last)), (Ids{9}));
  EXPECT_EQ(parts(without_first.restated_since(first)), (Ids{8, 9}));
  const SystemRef newest = a_system();
  EXPECT_EQ(parts(without_first.after(newest, one(10)).restated_since(first)), (Ids{8, 9, 10}));
}

TEST(EditHistory, does_not_grow_with_models_that_are_gone) {
  const SystemRef first = a_system();
  EditHistory history = EditHistory().after(first, one(0));
  for (std::int64_t id = 1; id <= 20; ++id) {
    const SystemRef passing = a_system();
    history = history.after(passing, one(id));
    EXPECT_EQ(history.told_apart(), 2u);
  }
  EXPECT_EQ(parts(history.restated_since(first)).size(), 21u);
}

}  // namespace
}  // namespace dynalin::library::edit_history_test
