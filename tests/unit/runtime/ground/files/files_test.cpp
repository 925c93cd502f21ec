#include "runtime/ground/files/files.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/temporary_folder.h"

namespace stepwright::files {
namespace {

namespace fs = std::filesystem;

TEST(Files, WhenAFileIsWritten_ThenTheOldOneIsReplacedAndNothingElseLeft) {
  const support::TemporaryFolder folder;
  const std::string file = folder / "report.json";
  ASSERT_TRUE(write_file(file, "old and longer").empty());
  ASSERT_TRUE(write_file(file, "new").empty());
  EXPECT_EQ(read_file(file).value(), "new");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(Files, WhenTheNameIsALink_ThenItStaysOneAndItsTargetIsReplaced) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "target") << "old";
  fs::create_symlink("target", folder / "link");
  ASSERT_TRUE(write_file(folder / "link", "new").empty());
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(read_file(folder / "target").value(), "new");
}

TEST(Files, WhenTheNameIsAPipe_ThenItIsWrittenToAndStaysOne) {
  const support::TemporaryFolder folder;
  const std::string pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  EXPECT_TRUE(check_writable(pipe).empty());
  EXPECT_TRUE(write_file(pipe, "bytes").empty());
  std::string taken(16, '\0');
  const ssize_t size = read(reader, taken.data(), taken.size());
  close(reader);
  EXPECT_EQ(taken.substr(0, static_cast<std::size_t>(std::max<ssize_t>(size, 0))), "bytes");
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST(Files, WhenAFileCannotBeWritten_ThenE0002SaysWhyBeforeAndAfter) {
  const support::TemporaryFolder folder;
  for (const std::string& path : {(folder / "none/file").string(), folder.path().string()}) {
    for (const result::Diagnostics& refused : {check_writable(path), write_file(path, "text")}) {
      ASSERT_EQ(refused.size(), 1u) << path;
      EXPECT_EQ(refused[0].code, "E0002");
      EXPECT_EQ(refused[0].where.file, path);
      EXPECT_FALSE(refused[0].hint.empty());
    }
  }
  EXPECT_TRUE(check_writable(folder / "new").empty());
  EXPECT_TRUE(check_writable("new in the current folder").empty());
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(Files, WhenAFileHasAnOwner_ThenItsCodeAndHintSayWhyItCannotBeWritten) {
  const support::TemporaryFolder folder;
  const Owner owner{"X9999", "look at the folder"};
  ASSERT_TRUE(write_file(folder / "table", "new", owner));
  EXPECT_EQ(read_file(folder / "table").value(), "new");
  const auto refused = write_file(folder / "none/table", "new", owner);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().code, owner.code);
  EXPECT_EQ(refused.error().front().hint, owner.hint);
  EXPECT_EQ(refused.error().front().where.file, folder / "none/table");
  EXPECT_TRUE(refused.error().front().message.ends_with("No such file or directory"));
}

TEST(Files, WhenADeviceIsFull_ThenE0002) {
  const result::Diagnostics refused = write_file("/dev/full", "text");
  ASSERT_EQ(refused.size(), 1u);
  EXPECT_NE(refused[0].message.find("No space"), std::string::npos);
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST(Files, WhenAFileIsReadWithABound_ThenOneByteMoreIsRefused) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "text") << std::string(70'000, 'x');
  EXPECT_EQ(read_file(folder / "text", 70'000).value().size(), 70'000u);
  EXPECT_EQ(read_file(folder / "text", 69'999).error().front().code, "E0001");
  EXPECT_EQ(read_file("/proc/self/cmdline").value().find('\0') != std::string::npos, true);
  const auto reason_of = [](const std::string& path) {
    const result::Diagnostics refused = read_file(path).error();
    EXPECT_EQ(refused.front().code, "E0001");
    return refused.front().message;
  };
  EXPECT_EQ(reason_of(folder / "none"), "cannot read the file: No such file or directory");
  EXPECT_EQ(reason_of(folder.path()), "cannot read the file: Is a directory");
  EXPECT_EQ(reason_of(folder / "text" / "inside"), "cannot read the file: Not a directory");
}

// Neither waits for somebody who writes, nor takes memory without an end.
TEST(Files, WhenAPipeADeviceOrAFileOfGigabytesIsRead_ThenRefusedAtOnce) {
  const support::TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  std::ofstream(folder / "large").put('x');
  fs::resize_file(folder / "large", std::uintmax_t{3} << 30);
  for (const std::string& path :
       {(folder / "pipe").string(), (folder / "large").string(), std::string("/dev/zero")}) {
    const auto refused = read_file(path);
    ASSERT_FALSE(refused) << path;
    EXPECT_EQ(refused.error().front().code, "E0001");
    EXPECT_EQ(refused.error().front().where.file, path);
    EXPECT_FALSE(refused.error().front().hint.empty());
  }
  EXPECT_FALSE(open_file(folder / "pipe"));
  EXPECT_TRUE(open_file(folder / "large"));
}

}  // namespace
}  // namespace stepwright::files
