#include "hmi_web/client/client_assets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace stepwright::client {
namespace {

std::string page() {
  for (const auto& asset : client_assets()) {
    if (asset.path == "/") return std::string(asset.body);
  }
  return {};
}

TEST(ClientAssets, WhenThePageIsLoadedFirst_ThenAllOfItIsAtMost150KbCompressed) {
  std::size_t total = 0;
  for (const auto& asset : client_assets()) total += asset.gzip.size();

  EXPECT_GT(total, 0u);
  EXPECT_LE(total, 150'000u);
}

TEST(ClientAssets, WhenThePageNamesFiles_ThenAllOfThemAreEmbedded) {
  const std::string html = page();
  ASSERT_FALSE(html.empty());
  const auto assets = client_assets();
  const auto named = std::count_if(assets.begin(), assets.end(), [&](const auto& asset) {
    return asset.path != "/" && html.find("\"" + std::string(asset.path) + "\"") != std::string::npos;
  });

  EXPECT_EQ(static_cast<std::size_t>(named) + 1, assets.size());
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
