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

// A declaration unit, which must be free of mistakes.
syntax::Unit unit_of(Parsed& parsed, const std::string& text) {
  syntax::intern_keywords(parsed.names);
  source::DiagnosticSink sink(parsed.sources);
  syntax::SyntaxContext context{parsed.sources, parsed.names, sink};
  syntax::Unit unit;
  syntax::parse_unit(context, parsed.sources.add("t.st", text), unit);
  parsed.diagnostics = sink.take();
  EXPECT_TRUE(parsed.diagnostics.empty()) << to_string(parsed.diagnostics);
  return unit;
}

TEST(Parser, Types_WhenOfEdition3_ThenAreToldApart) {
  using syntax::TypeKind;
  Parsed parsed;
  const syntax::Unit unit = unit_of(parsed,
                                    "TYPE a : INT(0..9); b : DINT (Red := 1, Green) := Red; c : STRING[20]; "
                                    "d : WSTRING(LEN); e : REF_TO INT;\n"
                                    "f : ARRAY[1..2, 3..4] OF REF_TO ARRAY[0..1] OF BOOL; g : (One, Two); h "
                                    ": INT(LOW..5); i : STRING; END_TYPE");
  std::vector<TypeKind> found;
  for (const auto& each : unit.types) found.push_back(each.type->kind);
  EXPECT_EQ(found, (std::vector<TypeKind>{TypeKind::Subrange, TypeKind::Enumeration, TypeKind::Text,
                                          TypeKind::Text, TypeKind::Reference, TypeKind::Array,
                                          TypeKind::Enumeration, TypeKind::Subrange, TypeKind::Named}));
  EXPECT_EQ(unit.types[1].name.text, "b");
  EXPECT_EQ(unit.types[1].type->name.text, "DINT");
  EXPECT_EQ(unit.types[5].type->element->element->kind, TypeKind::Array);
}

TEST(Parser, Parts_WhenWritten_ThenAreNoMembers) {
  const auto parsed = parse("x := a.%X3; x := a[1].%B2; x := a.7; x := a^.b^; x.%W1 := 2; r ?= NULL;");
  ASSERT_TRUE(parsed->diagnostics.empty()) << to_string(parsed->diagnostics);
  const auto value = [&](std::size_t i) -> const Expression& { return *parsed->statements.at(i)->value; };
  EXPECT_EQ(value(0).kind, ExpressionKind::Part);
  EXPECT_EQ(value(1).part_bits, 8);
  EXPECT_EQ(value(1).integer, 2u);
  EXPECT_EQ(value(2).kind, ExpressionKind::Part);
  EXPECT_EQ(value(3).kind, ExpressionKind::Dereference);
  EXPECT_EQ(parsed->statements[4]->target->part_bits, 16);
  EXPECT_EQ(parsed->statements[5]->kind, syntax::StatementKind::Attempt);
  EXPECT_EQ(value(5).kind, ExpressionKind::Null);
}

TEST(Parser, Call_WhenEnabled_ThenEnAndEnoAreNoArguments) {
  const auto parsed = parse("f(EN := a, x := 1, ENO => b, NOT q => c);");
  ASSERT_TRUE(parsed->diagnostics.empty()) << to_string(parsed->diagnostics);
  const Expression& call = *parsed->statements[0]->value;
  ASSERT_TRUE(call.enable && call.enabled);
  EXPECT_EQ(call.enabled->value->name.text, "b");
  ASSERT_EQ(call.arguments.size(), 2u);
  EXPECT_TRUE(call.arguments[1].negated);
}

TEST(Parser, Labels_WhenConstantExpressions_ThenBelongToCase) {
  const auto parsed = parse("CASE x OF -5..LOW + 1: y := 1; INT#7, (A): f(3); b := 2; C#Red: END_CASE;");
  ASSERT_TRUE(parsed->diagnostics.empty()) << to_string(parsed->diagnostics);
  EXPECT_EQ(parsed->statements[0]->branches.size(), 3u);
  EXPECT_EQ(parsed->statements[0]->branches[1].body.size(), 2u);
}

TEST(Parser, Variables_WhenQualified_ThenTheQualifiersAreKept) {
  Parsed parsed;
  const syntax::Unit unit = unit_of(
      parsed,
      "FUNCTION_BLOCK b VAR_INPUT a : BOOL R_EDGE; c : BOOL F_EDGE; END_VAR VAR NON_RETAIN d AT %I* : BOOL; "
      "e AT %QW* : INT; END_VAR VAR AT %MW3 : INT; END_VAR VAR_IN_OUT m : ARRAY[*, *] OF INT; END_VAR "
      "END_FUNCTION_BLOCK");
  const auto& lines = unit.pous.at(0).variables;
  ASSERT_EQ(lines.size(), 6u);
  EXPECT_EQ(lines[0].edge, syntax::Edge::Rising);
  EXPECT_EQ(lines[1].edge, syntax::Edge::Falling);
  EXPECT_TRUE(lines[2].non_retain);
  EXPECT_EQ(lines[2].open_address, syntax::Area::Input);
  EXPECT_EQ(lines[3].open_address, syntax::Area::Output);
  EXPECT_TRUE(lines[4].names.empty());
  EXPECT_EQ(lines[4].address->byte, 6u);
  EXPECT_EQ(lines[5].type->ranges.size(), 2u);
  EXPECT_EQ(lines[5].type->ranges[0].low, nullptr);
}

TEST(Parser, Configuration_WhenComplete_ThenNothingIsLost) {
  Parsed parsed;
  const syntax::Unit unit =
      unit_of(parsed,
              "CONFIGURATION c VAR_GLOBAL g : BOOL; END_VAR\n"
              "RESOURCE r1 ON cpu VAR_GLOBAL h : INT; END_VAR TASK t(SINGLE := g, PRIORITY := 2);\n"
              "PROGRAM RETAIN p WITH t : main(x := h, y => %QW1, fb WITH t); END_RESOURCE\n"
              "RESOURCE r2 ON cpu TASK t(INTERVAL := T#5ms); PROGRAM q WITH t : main; END_RESOURCE\n"
              "VAR_CONFIG r1.p.fb.d AT %IX0.3 : BOOL; r2.q.n : INT := 5; END_VAR END_CONFIGURATION");
  const syntax::Configuration& configuration = unit.configurations.at(0);
  ASSERT_EQ(configuration.resources.size(), 2u);
  const syntax::Resource& first = configuration.resources[0];
  EXPECT_EQ(first.globals.size(), 1u);
  EXPECT_NE(first.tasks.at(0).single, nullptr);
  EXPECT_TRUE(first.programs.at(0).retain);
  EXPECT_EQ(first.programs[0].connections.size(), 2u);
  EXPECT_EQ(first.programs[0].block_tasks.size(), 1u);
  ASSERT_EQ(configuration.configured.size(), 2u);
  EXPECT_EQ(configuration.configured[0].path.size(), 4u);
  EXPECT_EQ(configuration.configured[0].address->bit, 3);
  EXPECT_NE(configuration.configured[1].initial, nullptr);
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
