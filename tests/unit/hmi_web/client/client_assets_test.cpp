#include "hmi_web/client/client_assets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>

namespace stepwright::client {
namespace {

std::string page() {
  for (const auto& asset : client_assets()) {
    if (asset.path == "/") return std::string(asset.body);
  }
  return {};
}

// The document and what it names; panels and languages are fetched when somebody wants them.
TEST(ClientAssets, WhenThePageIsLoadedFirst_ThenAllOfItIsAtMost150KbCompressed) {
  const auto assets = client_assets();
  const auto document =
      std::find_if(assets.begin(), assets.end(), [](const auto& asset) { return asset.path == "/"; });
  ASSERT_NE(document, assets.end());
  std::size_t first = 0;
  std::size_t files = 0;
  for (const auto& asset : assets) {
    if (asset.path != "/" && document->body.find(asset.path) == std::string_view::npos) continue;
    first += asset.gzip.size();
    ++files;
  }
  EXPECT_GE(files, 3U) << "document, script and style sheet";
  EXPECT_LT(files, assets.size());
  EXPECT_LE(first, 150'000U);
}

// By the page, or by a file that it loads: parts of the page come when a cell needs them.
bool is_named(std::string_view path) {
  const std::string_view name = path.substr(path.rfind('/') + 1);
  const auto assets = client_assets();
  return std::any_of(assets.begin(), assets.end(), [&](const auto& other) {
    return other.path != path && other.body.find(name) != std::string_view::npos;
  });
}

TEST(ClientAssets, WhenFilesAreEmbedded_ThenEachIsNamedByAnotherOne) {
  ASSERT_GE(client_assets().size(), 3u);
  for (const auto& asset : client_assets()) {
    if (asset.path != "/") {
      EXPECT_TRUE(is_named(asset.path)) << asset.path;
    }
  }
}

TEST(ClientAssets, WhenThePageNamesFiles_ThenAllOfThemAreEmbedded) {
  const std::string html = page();
  ASSERT_FALSE(html.empty());
  constexpr std::string_view kFolder = "\"/assets/";
  std::size_t named = 0;
  for (auto at = html.find(kFolder); at != std::string::npos; at = html.find(kFolder, at + 1), ++named) {
    const std::string path = html.substr(at + 1, html.find('"', at + 1) - at - 1);
    const auto assets = client_assets();
    EXPECT_TRUE(std::any_of(assets.begin(), assets.end(), [&](const auto& asset) {
      return asset.path == path;
    })) << path;
  }
  EXPECT_GE(named, 2u);
}

TEST(ClientAssets, WhenThePageIsRead_ThenItHasNoInlineScriptAndNoOtherHost) {
  const std::string html = page();

  EXPECT_EQ(html.find("<style"), std::string::npos);
  EXPECT_EQ(html.find("style="), std::string::npos);
  EXPECT_EQ(html.find("://"), std::string::npos);
  for (auto at = html.find("<script"); at != std::string::npos; at = html.find("<script", at + 1)) {
    const std::string tag = html.substr(at, html.find('>', at) - at);
    EXPECT_NE(tag.find("src="), std::string::npos) << tag;
  }
}

TEST(ClientAssets, WhenPathsCarryAHash_ThenCachesMayKeepThem) {
  for (const auto& asset : client_assets()) {
    EXPECT_EQ(asset.immutable, asset.path.substr(0, 8) == "/assets/") << asset.path;
  }
}

}  // namespace
}  // namespace stepwright::client
