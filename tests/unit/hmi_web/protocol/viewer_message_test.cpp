#include "hmi_web/protocol/viewer_message.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace stepwright::protocol {
namespace {

const std::string kBegin =
    R"({"type":"begin","protocol":5,"epoch":"e1","has":{"seq":12,"tags":true,"program":1,"plan":2,"routes":3,)"
    R"("pictures":8,"alarms":4,"forces":5,"trend_run":6,"trend_next":700},)"
    R"("show":{"number":3,"digest":"ab","tags":[[0,4],[9,1]],"also":["plan","pictures","trend"]}})";

TEST(ViewerMessage, WhenAPageBegins_ThenWhatItHasAndWantsIsRead) {
  const auto message = read_viewer_message(kBegin);

  ASSERT_TRUE(message) << message.error();
  EXPECT_TRUE(message->begins);
  EXPECT_EQ(message->protocol, 5);
  EXPECT_EQ(message->epoch, "e1");
  EXPECT_EQ(message->has.sequence, 12u);
  EXPECT_TRUE(message->has.tags);
  EXPECT_EQ(message->has.pictures, 8u);
  EXPECT_EQ(message->has.forces, 5u);
  EXPECT_EQ(message->has.trend_next, 700u);
  EXPECT_EQ(message->show.number, 3u);
  EXPECT_EQ(message->show.tags, (TagChoice{false, "ab", {{0, 4}, {9, 1}}}));
  EXPECT_TRUE(message->show.plan);
  EXPECT_TRUE(message->show.pictures);
  EXPECT_TRUE(message->show.trend);
  EXPECT_FALSE(message->show.routes);
}

TEST(ViewerMessage, WhenAPageHasNothing_ThenALittleIsEnough) {
  const auto message = read_viewer_message(R"({"type":"show","number":1,"tags":"all"})");

  ASSERT_TRUE(message) << message.error();
  EXPECT_FALSE(message->begins);
  EXPECT_EQ(message->show.tags, TagChoice::everything());
}

TEST(ViewerMessage, WhenItIsNotAsWritten_ThenItIsRefusedWithAReasonThatFitsAClose) {
  const std::string many = [] {
    std::string ranges;
    for (int i = 0; i <= static_cast<int>(kMostTagRanges); ++i)
      ranges += (i ? ",[" : "[") + std::to_string(2 * i) + ",1]";
    return R"({"type":"show","number":1,"tags":[)" + ranges + "]}";
  }();
  const std::vector<std::string> wrong = {
      "",
      "hello",
      "null",
      "[]",
      "{}",
      R"({"type":7})",
      R"({"type":"write","number":1})",
      R"({"type":"show"})",
      R"({"type":"show","number":0})",
      R"({"type":"show","number":-1})",
      R"({"type":"show","number":1.5})",
      R"({"type":"show","number":3000000000})",
      R"({"type":"show","number":99999999999999999999999})",
      R"({"type":"show","number":"1"})",
      R"({"type":"show","number":1,"more":1})",
      R"({"type":"show","number":1,"tags":"some"})",
      R"({"type":"show","number":1,"tags":{}})",
      R"({"type":"show","number":1,"tags":[1,2]})",
      R"({"type":"show","number":1,"tags":[[1]]})",
      R"({"type":"show","number":1,"tags":[[1,0]]})",
      R"({"type":"show","number":1,"tags":[[-1,2]]})",
      R"({"type":"show","number":1,"tags":[[1,2,3]]})",
      R"({"type":"show","number":1,"tags":[[5,2],[1,1]]})",
      R"({"type":"show","number":1,"tags":[[0,2],[2,1]]})",
      R"({"type":"show","number":1,"tags":[[4294967295,1]]})",
      R"({"type":"show","number":1,"tags":[[1,18446744073709551615]]})",
      R"({"type":"show","number":1,"also":"plan"})",
      R"({"type":"show","number":1,"also":["plan","plan"]})",
      R"({"type":"show","number":1,"also":["secrets"]})",
      R"({"type":"show","number":1,"also":[1]})",
      R"({"type":"begin","protocol":5})",
      R"({"type":"begin","protocol":5,"show":[]})",
      R"({"type":"begin","protocol":5,"has":7,"show":{"number":1}})",
      R"({"type":"begin","protocol":5,"has":{"seq":-3},"show":{"number":1}})",
      R"({"type":"begin","protocol":5,"has":{"tags":1},"show":{"number":1}})",
      R"({"type":"begin","protocol":5,"has":{"rows":1},"show":{"number":1}})",
      R"({"type":"show","number":1} x)",
      R"({"type":"show","number":1,"digest":")" + std::string(65, 'a') + "\"}",
      many,
      std::string(4'000, '['),
      kBegin + std::string(kMostViewerBytes, ' '),
  };
  for (const std::string& text : wrong) {
    const auto message = read_viewer_message(text);
    ASSERT_FALSE(message) << text.substr(0, 120);
    EXPECT_FALSE(message.error().empty());
    EXPECT_LE(message.error().size(), 120u) << message.error();
  }
}

// Bytes changed, cut, doubled: whatever comes out is read or refused, and what is read keeps its bounds.
TEST(ViewerMessage, WhenBytesAreChangedAtRandom_ThenItIsReadWithinItsBoundsOrRefused) {
  std::mt19937 random(7);
  const auto below = [&](std::size_t end) {
    return std::uniform_int_distribution<std::size_t>(0, end - 1)(random);
  };
  const std::string_view alphabet = "{}[]\",:0123456789-.eEaltrufnsh\\ \xff\x00";
  std::size_t read = 0;
  for (int turn = 0; turn < 20'000; ++turn) {
    std::string text = kBegin;
    for (std::size_t edits = 1 + below(3); edits > 0 && !text.empty(); --edits) {
      const std::size_t at = below(text.size());
      const std::size_t kind = below(4);
      if (kind == 0) text[at] = alphabet[below(alphabet.size())];
      if (kind == 1) text.erase(at, 1 + below(4));
      if (kind == 2) text.insert(at, 1, alphabet[below(alphabet.size())]);
      if (kind == 3) text.insert(at, text.substr(below(text.size()), below(12)));
    }
    const auto message = read_viewer_message(text);
    if (!message) {
      EXPECT_LE(message.error().size(), 120u);
      continue;
    }
    ++read;
    EXPECT_GE(message->show.number, 1u);
    std::uint64_t free = 0;
    for (const TagRange& range : message->show.tags.ranges) {
      EXPECT_GE(range.first, free);
      EXPECT_GE(range.count, 1u);
      free = std::uint64_t{range.first} + range.count + 1;
    }
  }
  EXPECT_GT(read, 100u);
  EXPECT_LT(read, 19'000u);
}

}  // namespace
}  // namespace stepwright::protocol
