// The language in charts: what stands in the bodies of the language tests means the same in an action and in
// a condition. Every program runs once more with its bodies as actions that run in each scan, against its own
// checks; every expression becomes the condition of a transition, whose tokens must come out of the lowering
// as they went in, each at its place.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "ladder/driver/pou_lowering.h"
#include "ladder/syntax/lexer.h"
#include "tests/st/check_program.h"

namespace {

using namespace stepwright;
using syntax::Keyword;
using syntax::Token;
using syntax::TokenKind;

const std::string kRoot = STEPWRIGHT_SOURCE_DIR "/tests/st/programs";

struct Parsed {
  source::SourceSet sources;
  source::NameTable names;
  source::DiagnosticSink sink{sources};
  syntax::SyntaxContext context{sources, names, sink};
  syntax::Unit unit;
  std::vector<Token> tokens;

  explicit Parsed(const std::string& text) {
    syntax::intern_keywords(names);
    const source::FileId file = sources.add("t.st", text);
    tokens = syntax::lex(sources, file, syntax::TextKind::Written, names, sink);
    syntax::parse_unit(context, file, unit);
  }
};

// Tokens of the body of a POU: from behind its declarations to its END.
struct Body {
  std::size_t first = 0;
  std::size_t last = 0;
};

Body body_of(const Parsed& parsed, const syntax::PouDeclaration& pou) {
  Body body;
  for (std::size_t i = 0; i < parsed.tokens.size(); ++i) {
    const std::uint32_t offset = parsed.tokens[i].where.offset;
    if (offset == pou.name.where.offset) body.first = i + 1;
    if (parsed.tokens[i].is(Keyword::EndVar) && offset > pou.name.where.offset && offset < pou.end.offset)
      body.first = i + 1;
    if (offset <= pou.end.offset) body.last = i;
  }
  return body;
}

std::uint32_t end_of(const Token& token) {
  return token.where.offset + static_cast<std::uint32_t>(token.text.size());
}

// The program with every body of a program or function block as an action; empty if it has none, or one that
// cannot be an action: a chart, or one that leaves its POU (E0725).
std::string as_actions(const std::string& text) {
  const Parsed parsed(text);
  std::string result = text;
  bool changed = false;
  for (auto pou = parsed.unit.pous.rbegin(); pou != parsed.unit.pous.rend(); ++pou) {
    if (pou->kind == syntax::PouKind::Function) continue;
    const Body body = body_of(parsed, *pou);
    if (pou->chart ||
        !parsed.tokens[body.last].is(pou->kind == syntax::PouKind::Program ? Keyword::EndProgram
                                                                           : Keyword::EndFunctionBlock))
      return {};
    for (std::size_t i = body.first; i < body.last; ++i)
      if (parsed.tokens[i].is(Keyword::Return)) return {};
    // On the lines that are there: the checks speak of lines.
    result.insert(parsed.tokens[body.last].where.offset, " END_ACTION ");
    result.insert(
        end_of(parsed.tokens[body.first - 1]),
        " INITIAL_STEP Chart_step: Chart_action(N); END_STEP TRANSITION FROM Chart_step TO Chart_step "
        ":= FALSE; END_TRANSITION ACTION Chart_action:");
    changed = true;
  }
  return changed ? result : std::string();
}

TEST(ChartTexts, WhenBodiesOfTheLanguageTestsAreActions_ThenEveryCheckHolds) {
  std::size_t programs = 0;
  for (const std::string& name : st_test::programs_below(kRoot)) {
    const std::string text = as_actions(st_test::read_file(kRoot + "/" + name));
    if (text.empty()) continue;
    ++programs;
    for (const std::string& failure : st_test::run_checks(name, text)) ADD_FAILURE() << failure;
  }
  EXPECT_GE(programs, 600U);
}

// Where the expression that begins at `i` ends: before ';', THEN, DO, OF, TO, BY or what closes a bracket
// that was open before; `i` itself if that is no expression alone.
std::size_t end_of_expression(const std::vector<Token>& tokens, std::size_t i, std::size_t last) {
  int depth = 0;
  for (; i < last; ++i) {
    const Token& token = tokens[i];
    if (token.is(TokenKind::LeftParen) || token.is(TokenKind::LeftBracket)) ++depth;
    if (token.is(TokenKind::RightParen) || token.is(TokenKind::RightBracket)) --depth;
    const bool ends = token.is(TokenKind::Semicolon) || token.is(Keyword::Then) || token.is(Keyword::Do) ||
                      token.is(Keyword::Of) || token.is(Keyword::To) || token.is(Keyword::By) ||
                      token.is(Keyword::EndRepeat) || token.is(TokenKind::Comma);
    if (depth < 0 || (depth == 0 && ends)) return i;
  }
  return i;
}

// The texts of all expressions behind ':=', IF, ELSIF, WHILE, UNTIL and CASE, with the comments between.
void add_expressions(const std::string& text, std::set<std::string>& expressions) {
  const Parsed parsed(text);
  if (parsed.sink.has_errors()) return;
  const std::vector<Token>& tokens = parsed.tokens;
  for (const syntax::PouDeclaration& pou : parsed.unit.pous) {
    if (pou.chart) continue;
    const Body body = body_of(parsed, pou);
    for (std::size_t i = body.first; i < body.last; ++i) {
      const Token& token = tokens[i];
      const bool leads = token.is(TokenKind::Assign) || token.is(Keyword::If) || token.is(Keyword::Elsif) ||
                         token.is(Keyword::While) || token.is(Keyword::Until) || token.is(Keyword::Case);
      const std::size_t end = leads ? end_of_expression(tokens, i + 1, body.last) : i + 1;
      if (end == i + 1) continue;
      const std::uint32_t begin = tokens[i + 1].where.offset;
      expressions.insert(text.substr(begin, end_of(tokens[end - 1]) - begin));
    }
  }
}

using Tokens = std::vector<Token>;

// What stands for the condition of a transition in the lowered text of a chart: in "X_FIRES := STEP_X AND
// (condition); " or, where it is evaluated under the power of its step only, in "X_FIRES := condition; ",
// with or without parentheses.
std::vector<Tokens> lowered_conditions(Parsed& parsed, std::size_t transition) {
  const std::string wanted = "TRANS" + std::to_string(transition) + "_FIRES";
  for (std::uint32_t i = 0; i < parsed.sources.size(); ++i) {
    const source::FileId file(i);
    const std::size_t found = parsed.sources.text(file).find(wanted + " := ");
    if (parsed.sources.name(file) != "p.sfc" || found == std::string_view::npos) continue;
    const Tokens tokens =
        syntax::lex(parsed.sources, file, syntax::TextKind::Generated, parsed.names, parsed.sink);
    std::vector<Tokens> candidates;
    for (auto at = tokens.begin(); at + 1 < tokens.end(); ++at) {
      if (at->text != wanted || !(at + 1)->is(TokenKind::Assign)) continue;
      const auto semicolon =
          std::find_if(at, tokens.end(), [](const Token& each) { return each.is(TokenKind::Semicolon); });
      const auto open =
          std::find_if(at, semicolon, [](const Token& each) { return each.is(TokenKind::LeftParen); });
      candidates.push_back({at + 2, semicolon});
      if (open != semicolon) candidates.push_back({open + 1, semicolon - 1});
    }
    return candidates;
  }
  return {};
}

// What is wrong with the tokens that stand for those from `first` on.
std::string difference(const Tokens& found, Tokens::const_iterator first) {
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Token& written = first[static_cast<std::ptrdiff_t>(i)];
    if (found[i].kind != written.kind || found[i].text != written.text || found[i].where != written.where)
      return "'" + std::string(found[i].text) + "' stands for '" + std::string(written.text) + "'";
  }
  return first[static_cast<std::ptrdiff_t>(found.size())].is(TokenKind::Semicolon) ? ""
                                                                                   : "tokens are missing";
}

