#include "runtime/ground/files/durable_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/temporary_folder.h"

namespace stepwright::files {
namespace {

namespace fs = std::filesystem;

constexpr Owner kMine{"X9999", "look at the folder"};

std::string content(const fs::path& path) {
  return read_text(path, 1u << 20, kMine).value().value_or("there is none");
}

mode_t mode_of(const fs::path& path) {
  struct stat info {};
  EXPECT_EQ(stat(path.c_str(), &info), 0);
  return info.st_mode & 0777;
}

void expect_mine(const result::Diagnostics& problems, const fs::path& path) {
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].code, kMine.code);
  EXPECT_EQ(problems[0].hint, kMine.hint);
  EXPECT_EQ(problems[0].where.file, path.string());
}

TEST(DurableFile, WhenReplaced_ThenItIsTheOwnersAloneAndNothingElseIsLeft) {
  const support::TemporaryFolder folder;
  const fs::path file = folder / "state";
  ASSERT_TRUE(replace_file(file, "old and longer", kMine));
  std::ofstream(folder / "state.new") << "of somebody else";
  fs::permissions(folder / "state.new", fs::perms::all);
  ASSERT_TRUE(replace_file(file, "new", kMine));
  EXPECT_EQ(content(file), "new");
  EXPECT_EQ(mode_of(file), 0600u);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(DurableFile, WhenItCannotBeReplaced_ThenTheOldOneIsThereAndTheOwnersCodeSaysSo) {
  const support::TemporaryFolder folder;
  const fs::path file = folder / "state";
  ASSERT_TRUE(replace_file(file, "old", kMine));
  fs::create_directory(folder / "state.new");
  const auto refused = replace_file(file, "new", kMine);
  ASSERT_FALSE(refused);
  expect_mine(refused.error(), file);
  EXPECT_EQ(content(file), "old");
  fs::remove(folder / "state.new");
  fs::create_symlink(file, folder / "state.new");  // a link in the way is not followed
  EXPECT_FALSE(replace_file(file, "new", kMine));
  EXPECT_EQ(content(file), "old");
  // What is beside a file that could not come to its place is gone.
  fs::create_directory(folder / "taken");
  EXPECT_FALSE(replace_file(folder / "taken", "new", kMine));
  EXPECT_FALSE(fs::exists(folder / "taken.new"));
}

TEST(DurableFile, WhenRead_ThenNoFileIsNothingAndMoreThanMeantIsRefused) {
  const support::TemporaryFolder folder;
  const fs::path file = folder / "state";
  EXPECT_FALSE(read_bytes(file, 4, kMine).value());
  ASSERT_TRUE(replace_file(file, "1234", kMine));
  EXPECT_EQ(read_bytes(file, 4, kMine).value()->size(), 4u);
  EXPECT_EQ(read_bounded(file, 2), "123");
  EXPECT_FALSE(read_bounded(folder / "none", 2));
  const auto refused = read_text(file, 3, kMine);
  ASSERT_FALSE(refused);
  expect_mine(refused.error(), file);
  EXPECT_FALSE(read_text(folder.path(), 3, kMine));
  EXPECT_FALSE(read_text("/dev/zero", 3, kMine));
}

TEST(DurableFile, WhenRemoved_ThenItIsGoneAndTheNextTimeThereIsNone) {
  const support::TemporaryFolder folder;
  ASSERT_TRUE(make_private_folder(folder / "private", kMine));
  EXPECT_EQ(mode_of(folder / "private"), 0700u);
  ASSERT_TRUE(make_private_folder(folder / "private", kMine));
  const fs::path file = folder / "private" / "state";
  ASSERT_TRUE(replace_file(file, "1", kMine));
  EXPECT_TRUE(remove_file(file, kMine).value());
  EXPECT_FALSE(remove_file(file, kMine).value());
  EXPECT_FALSE(remove_file(folder.path(), kMine));
  expect_mine(sync_folder_of(folder / "none/state", kMine).error(), folder / "none/state");
}

TEST(DurableFile, WhenAppended_ThenItGrowsAndAFailureIsTold) {
  const support::TemporaryFolder folder;
  const fs::path file = folder / "trail";
  const auto opened = open_for_append(file, kMine);
  ASSERT_TRUE(opened);
  ASSERT_TRUE(append(*opened, file, "a\n", kMine));
  ASSERT_TRUE(append(*opened, file, "b\n", kMine));
  EXPECT_EQ(content(file), "a\nb\n");
  EXPECT_EQ(mode_of(file), 0600u);
  const Descriptor closed;
  const auto refused = append(closed, file, "c\n", kMine);
  ASSERT_FALSE(refused);
  expect_mine(refused.error(), file);
  EXPECT_EQ(content(file), "a\nb\n");
}

// As on a disk that is full: the first bytes of the text are taken, and the rest is not.
TEST(DurableFile, WhenOnlyHalfOfATextFits_ThenNothingOfItStays) {
  const support::TemporaryFolder folder;
  const fs::path file = folder / "trail";
  const auto opened = open_for_append(file, kMine);
  ASSERT_TRUE(opened);
  ASSERT_TRUE(append(*opened, file, "a\n", kMine));
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit few{4, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &few), 0);
  const auto appended = append(*opened, file, "long\n", kMine);
  const auto replaced = replace_file(folder / "state", "long\n", kMine);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  ASSERT_FALSE(appended);
  ASSERT_FALSE(replaced);
  EXPECT_EQ(content(file), "a\n");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

}  // namespace
}  // namespace stepwright::files
