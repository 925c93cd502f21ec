#include "plant_models/fmu/zip_archive.h"

#include <gtest/gtest.h>

#include "tests/unit/plant_models/fmu/made_archive.h"

namespace stepwright::fmu {
namespace {

std::string refusal(const std::filesystem::path& file, const UnpackLimits& limits = {}) {
  auto archive = ZipArchive::open(file, limits);
  if (!archive) return archive.error().front().message;
  const TemporaryFolder folder;
  auto unpacked = archive->unpack(folder.path());
  return unpacked ? "none" : unpacked.error().front().message;
}

TEST(ZipArchive, WhenItIsSound_ThenItsFilesAreReadAndUnpacked) {
  const TemporaryFolder folder;
  make_archive(folder / "a.zip",
               {{"top.txt", "one"}, {"deep/er/file", std::string(100'000, 'x')}, {"empty/", ""}});
  auto archive = ZipArchive::open(folder / "a.zip").value();
  EXPECT_TRUE(archive.has("deep/er/file"));
  EXPECT_EQ(archive.read("top.txt", 10).value(), "one");
  std::filesystem::create_directory(folder / "out");
  ASSERT_TRUE(archive.unpack(folder / "out"));
  EXPECT_EQ(bytes_of(folder / "out/deep/er/file").size(), 100'000u);
  EXPECT_TRUE(std::filesystem::is_directory(folder / "out/empty"));
}

TEST(ZipArchive, WhenANameLeadsOutOfTheFolder_ThenTheArchiveIsRefused) {
  const TemporaryFolder folder;
  for (const char* name :
       {"../evil", "a/../../evil", "/etc/evil", "a\\..\\evil", "C:evil", "./a", "a//b", "a\x01"}) {
    make_archive(folder / "a.zip", {{"good", "1"}, {name, "2"}});
    EXPECT_NE(refusal(folder / "a.zip").find("out of its folder"), std::string::npos) << name;
    EXPECT_FALSE(is_safe_name(name));
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "evil"));
  EXPECT_TRUE(is_safe_name("a..b/c.d/"));
  EXPECT_FALSE(is_safe_name(""));
}

TEST(ZipArchive, WhenAFileInItIsALink_ThenTheArchiveIsRefusedWithItsName) {
  const TemporaryFolder folder;
  make_archive(folder / "a.zip", {{"resources", "/tmp"}}, 0120777);
  EXPECT_EQ(refusal(folder / "a.zip"), "'resources' in it is a symbolic link");
}

TEST(ZipArchive, WhenItIsLargerThanAllowed_ThenNothingBeyondTheLimitIsWritten) {
  const TemporaryFolder folder;
  make_archive(folder / "a.zip",
               {{"zeros", std::string(10'000'000, '\0')}, {"more", std::string(1'000, 'x')}});
  EXPECT_LT(std::filesystem::file_size(folder / "a.zip"), 100'000u);
  EXPECT_NE(refusal(folder / "a.zip", {.file_bytes = 1'000'000}).find("more than 1000000 bytes"),
            std::string::npos);
  EXPECT_NE(refusal(folder / "a.zip", {.bytes = 10'000'500}).find("'more' has more than 500"),
            std::string::npos);
  EXPECT_NE(refusal(folder / "a.zip", {.files = 1}).find("more than 1 files"), std::string::npos);
  EXPECT_NE(refusal(folder / "a.zip", {.name_bytes = 3}).find("too long"), std::string::npos);
  auto archive = ZipArchive::open(folder / "a.zip").value();
  EXPECT_FALSE(archive.read("zeros", 1'000));
}

TEST(ZipArchive, WhenItHasAsManyFilesAsAllowed_ThenAllAreUnpacked) {
  const TemporaryFolder folder;
  Entries entries;
  for (std::size_t i = 0; i < UnpackLimits{}.files; ++i)
    entries.push_back({"resources/" + std::to_string(i), std::to_string(i)});
  make_archive(folder / "a.zip", entries);
  std::filesystem::create_directory(folder / "out");
  auto archive = ZipArchive::open(folder / "a.zip").value();
  ASSERT_TRUE(archive.unpack(folder / "out"));
  EXPECT_EQ(bytes_of(folder / "out/resources/0"), "0");
  EXPECT_EQ(bytes_of(folder / "out/resources/9999"), "9999");
  EXPECT_EQ(archive.read("resources/1234", 10).value(), "1234");
  entries.push_back({"resources/more", ""});
  make_archive(folder / "b.zip", entries);
  EXPECT_NE(refusal(folder / "b.zip").find("more than 10000 files"), std::string::npos);
}

// A file where another one has its folder.
TEST(ZipArchive, WhenAFileIsAlsoAFolder_ThenItIsRefused) {
  const TemporaryFolder folder;
  make_archive(folder / "a.zip", {{"binaries", "text"}, {"binaries/linux64/x.so", "code"}});
  std::filesystem::create_directory(folder / "out");
  auto archive = ZipArchive::open(folder / "a.zip").value();
  EXPECT_FALSE(archive.unpack(folder / "out"));
}

TEST(ZipArchive, WhenItIsNoArchive_ThenItSaysSo) {
  const TemporaryFolder folder;
  EXPECT_NE(refusal(folder / "missing.zip").find("no such file"), std::string::npos);
  std::ofstream(folder / "text.zip") << "no archive";
  EXPECT_NE(refusal(folder / "text.zip").find("no ZIP archive"), std::string::npos);
  make_archive(folder / "twice.zip", {{"a", "1"}, {"a", "2"}});
  EXPECT_NE(refusal(folder / "twice.zip").find("twice"), std::string::npos);
}

// Every cut and many changes of bytes: an answer, whatever it is, and nothing outside of the folder.
TEST(ZipArchive, WhenItsBytesAreDamaged_ThenItIsReadOrRefused) {
  const TemporaryFolder folder;
  make_archive(folder / "a.zip", {{"one", std::string(500, 'a')}, {"two/three", "text"}});
  const std::string whole = bytes_of(folder / "a.zip");
  int refused = 0;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 0x55);
    std::ofstream(folder / "b.zip", std::ios::binary) << changed;
    refused += refusal(folder / "b.zip") == "none" ? 0 : 1;
    if (at + 22 >= whole.size()) continue;  // of the list's end one byte may be missing
    std::ofstream(folder / "b.zip", std::ios::binary) << whole.substr(0, at);
    EXPECT_NE(refusal(folder / "b.zip"), "none") << at;
  }
  EXPECT_GT(refused, 0);
  int there = 0;
  for ([[maybe_unused]] const auto& each : std::filesystem::directory_iterator(folder.path())) ++there;
  EXPECT_EQ(there, 2);
}

}  // namespace
}  // namespace stepwright::fmu
