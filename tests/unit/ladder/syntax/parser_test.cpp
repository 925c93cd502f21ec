#include "ladder/syntax/parser.h"

#include <gtest/gtest.h>

namespace {

using namespace stepwright;
using syntax::Expression;
using syntax::ExpressionKind;

struct Parsed {
  source::SourceSet sources;
  source::NameTable names;
  syntax::Statements statements;
  result::Diagnostics diagnostics;
};

std::unique_ptr<Parsed> parse(const std::string& text, syntax::TextKind kind = syntax::TextKind::Written) {
  auto parsed = std::make_unique<Parsed>();
  syntax::intern_keywords(parsed->names);
  source::DiagnosticSink sink(parsed->sources);
  syntax::SyntaxContext context{parsed->sources, parsed->names, sink};
  parsed->statements = syntax::parse_statements(context, parsed->sources.add("t.st", text), kind);
  parsed->diagnostics = sink.take();
  return parsed;
}

// Fully parenthesised.
std::string shown(const Expression& expression) {
  switch (expression.kind) {
    case ExpressionKind::Variable:
      return std::string(expression.name.text);
    case ExpressionKind::Integer:
      return std::to_string(expression.integer);
    case ExpressionKind::Unary:
      return "(" + std::string(to_string(expression.op)) + " " + shown(*expression.operands[0]) + ")";
    case ExpressionKind::Binary: {
      std::string text = "(" + shown(*expression.operands[0]);
      for (std::size_t i = 1; i < expression.operands.size(); ++i)
        text += " " + std::string(to_string(expression.op)) + " " + shown(*expression.operands[i]);
      return text + ")";
    }
    default:
      return "?";
  }
}

std::string tree(const std::string& text) {
  const auto parsed = parse("x := " + text + ";");
  EXPECT_TRUE(parsed->diagnostics.empty()) << to_string(parsed->diagnostics);
  return shown(*parsed->statements.at(0)->value);
}

TEST(Parser, Precedence_WhenMixed_ThenIsThatOfTheStandard) {
  EXPECT_EQ(tree("a OR b AND NOT c XOR d"), "(a OR ((b AND (NOT c)) XOR d))");
  EXPECT_EQ(tree("1 + 2 * 3 - 4 MOD 5"), "((1 + (2 * 3)) - (4 MOD 5))");
  EXPECT_EQ(tree("a = b < c"), "(a = (b < c))");
  EXPECT_EQ(tree("-a ** 2"), "((- a) ** 2)");
  EXPECT_EQ(tree("a & b OR c > 1"), "((a AND b) OR (c > 1))");
}

TEST(Parser, Chain_WhenOneOperatorRepeats_ThenIsFlat) {
  EXPECT_EQ(tree("a + b + c"), "(a + b + c)");
  EXPECT_EQ(tree("(a + b) + c"), "((a + b) + c)");
  EXPECT_EQ(tree("a - b + c - d"), "(((a - b) + c) - d)");
}

TEST(Parser, Depth_WhenNestedBeyondReason_ThenOneReportAndNoCrash) {
  for (const std::string& text :
       {"x := " + std::string(100000, '(') + "1;", "x := " + std::string(100000, '-') + "1;",
        [] {
          std::string chain = "x := 1";
          for (int i = 0; i < 100000; ++i) chain += i % 2 == 0 ? " + 1" : " - 1";
          return chain + ";";
        }(),
        [] {
          std::string ifs;
          for (int i = 0; i < 20000; ++i) ifs += "IF a THEN ";
          return ifs;
        }(),
        [] {
          std::string path = "x := a";
          for (int i = 0; i < 100000; ++i) path += ".b";
          return path + ";";
        }()}) {
    const auto parsed = parse(text);
    ASSERT_FALSE(parsed->diagnostics.empty());
    EXPECT_EQ(parsed->diagnostics[0].code, "E0106") << to_string(parsed->diagnostics[0]);
  }
}

TEST(Parser, Chain_WhenVeryLong_ThenIsRead) {
  std::string text = "x := a";
  for (int i = 0; i < 100000; ++i) text += " OR a";
  EXPECT_TRUE(parse(text + ";")->diagnostics.empty());
}

TEST(Parser, Recovery_WhenStatementsAreBroken_ThenTheOthersAreKept) {
  const auto parsed = parse("a := 1;\nb := * 2;\nc := 3;\nIF d THEN e := ; f := 1; END_IF;\ng := 5;");
  EXPECT_EQ(parsed->diagnostics.size(), 2u) << to_string(parsed->diagnostics);
  EXPECT_EQ(parsed->statements.size(), 5u);
}

TEST(Parser, Jump_WhenTheTextIsWritten_ThenIsNoStatement) {
  EXPECT_FALSE(parse("JMP over;")->diagnostics.empty());
  const auto parsed = parse("JMP over; x := 1; over: y := 2;", syntax::TextKind::Generated);
  EXPECT_TRUE(parsed->diagnostics.empty());
  ASSERT_EQ(parsed->statements.size(), 4u);
  EXPECT_EQ(parsed->statements[0]->kind, syntax::StatementKind::Jump);
  EXPECT_EQ(parsed->statements[2]->kind, syntax::StatementKind::Label);
}

}  // namespace
