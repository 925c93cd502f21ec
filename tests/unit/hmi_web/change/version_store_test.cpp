#include "hmi_web/change/version_store.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "hmi_web/access/secrets.h"
#include "hmi_web/change/version_file.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::change {
namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;
using std::chrono::system_clock;

class VersionStoreTest : public testing::Test {
 protected:
  static std::span<const std::byte> bytes_of(const std::string& text) {
    return std::as_bytes(std::span(text));
  }
  static Version version(const std::string& container, int when_s, Outcome outcome = Outcome::Kept) {
    return {access::sha256_hex(container),
            "main.st",
            "emil",
            "because of \"this\"\nand that",
            std::string(64, 'a'),
            system_clock::time_point(seconds(when_s)),
            outcome,
            ""};
  }
  std::string put(const std::string& container, int when_s, Outcome outcome = Outcome::Kept) {
    const Version fresh = version(container, when_s, outcome);
    EXPECT_TRUE(store_->put(fresh, bytes_of(container)));
    return fresh.digest;
  }
  fs::path file(const std::string& digest) const { return dir_ / (digest + ".version"); }
  std::string container(const std::string& digest) {
    const auto read = store_->container(digest);
    return read ? std::string(reinterpret_cast<const char*>(read->data()), read->size())
                : read.error()[0].code;
  }
  void open_again() {
    store_.reset();
    store_ = *VersionStore::open(dir_);
  }

  support::TemporaryFolder folder_;
  fs::path dir_ = folder_ / "programs";
  std::unique_ptr<VersionStore> store_ = *VersionStore::open(dir_);
};

