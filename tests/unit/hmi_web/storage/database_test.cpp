#include "hmi_web/storage/database.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "hmi_web/storage/codes.h"
#include "hmi_web/storage/file_lock.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::storage {
namespace {

constexpr const char* kSchema =
    "CREATE TABLE entry(id INTEGER PRIMARY KEY, text TEXT, value REAL, data BLOB);";

DatabaseOptions options() {
  DatabaseOptions made;
  made.application = 77;
  made.schema_version = 3;
  return made;
}

TEST(Database, WhenValuesAreWritten_ThenTheyAreReadBackAfterReopening) {
  const support::TemporaryFolder folder;
  const std::vector<std::byte> bytes = {std::byte{0}, std::byte{255}, std::byte{7}};
  {
    auto database = Database::open(folder / "a.db", options(), kSchema);
    ASSERT_TRUE(database.has_value());
    auto insert = database->prepare("INSERT INTO entry(text, value, data) VALUES(?, ?, ?)");
    ASSERT_TRUE(insert.has_value());
    ASSERT_TRUE(insert->bind(1, std::string_view("it's \"quoted\"")).bind(2, 1.5).bind(3, bytes).run());
  }
  DatabaseOptions reading = options();
  reading.read_only = true;
  auto database = Database::open(folder / "a.db", reading);
  ASSERT_TRUE(database.has_value());
  auto select = database->prepare("SELECT text, value, data FROM entry");
  ASSERT_TRUE(select->step().value());
  EXPECT_EQ(select->text(0), "it's \"quoted\"");
  EXPECT_EQ(select->real(1), 1.5);
  EXPECT_TRUE(std::ranges::equal(select->bytes(2), bytes));
  EXPECT_FALSE(select->step().value());
  EXPECT_TRUE(database->check().has_value());
}

TEST(Database, WhenAFileIsMade_ThenOnlyItsOwnerReadsItAndItsJournal) {
  const support::TemporaryFolder folder;
  auto database = Database::open(folder / "a.db", options(), kSchema);
  ASSERT_TRUE(database.has_value());
  ASSERT_TRUE(database->prepare("INSERT INTO entry(text) VALUES('x')")->run());
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder / ".")) {
    constexpr auto kOthers = std::filesystem::perms::group_all | std::filesystem::perms::others_all;
    EXPECT_EQ(entry.status().permissions() & kOthers, std::filesystem::perms::none) << entry.path();
    ++files;
  }
  EXPECT_GE(files, 1);
}

TEST(Database, WhenTheFolderDoesNotExist_ThenTheFileIsNamed) {
  const support::TemporaryFolder folder;
  const auto database = Database::open(folder / "none" / "a.db", options(), kSchema);
  ASSERT_FALSE(database.has_value());
  EXPECT_EQ(database.error()[0].code, "S0001");
  EXPECT_EQ(database.error()[0].where.file, (folder / "none" / "a.db").string());
}

TEST(Database, WhenTheFileIsNoDatabase_ThenItIsDamagedAndLeftAlone) {
  const support::TemporaryFolder folder;
  const std::string text(5000, 'x');
  std::ofstream(folder / "a.db") << text;
  const auto database = Database::open(folder / "a.db", options(), kSchema);
  ASSERT_FALSE(database.has_value());
  EXPECT_EQ(database.error()[0].code, "S0002");
  EXPECT_TRUE(is_damage(database.error()));
  EXPECT_EQ(std::filesystem::file_size(folder / "a.db"), text.size());
}

TEST(Database, WhenTheFileIsOfAnotherKindOrNewer_ThenItIsRefusedButNotDamaged) {
  const support::TemporaryFolder folder;
  ASSERT_TRUE(Database::open(folder / "a.db", options(), kSchema).has_value());
  DatabaseOptions other = options();
  other.application = 78;
  const auto another = Database::open(folder / "a.db", other, kSchema);
  ASSERT_FALSE(another.has_value());
  EXPECT_EQ(another.error()[0].code, "S0008");
  EXPECT_FALSE(is_damage(another.error()));
  DatabaseOptions older = options();
  older.schema_version = 2;
  const auto newer = Database::open(folder / "a.db", older, kSchema);
  ASSERT_FALSE(newer.has_value());
  EXPECT_EQ(newer.error()[0].code, "S0008");
}

TEST(Database, WhenItMustNotGrow_ThenTheDiskIsFullAndTheTransactionCanBeTakenBack) {
  const support::TemporaryFolder folder;
  DatabaseOptions small = options();
  small.most_pages = 8;
  auto database = Database::open(folder / "a.db", small, kSchema);
  ASSERT_TRUE(database.has_value());
  auto insert = database->prepare("INSERT INTO entry(data) VALUES(?)");
  const std::vector<std::byte> much(100'000);
  ASSERT_TRUE(database->execute("BEGIN").has_value());
  const auto done = insert->bind(1, much).run();
  ASSERT_FALSE(done.has_value());
  EXPECT_EQ(done.error()[0].code, "S0003");
  database->roll_back();
  EXPECT_TRUE(database->execute("INSERT INTO entry(text) VALUES('fits')").has_value());
}

TEST(Database, WhenAnotherWritesAndDoesNotEnd_ThenItIsInUse) {
  const support::TemporaryFolder folder;
  DatabaseOptions hasty = options();
  hasty.busy_timeout_ms = 1;
  auto one = Database::open(folder / "a.db", hasty, kSchema);
  auto other = Database::open(folder / "a.db", hasty, kSchema);
  ASSERT_TRUE(one.has_value() && other.has_value());
  ASSERT_TRUE(one->execute("BEGIN IMMEDIATE").has_value());
  const auto refused = other->execute("BEGIN IMMEDIATE");
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error()[0].code, "S0004");
}

TEST(Database, WhenAStatementWouldNotEnd_ThenItFailsAtTheTimeThatIsSet) {
  const support::TemporaryFolder folder;
  auto database = Database::open(folder / "a.db", options(), kSchema);
  ASSERT_TRUE(database.has_value());
  database->end_after(std::chrono::milliseconds(20));
  const Database moved = std::move(*database);
  auto endless =
      moved.prepare("WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT count(*) FROM n");
  ASSERT_TRUE(endless.has_value());
  const auto row = endless->step();
  ASSERT_FALSE(row.has_value());
  EXPECT_EQ(row.error()[0].code, "S0009");
}

TEST(FileLock, WhenItIsTaken_ThenNobodyElseGetsItUntilItEnds) {
  const support::TemporaryFolder folder;
  {
    const auto first = FileLock::take(folder / "a.db");
    ASSERT_TRUE(first.has_value());
    const auto second = FileLock::take(folder / "a.db");
    ASSERT_FALSE(second.has_value());
    EXPECT_EQ(second.error()[0].code, "S0004");
    EXPECT_TRUE(is_in_use(second.error()));
    EXPECT_FALSE(is_of_the_disk(second.error())) << "it does not mend itself";
  }
  EXPECT_TRUE(FileLock::take(folder / "a.db").has_value());
  const auto nowhere = FileLock::take(folder / "none" / "a.db");
  EXPECT_EQ(nowhere.error()[0].code, "S0001");
  EXPECT_TRUE(is_of_the_disk(nowhere.error()));
}

}  // namespace
}  // namespace stepwright::storage
