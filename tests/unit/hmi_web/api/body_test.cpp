#include "hmi_web/api/body.h"

#include <gtest/gtest.h>

namespace stepwright::api {
namespace {

const Shape kShape{"Test",
                   {{.name = "name", .least = 1, .most = 8, .description = "a name"},
                    {.name = "amount", .kind = Kind::Number, .required = false, .least = 1, .most = 10},
                    {.name = "on", .kind = Kind::Boolean, .required = false},
                    {.name = "colour", .required = false, .choices = {"red", "grey"}},
                    {.name = "corners", .kind = Kind::Points, .required = false, .least = 1, .most = 3},
                    {.name = "values", .kind = Kind::Texts, .required = false, .least = 1, .most = 2}}};

// "H0031 2:3", or "ok".
std::string fault(const std::string& text) {
  const auto body = read_body(text, kShape);
  if (body) return "ok";
  const auto& problem = body.error().front();
  EXPECT_EQ(problem.where.file, "body");
  return problem.code + " " + std::to_string(problem.where.line) + ":" + std::to_string(problem.where.column);
}

TEST(Body, WhenItIsRight_ThenItsMembersAreThere) {
  const auto body = read_body(
      R"({"name": "a\u00e4", "amount": 2.5, "on": true, "colour": "red", "corners": [[1, 2], [3.5, -4]]})",
      kShape);
  ASSERT_TRUE(body) << result::to_string(body.error());
  EXPECT_EQ(body->text("name"), "a\xc3\xa4");
  EXPECT_EQ(body->number("amount"), 2.5);
  EXPECT_TRUE(body->boolean("on"));
  ASSERT_EQ(body->points("corners").size(), 2u);
  EXPECT_EQ(body->points("corners")[1].y, -4);
}

TEST(Body, WhenANumberIsToBeWhole_ThenAPartOfOneIsRefused) {
  const Shape shape{"Test", {{.name = "version", .kind = Kind::Number, .most = 9, .whole = true}}};
  EXPECT_TRUE(read_body(R"({"version": 2})", shape));
  EXPECT_TRUE(read_body(R"({"version": 2.0})", shape));
  const auto part = read_body(R"({"version": 1.5})", shape);
  ASSERT_FALSE(part);
  EXPECT_EQ(part.error()[0].code, "H0033");
  EXPECT_EQ(part.error()[0].message, "'version' is no whole number");
}

TEST(Body, WhenItHasAnObjectOfTexts_ThenItsMembersAreThere) {
  const auto body = read_body(R"({"values": {"a.b": "1", "%QX0.1": ""}, "name": "a"})", kShape);
  ASSERT_TRUE(body) << result::to_string(body.error());
  EXPECT_EQ(body->texts("values"), (Body::Texts{{"%QX0.1", ""}, {"a.b", "1"}}));
  EXPECT_EQ(body->text("name"), "a");
  EXPECT_TRUE(body->texts("name").empty());
}

TEST(Body, WhenItHasAListOfTexts_ThenTheyAreThereInTheirOrder) {
  const Shape shape{"List", {{.name = "names", .kind = Kind::List, .least = 1, .most = 3, .longest = 4}}};
  const auto body = read_body(R"({"names": ["b", "a", ""]})", shape);
  ASSERT_TRUE(body);
  EXPECT_EQ(body->list("names"), (Body::List{"b", "a", ""}));
  EXPECT_TRUE(body->list("other").empty());
  for (const char* wrong : {R"({"names": []})", R"({"names": ["a","b","c","d"]})", R"({"names": ["abcde"]})",
                            R"({"names": [1]})", R"({"names": [["a"]]})", R"({"names": [{"a": "b"}]})",
                            R"({"names": "a"})", R"({"names": [null]})", R"({"names": [true]})"}) {
    const auto refused = read_body(wrong, shape);
    ASSERT_FALSE(refused) << wrong;
    EXPECT_EQ(refused.error().front().code, "H0033") << wrong;
  }
}

TEST(Body, WhenAnObjectOfTextsHoldsAnythingElse_ThenItIsRefused) {
  const auto code = [](const std::string& values) {
    return fault(R"({"name": "a", "values": )" + values + "}").substr(0, 5);
  };
  for (const std::string values :
       {"{}", "[]", "\"x\"", "1", "null", "{\"a\": 1}", "{\"a\": 1.5}", "{\"a\": true}", "{\"a\": null}",
        "{\"a\": {}}", "{\"a\": {\"b\": \"c\"}}", "{\"a\": [\"b\"]}", "{\"\": \"1\"}",
        "{\"a\": \"1\", \"b\": \"1\", \"c\": \"1\"}"})
    EXPECT_EQ(code(values), "H0033") << values;
  EXPECT_EQ(code("{\"a\": \"1\", \"a\": \"2\"}"), "H0031");
  EXPECT_EQ(code("{\"a\": \"" + std::string(kLongestText + 1, 'x') + "\"}"), "H0033");
  EXPECT_EQ(code("{\"" + std::string(kLongestKey + 1, 'x') + "\": \"1\"}"), "H0033");
  EXPECT_EQ(fault(R"({"corners": {"a": "1"}})").substr(0, 5), "H0033") << "where a list is wanted";
}

TEST(Body, WhenMembersAreLeftOut_ThenTheyHaveTheirDefaults) {
  const auto body = read_body(R"({"name": "a"})", kShape);
  ASSERT_TRUE(body);
  EXPECT_EQ(body->number("amount", 7), 7);
  EXPECT_FALSE(body->boolean("on"));
  EXPECT_EQ(body->text("colour"), "");
  EXPECT_FALSE(body->has("corners"));
}

TEST(Body, WhenItIsNoObject_ThenItIsRefused) {
  for (const char* text :
       {"", " ", "1", "\"x\"", "null", "[]", "[{}]", "{", "{\"name\": \"a\"", "{\"name\" \"a\"}",
        "{\"name\": \"a\"} x", "{\"name\": \"\xff\"}", "{name: 1}", "{\"name\": \"a\",}"}) {
    EXPECT_EQ(fault(text).substr(0, 5), "H0030") << text;
  }
}

TEST(Body, WhenSomethingIsWrong_ThenItsPlaceIsTold) {
  EXPECT_EQ(fault("{\n  \"nmae\": \"a\"}"), "H0031 2:8");
  EXPECT_EQ(fault("{\"name\": \"a\",\n\"name\": \"b\"}"), "H0031 2:6");
  EXPECT_EQ(fault("{\"amount\": 2}"), "H0032 1:13");
  EXPECT_EQ(fault("{\"name\": 5}"), "H0033 1:11");
  EXPECT_EQ(fault("{\"name\": \"\"}"), "H0033 1:11");
  EXPECT_EQ(fault("{\"name\": \"123456789\"}").substr(0, 5), "H0033");
  EXPECT_EQ(fault("{\"name\": \"a\", \"amount\": 11}").substr(0, 5), "H0033");
  EXPECT_EQ(fault("{\"name\": \"a\", \"amount\": 1e999}").substr(0, 3), "H00");
  EXPECT_EQ(fault("{\"name\": \"a\", \"amount\": \"1\"}").substr(0, 5), "H0033");
  EXPECT_EQ(fault("{\"name\": null}").substr(0, 5), "H0033");
  EXPECT_EQ(fault("{\"name\": \"a\", \"colour\": \"blue\"}").substr(0, 5), "H0033");
  EXPECT_EQ(fault("{\"name\": \"a\", \"on\": 1}").substr(0, 5), "H0033");
}

TEST(Body, WhenListsAreWrong_ThenTheyAreRefused) {
  for (const char* list : {"[]", "[1]", "[[1]]", "[[1,2,3]]", "[[1,\"2\"]]", "[[1,[2]]]", "[[1,{}]]", "[{}]",
                           "{}", "[true]", "[[1,null]]", "[[1,2],[1,2],[1,2],[1,2]]"}) {
    EXPECT_EQ(fault(R"({"name": "a", "corners": )" + std::string(list) + "}").substr(0, 5), "H0033") << list;
  }
  EXPECT_EQ(fault(R"({"name": [[1, 2]]})").substr(0, 5), "H0033");
}

TEST(Body, WhenItIsNestedDeeply_ThenItIsRefusedAtOnce) {
  const std::string deep(8'000, '[');
  EXPECT_EQ(fault(deep).substr(0, 5), "H0030");
  EXPECT_EQ(fault(R"({"corners": )" + deep).substr(0, 5), "H0033");
  std::string objects;
  for (int i = 0; i < 2'000; ++i) objects += R"({"name":)";
  EXPECT_EQ(fault(objects).substr(0, 5), "H0033");
}

TEST(Body, WhenAMemberIsMisspelt_ThenTheHintNamesTheRightOne) {
  const auto body = read_body(R"({"nane": "a"})", kShape);
  ASSERT_FALSE(body);
  EXPECT_EQ(body.error().front().hint, "did you mean 'name'?");
}

// Whatever comes: an answer, never a crash, and only what the shape allows.
TEST(Body, WhenBytesAreMutated_ThenNothingElseGetsIn) {
  const std::string seed = R"({"name": "abc", "amount": 2, "on": true, "corners": [[1, 2], [3, 4]]})";
  std::uint32_t state = 12345;
  const auto random = [&](std::size_t below) {
    state = state * 1664525u + 1013904223u;
    return static_cast<std::size_t>(state >> 8) % below;
  };
  constexpr std::string_view kBytes = "{}[]\",:0123e-.\\ntfu\x01\xff ";
  for (int i = 0; i < 20'000; ++i) {
    std::string text = seed;
    for (std::size_t edits = random(4) + 1; edits > 0; --edits)
      text[random(text.size())] = kBytes[random(kBytes.size())];
    const auto body = read_body(text, kShape);
    if (!body) continue;
    EXPECT_TRUE(body->text("name").size() >= 1 && body->text("name").size() <= 8) << text;
    EXPECT_LE(body->points("corners").size(), 3u) << text;
  }
}

}  // namespace
}  // namespace stepwright::api
