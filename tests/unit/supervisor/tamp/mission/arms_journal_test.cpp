#include "supervisor/tamp/mission/arms_journal.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temporary_folder.h"

namespace stepwright::tamp::mission {
namespace {

TEST(ArmsJournal, WhenItIsWritten_ThenTheSameIsRead) {
  const support::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "journal.json";
  ArmsJournal journal;
  journal.order = "(in cup1 table)";
  journal.believed = {{"cup1", {0.4, -0.2, 0.7, 1.0}}};
  journal.held = {{"left", "cup1"}};
  journal.tries = {{"cup1", 2}};
  journal.looks = 4;
  journal.next_request = 1;
  ASSERT_TRUE(write_arms_journal(file, journal));
  const auto read = read_arms_journal(file);
  ASSERT_TRUE(read && *read);
  EXPECT_EQ((*read)->order, journal.order);
  EXPECT_EQ((*read)->believed, journal.believed);
  EXPECT_EQ((*read)->held, journal.held);
  EXPECT_EQ((*read)->tries, journal.tries);
  EXPECT_EQ((*read)->looks, 4u);
  EXPECT_EQ((*read)->next_request, 1u);
}

TEST(ArmsJournal, WhenThereIsNoneOrAWrongOne_ThenThatIsTold) {
  const support::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "journal.json";
  const auto none = read_arms_journal(file);
  ASSERT_TRUE(none);
  EXPECT_FALSE(*none);
  std::ofstream(file) << "{\"version\": 1}";
  const auto wrong = read_arms_journal(file);
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().front().code, "X0001");
}

}  // namespace
}  // namespace stepwright::tamp::mission
