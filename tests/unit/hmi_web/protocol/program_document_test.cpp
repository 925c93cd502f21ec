#include "hmi_web/protocol/program_document.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>
#include <string>

namespace stepwright::protocol {
namespace {

using nlohmann::json;

const std::string kDocument =
    R"({"version":1,"sheets":[{"name":"main","kind":"PROGRAM","blocks":[{"kind":"text","first":1,"lines":["x := 1;"]}]}]})";

json sources(std::string_view document) {
  return json::parse(program_sources({"abc", {{"main", "main"}, {"main.t", "TON"}}, document}));
}

TEST(ProgramDocument, WhenItIsWhole_ThenItIsHandedOnWithTheInstances) {
  const json answer = sources(kDocument);
  EXPECT_EQ(answer["digest"], "abc");
  EXPECT_EQ(answer["state"], "complete");
  EXPECT_EQ(answer["document"], json::parse(kDocument));
  EXPECT_EQ(answer["instances"][1], json({{"path", "main.t"}, {"pou", "TON"}}));
}

TEST(ProgramDocument, WhenThereIsNoneOrAnotherVersion_ThenTheAnswerSaysSo) {
  EXPECT_EQ(sources("")["state"], "absent");
  for (const char* wrong :
       {"x", "[]", "{}", "null", R"({"version":2,"sheets":[]})", R"({"version":1})",
        R"({"version":1,"sheets":{}})", "{\"version\":1,\"sheets\":[\"\xff\"]}", R"({"version":1,)"}) {
    EXPECT_EQ(sources(wrong)["state"], "damaged") << wrong;
    EXPECT_TRUE(sources(wrong)["document"].is_null());
  }
}

TEST(ProgramDocument, WhenItIsNestedWithoutEnd_ThenWhatIsTooDeepIsLeftOut) {
  const std::string deep(1'000'000, '[');
  EXPECT_EQ(sources(R"({"version":1,"sheets":)" + deep)["state"], "damaged");
  const std::string closed =
      R"({"version":1,"sheets":)" + std::string(100'000, '[') + std::string(100'000, ']') + "}";
  const json answer = sources(closed);
  EXPECT_EQ(answer["state"], "complete");
  EXPECT_LT(answer["document"].dump().size(), 300u);
}

// Thousands of broken documents: each gives an answer that can be read.
TEST(ProgramDocument, WhenBytesAreChanged_ThenTheAnswerIsStillJson) {
  std::mt19937 random(8);
  for (int round = 0; round < 5'000; ++round) {
    std::string broken = kDocument;
    for (unsigned change = 0; change < 1 + random() % 4; ++change) {
      const std::size_t at = random() % broken.size();
      if (random() % 3 == 0)
        broken.erase(at, random() % 9);
      else
        broken[at] = static_cast<char>(random() % 256);
      if (broken.empty()) broken = "{";
    }
    ASSERT_TRUE(json::accept(program_sources({"abc", {}, broken}))) << broken;
  }
}

}  // namespace
}  // namespace stepwright::protocol
