// Tokens with their places, typed lists and sections, as PDDL and HDDL have them.

#include <gmock/gmock.h>

#include "supervisor/lisp/section_parser.h"
#include "supervisor/lisp/typed_list.h"

namespace stepwright::lisp {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Tokens, WhenATextIsRead_ThenEachHasItsPlace) {
  Reporter reporter({"a.txt"});
  const std::vector<Token> tokens = tokens_of("(Go ?X ; a comment\n  :key -2.5)", 0, reporter);
  ASSERT_EQ(tokens.size(), 7u);
  EXPECT_EQ(tokens[1].text, "go");
  EXPECT_EQ(tokens[2].kind, TokenKind::Variable);
  EXPECT_EQ(tokens[2].text, "?x");
  EXPECT_EQ(tokens[3].kind, TokenKind::Keyword);
  EXPECT_EQ(tokens[3].at.line, 2u);
  EXPECT_EQ(tokens[3].at.column, 3u);
  EXPECT_EQ(tokens[4].number, -2.5);
  EXPECT_EQ(tokens[6].kind, TokenKind::End);
  EXPECT_FALSE(reporter.failed());
}

TEST(Tokens, WhenACharacterIsUnknown_ThenItIsReportedAndLeftOut) {
  Reporter reporter({"a.txt"});
  EXPECT_EQ(tokens_of("a % b", 0, reporter).size(), 3u);
  const auto diagnostics = reporter.take();
  ASSERT_EQ(diagnostics.size(), 1u);
  EXPECT_EQ(diagnostics[0].code, "P0002");
  EXPECT_EQ(diagnostics[0].where.file, "a.txt");
  EXPECT_EQ(diagnostics[0].where.column, 3u);
}

TEST(Reporting, WhenThereAreTooManyErrors_ThenTheRestIsCounted) {
  Reporter reporter({"a.txt"});
  for (std::uint32_t i = 1; i <= 60; ++i) reporter.error("P0003", {i, 1, 0}, "wrong");
  EXPECT_TRUE(reporter.full());
  const auto diagnostics = reporter.take();
  ASSERT_EQ(diagnostics.size(), Reporter::kMost + 1);
  EXPECT_EQ(diagnostics.back().code, "P0010");
  EXPECT_THAT(diagnostics.back().message, HasSubstr("10 more"));
}

TEST(Streams, WhenParenthesesAreNestedTooDeeply_ThenThatIsReported) {
  Reporter reporter({"a.txt"});
  TokenStream tokens(tokens_of(std::string(1300, '('), 0, reporter), reporter);
  int depth = 0;
  for (; !tokens.too_deep(); ++depth) tokens.take();
  EXPECT_EQ(depth, 1200);
  EXPECT_EQ(reporter.take().front().code, "P0006");
}

TEST(TypedLists, WhenTypesFollowTheirNames_ThenAllBeforeThemHaveThem) {
  Reporter reporter({"a.txt"});
  TokenStream tokens(tokens_of("a b - t c - (either u v) d)", 0, reporter), reporter);
  std::vector<TypedName> list;
  ASSERT_TRUE(read_typed_list(tokens, TokenKind::Name, list));
  ASSERT_EQ(list.size(), 4u);
  EXPECT_EQ(list[0].type_name, "t");
  EXPECT_EQ(list[1].type_name, "t");
  EXPECT_THAT(list[2].either, ElementsAre("u", "v"));
  EXPECT_EQ(list[2].type_name, "(either u v)");
  EXPECT_EQ(list[3].type_name, "object");
  EXPECT_EQ(list[0].type_at.column, 7u);
}

// Sections that only say how they are called.
class Sections : private SectionParser {
 public:
  Sections(const std::string& text, Reporter& reporter)
      : SectionParser(tokens_of(text, 0, reporter), reporter) {}

  std::vector<std::string> run() {
    std::vector<std::string> found;
    if (!define("domain", name_, at_)) return found;
    sections([&](const std::string& keyword, Place at) {
      if (keyword != ":a" && keyword != ":b") return unknown(keyword, at, {":a", ":b"});
      found.push_back(keyword);
      return once(keyword, at);
    });
    return found;
  }

 private:
  std::string name_;
  Place at_;
};

TEST(Sections, WhenOneIsWrong_ThenTheOthersAreRead) {
  Reporter reporter({"a.txt"});
  EXPECT_THAT(Sections("(define (domain d) (:a) (:c (x)) (:b) (:a))", reporter).run(),
              ElementsAre(":a", ":b", ":a"));
  const auto diagnostics = reporter.take();
  ASSERT_EQ(diagnostics.size(), 2u);
  EXPECT_EQ(diagnostics[0].code, "P0008");
  EXPECT_EQ(diagnostics[1].code, "P0007");
}

}  // namespace
}  // namespace stepwright::lisp