// What is wrong with an expression as the condition of the only transition.
std::string difference(const std::string& expression) {
  const std::string head =
      "PROGRAM p INITIAL_STEP Chart_from: END_STEP TRANSITION FROM Chart_from TO Chart_from := ";
  Parsed parsed(head + expression + "; END_TRANSITION END_PROGRAM");
  driver::PouLowering lowering(parsed.context, parsed.unit);
  lowering.lower_charts();
  for (const result::Diagnostic& each : parsed.sink.take())
    if (each.severity == result::Severity::Error) return result::to_string(each);
  const auto first = std::find_if(parsed.tokens.begin(), parsed.tokens.end(),
                                  [&](const Token& each) { return each.where.offset >= head.size(); });
  std::string wrong = "nothing stands for it";
  for (const Tokens& each : lowered_conditions(parsed, 0)) {
    wrong = difference(each, first);
    if (wrong.empty()) return {};
  }
  return wrong;
}

TEST(ChartTexts, WhenExpressionsOfTheLanguageTestsAreConditions_ThenTheirTokensStay) {
  std::set<std::string> expressions;
  for (const std::string& name : st_test::programs_below(kRoot))
    add_expressions(st_test::read_file(kRoot + "/" + name), expressions);
  EXPECT_GE(expressions.size(), 2000U);
  for (const std::string& each : expressions) {
    // TRUE is no condition: the transition fires with its step.
    if (source::upper(each) == "TRUE") continue;
    EXPECT_EQ(difference(each), "") << each;
  }
}

}  // namespace
