#include "hmi_web/protocol/pictures.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace stepwright::protocol {
namespace {

using nlohmann::json;

TEST(Pictures, WhenADocumentHasSome_ThenTheyAreAMessage) {
  const auto message = pictures_message(
      R"({"pictures":[{"kind":"floor","id":"hall","border_m":[[0,0],[4,0],[4,3]]}],"more":1})");

  ASSERT_TRUE(message.has_value());
  EXPECT_EQ(
      json::parse(*message),
      json::parse(
          R"({"type":"pictures","pictures":[{"kind":"floor","id":"hall","border_m":[[0,0],[4,0],[4,3]]}]})"));
}

TEST(Pictures, WhenOneHasNoNameOrIsNone_ThenItIsLeftOut) {
  const std::string longer(65, 'x');
  const auto message = pictures_message(
      R"({"pictures":[7,null,[],{"kind":"floor"},{"kind":"floor","id":3},{"kind":"","id":"a"},
                          {"kind":"automaton","id":"task"},{"kind":"floor","id":")" +
      longer + R"("}]})");

  ASSERT_TRUE(message.has_value());
  EXPECT_EQ(json::parse(*message)["pictures"], json::parse(R"([{"kind":"automaton","id":"task"}])"));
}

TEST(Pictures, WhenThereAreMoreThanAPageShows_ThenTheFirstOnes) {
  json many = {{"pictures", json::array()}};
  for (std::size_t i = 0; i < kMostPictures + 3; ++i)
    many["pictures"].push_back({{"kind", "floor"}, {"id", std::to_string(i)}});
  EXPECT_EQ(json::parse(*pictures_message(many.dump()))["pictures"].size(), kMostPictures);
}

TEST(Pictures, WhenTheDocumentIsNone_ThenThereIsNoMessage) {
  for (const std::string& text :
       {std::string("{ broken"), std::string("[]"), std::string("{}"), std::string(R"({"pictures":{}})"),
        std::string("{\"pictures\":[],\"x\":\"\xff\"}"),
        R"({"pictures":[],"x":")" + std::string(kMostPicturesBytes, 'x') + "\"}"})
    EXPECT_EQ(pictures_message(text), std::nullopt) << text.substr(0, 60);
  EXPECT_TRUE(pictures_message(R"({"pictures":[]})")) << "none are shown any more";
}

TEST(Pictures, WhenOneIsNestedDeeperThanAny_ThenThatPartIsLeftOut) {
  const std::string deep = R"({"pictures":[{"kind":"floor","id":"a","way":[1],"x":)" + std::string(400, '[') +
                           std::string(400, ']') + "}]}";
  const auto message = pictures_message(deep);
  ASSERT_TRUE(message.has_value());
  EXPECT_LT(message->size(), 200u);
  EXPECT_EQ(json::parse(*message)["pictures"][0]["way"], json::parse("[1]"));
}

}  // namespace
}  // namespace stepwright::protocol
