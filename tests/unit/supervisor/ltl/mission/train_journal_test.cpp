#include "supervisor/ltl/mission/train_journal.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temporary_folder.h"

namespace stepwright::ltl {
namespace {

TEST(TrainJournal, WhenItIsWritten_ThenTheSameIsRead) {
  const support::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "journal.json";
  TrainJournal journal;
  journal.task = "visit press";
  journal.watched = "visit rack";
  journal.state = 3;
  journal.next_request = 2;
  journal.blocked = {{.name = "crate", .ring = {{1, 2}, {3, 2}, {3, 4}}, .where = {}}};
  ASSERT_TRUE(write_train_journal(file, journal));
  const auto read = read_train_journal(file);
  ASSERT_TRUE(read && *read);
  EXPECT_EQ((*read)->task, journal.task);
  EXPECT_EQ((*read)->watched, "visit rack");
  EXPECT_EQ((*read)->state, 3u);
  EXPECT_EQ((*read)->next_request, 2u);
  ASSERT_EQ((*read)->blocked.size(), 1u);
  EXPECT_EQ((*read)->blocked[0].name, "crate");
  EXPECT_EQ((*read)->blocked[0].ring.size(), 3u);
}

TEST(TrainJournal, WhenThereIsNoneOrAWrongOne_ThenThatIsTold) {
  const support::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "journal.json";
  const auto none = read_train_journal(file);
  ASSERT_TRUE(none);
  EXPECT_FALSE(*none);
  TrainJournal journal;
  journal.blocked = {{.name = "line", .ring = {{1, 2}, {3, 2}}, .where = {}}};
  ASSERT_TRUE(write_train_journal(file, journal));
  const auto flat = read_train_journal(file);
  ASSERT_FALSE(flat);
  EXPECT_EQ(flat.error().front().code, "X0001");
  std::ofstream(file) << "{\"version\": 1}";
  EXPECT_FALSE(read_train_journal(file));
}

}  // namespace
}  // namespace stepwright::ltl