TEST_F(VersionStoreTest, WhenAVersionIsPut_ThenAnotherServerHasItAndNobodyElse) {
  const std::string program("\0{}\nprogram\xff", 12);
  const std::string digest = put(program, 1'000);
  open_again();
  ASSERT_EQ(store_->list().size(), 1u);
  const Version read = store_->list()[0];
  EXPECT_EQ(read.digest, digest);
  EXPECT_EQ(read.name, "main.st");
  EXPECT_EQ(read.user, "emil");
  EXPECT_EQ(read.reason, "because of \"this\"\nand that");
  EXPECT_EQ(read.replaced, std::string(64, 'a'));
  EXPECT_EQ(read.when, system_clock::time_point(seconds(1'000)));
  EXPECT_EQ(read.outcome, Outcome::Kept);
  EXPECT_EQ(container(digest), program);
  struct stat info {};
  ASSERT_EQ(::stat(file(digest).c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777, 0600u);
  ASSERT_EQ(::stat(dir_.c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777, 0700u);
}

TEST_F(VersionStoreTest, WhenATrialEnds_ThenItsOutcomeIsKept) {
  const std::string digest = put("program", 1, Outcome::Trial);
  ASSERT_TRUE(store_->settle(digest, Outcome::RolledBack, "main.st:3:4: division by zero"));
  open_again();
  EXPECT_EQ(store_->list()[0].outcome, Outcome::RolledBack);
  EXPECT_EQ(store_->list()[0].note, "main.st:3:4: division by zero");
  EXPECT_EQ(container(digest), "program");
}

TEST_F(VersionStoreTest, WhenTheServerEndsDuringATrial_ThenNobodyKnowsItsEnd) {
  put("program", 1, Outcome::Trial);
  open_again();
  EXPECT_EQ(store_->list()[0].outcome, Outcome::Unknown);
  open_again();
  EXPECT_EQ(store_->list()[0].outcome, Outcome::Unknown);
}

TEST_F(VersionStoreTest, WhenThereAreTooMany_ThenTheOldestAreForgottenAndTheTwoThatCountAreNot) {
  const std::string oldest = put("oldest", 0);
  std::string newest;
  for (std::size_t i = 1; i < kMostVersions + 3; ++i)
    newest = put("program " + std::to_string(i), static_cast<int>(i));
  ASSERT_TRUE(store_->trim(newest, oldest));
  const auto list = store_->list();
  ASSERT_EQ(list.size(), kMostVersions);
  EXPECT_EQ(list.front().digest, newest);
  EXPECT_EQ(list.back().digest, oldest);
  EXPECT_FALSE(fs::exists(file(access::sha256_hex("program 1"))));
  open_again();
  EXPECT_EQ(store_->list().size(), kMostVersions);
}

TEST_F(VersionStoreTest, WhenTheyAreTooLarge_ThenTheOldestAreForgotten) {
  const std::string large(kMostContainerBytes, 'x');
  std::string newest;
  for (int i = 0; i < 6; ++i) newest = put(large.substr(1) + static_cast<char>('a' + i), i);
  ASSERT_TRUE(store_->trim(newest, newest));
  EXPECT_EQ(store_->list().size(), kMostVersionBytes / kMostContainerBytes);
}

TEST_F(VersionStoreTest, WhenAFileIsDamaged_ThenItIsToldAndLeftOutAndTheOthersAreThere) {
  const std::string good = put("good", 1);
  const std::string torn = put("a program that is cut", 2);
  const std::string flipped = put("a program with a bit", 3);
  const std::string renamed = put("a program elsewhere", 4);
  fs::resize_file(file(torn), fs::file_size(file(torn)) - 5);
  {
    std::fstream edit(file(flipped), std::ios::in | std::ios::out | std::ios::binary);
    edit.seekp(-1, std::ios::end);
    edit.put('!');
  }
  fs::rename(file(renamed), file(std::string(64, 'b')));
  std::ofstream(file(std::string(64, 'c'))) << "";
  std::ofstream(file(std::string(64, 'd'))) << R"({"format": 1, "digest": 5})"
                                            << "\nx";
  std::ofstream(dir_ / "notes.txt") << "of somebody";
  fs::create_symlink("/dev/zero", file(std::string(64, 'e')));
  open_again();
  ASSERT_EQ(store_->list().size(), 1u);
  EXPECT_EQ(store_->list()[0].digest, good);
  EXPECT_EQ(store_->damaged().size(), 6u);
  for (const auto& each : store_->damaged()) EXPECT_EQ(each.code, "H0095") << each.message;
  EXPECT_EQ(container(torn), "H0091");
}

TEST_F(VersionStoreTest, WhenAFileChangesWhileTheServerRuns_ThenItsBytesAreNotBelieved) {
  const std::string digest = put("program", 1);
  fs::resize_file(file(digest), fs::file_size(file(digest)) - 1);
  EXPECT_EQ(container(digest), "H0095");
  EXPECT_FALSE(store_->settle(digest, Outcome::Kept, ""));
}

TEST_F(VersionStoreTest, WhenADigestIsNone_ThenNoPathIsMadeOfIt) {
  std::ofstream(folder_ / "secret.version") << "x";
  EXPECT_EQ(container("../secret"), "H0091");
  EXPECT_EQ(container(""), "H0091");
  EXPECT_EQ(store_->remove("../secret").error()[0].code, "H0091");
  EXPECT_TRUE(fs::exists(folder_ / "secret.version"));
}

TEST_F(VersionStoreTest, WhenAVersionIsPutAgain_ThenItIsOnceThere) {
  const std::string digest = put("program", 1, Outcome::Found);
  put("other", 2);
  EXPECT_EQ(put("program", 3), digest);
  ASSERT_EQ(store_->list().size(), 2u);
  EXPECT_EQ(store_->list()[0].digest, digest);
  ASSERT_TRUE(store_->remove(digest));
  open_again();
  EXPECT_EQ(store_->list().size(), 1u);
}

TEST_F(VersionStoreTest, WhenEveryByteOfAFileIsCutOff_ThenNoneIsTakenForTheWhole) {
  const std::string container = "a program";
  const std::string whole = to_file(version(container, 5), bytes_of(container));
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_FALSE(from_file(std::string_view(whole).substr(0, length), "cut")) << length;
  EXPECT_TRUE(from_file(whole, "whole"));
}

}  // namespace
}  // namespace stepwright::change
