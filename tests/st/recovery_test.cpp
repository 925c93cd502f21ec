// One mistake gives few diagnostics: every program of tests/st/programs that compiles, with one token left
// out, written twice or exchanged for another. Nothing may crash or hang, the report stays short, and a
// mistake in a body is reported in its POU.

#include <gtest/gtest.h>

#include <algorithm>

#include "ladder/driver/compile.h"
#include "ladder/syntax/lexer.h"
#include "tests/st/check_program.h"

namespace {

using namespace stepwright;

const std::string kRoot = STEPWRIGHT_SOURCE_DIR "/tests/st/programs";

// So many errors for one wrong token, and for one in a hundred somewhat more: where a word that opens or
// closes declarations is wrong, what stands between means something else.
constexpr std::size_t kMostErrors = 3;
constexpr std::size_t kMostErrorsAtAll = 9;
constexpr std::size_t kShareOfWordy = 100;
// Every so many mutations of all that there are is tried: a prime, so that all kinds of tokens have their
// turn.
constexpr std::size_t kStride = 17;
constexpr std::size_t kExpectedTries = 10'000;

enum class Change : std::uint8_t { LeaveOut, Double, Exchange };
constexpr Change kChanges[] = {Change::LeaveOut, Change::Double, Change::Exchange};

struct Place {
  std::uint32_t offset = 0;
  std::uint32_t size = 0;
  std::uint32_t line = 0;
  bool word = false;        // a name or a reserved word
  bool in_body = false;     // behind the last VAR section of its POU
  std::uint32_t first = 0;  // lines of its POU, up to the next one
  std::uint32_t behind = ~0u;
};

// What stands between POUs, and heads of them, too: where a namespace is lost, so are the names in it.
bool begins_pou(const syntax::Token& token) {
  using enum syntax::Keyword;
  if (token.text == "NAMESPACE" || token.text == "USING") return true;
  return token.is(Program) || token.is(FunctionBlock) || token.is(Function) || token.is(Configuration) ||
         token.is(Type) || token.is(VarGlobal);
}

std::vector<Place> places_of(const std::string& text) {
  source::SourceSet sources;
  source::NameTable names;
  syntax::intern_keywords(names);
  source::DiagnosticSink sink(sources);
  const source::FileId file = sources.add("t.st", text);
  std::vector<Place> places;
  std::size_t open = 0;  // first place of the POU that is being read
  bool in_configuration = false;
  const auto close = [&](std::uint32_t behind) {
    for (std::size_t i = open; i < places.size(); ++i) places[i].behind = behind;
    open = places.size();
  };
  for (const syntax::Token& token : syntax::lex(sources, file, syntax::TextKind::Written, names, sink)) {
    if (token.is(syntax::TokenKind::End)) break;
    Place place;
    place.offset = token.where.offset;
    place.size =
        static_cast<std::uint32_t>(token.text.size() + (token.is(syntax::TokenKind::TypePrefix) ? 1 : 0));
    place.line = sources.line(token.where);
    place.word = token.is(syntax::TokenKind::Identifier) || token.is(syntax::TokenKind::Keyword);
    if (begins_pou(token) && !in_configuration) {
      close(place.line);
      in_configuration = token.is(syntax::Keyword::Configuration);
    }
    place.first = open < places.size() ? places[open].line : place.line;
    // Where the head of a POU is lost, so is its name.
    place.in_body = !in_configuration && place.line != place.first;
    places.push_back(place);
    // What stood before this was no body.
    if (token.is(syntax::Keyword::EndVar) || token.is(syntax::Keyword::EndType))
      for (std::size_t i = open; i < places.size(); ++i) places[i].in_body = false;
  }
  close(~0u);
  return places;
}

std::string changed(const std::string& text, const Place& place, Change change) {
  const std::string token = text.substr(place.offset, place.size);
  std::string other;
  switch (change) {
    case Change::LeaveOut:
      break;
    case Change::Double:
      other = token + " " + token;
      break;
    case Change::Exchange:
      // What no program can mean at this place: a symbol where a word stands, a word for a symbol.
      other =
          place.word ? (place.offset % 2 == 0 ? "," : "other") : (place.offset % 2 == 0 ? "THEN" : "other");
      break;
  }
  return text.substr(0, place.offset) + " " + other + " " + text.substr(place.offset + place.size);
}

result::Diagnostics errors_of(const std::string& text) {
  driver::CompileInput input;
  input.texts.push_back({"t.st", text});
  const auto output = driver::compile(input);
  if (output) return {};
  result::Diagnostics errors = output.error();
  std::erase_if(errors, [](const auto& each) { return each.severity != result::Severity::Error; });
  return errors;
}

struct Outcome {
  std::size_t errors = 0;
  bool elsewhere = false;  // a mistake in a body, reported outside of its POU
  std::string report;
};

Outcome outcome_of(const std::string& text, const Place& place, Change change) {
  const result::Diagnostics errors = errors_of(changed(text, place, change));
  const char* const words[] = {"left out", "doubled", "exchanged"};
  Outcome outcome;
  outcome.errors = errors.size();
  outcome.elsewhere = place.in_body && std::ranges::any_of(errors, [&](const auto& each) {
                        return each.where.line < place.first || each.where.line > place.behind;
                      });
  outcome.report = "line " + std::to_string(place.line) + ", '" + text.substr(place.offset, place.size) +
                   "' " + words[static_cast<std::size_t>(change)] + ":\n" + result::to_string(errors);
  return outcome;
}

// Calls `visit(name, outcome)` for every stride-th mutation of all programs that compile.
template <typename Visit>
void mutate_all(Visit visit) {
  std::size_t number = 0;
  for (const std::string& name : st_test::programs_below(kRoot)) {
    const std::string text = st_test::read_file(kRoot + "/" + name);
    if (text.size() > 6000 || !errors_of(text).empty()) continue;
    for (const Place& place : places_of(text))
      for (const Change change : kChanges)
        if (number++ % kStride == 0) visit(name, outcome_of(text, place, change));
  }
}

TEST(Recovery, Compile_WhenOneTokenIsWrong_ThenTheReportIsShortAndInPlace) {
  std::size_t tried = 0;
  std::size_t wordy = 0;
  mutate_all([&](const std::string& name, const Outcome& outcome) {
    ++tried;
    EXPECT_LE(outcome.errors, kMostErrorsAtAll) << name << ", " << outcome.report;
    EXPECT_FALSE(outcome.elsewhere) << name << ", " << outcome.report;
    if (outcome.errors <= kMostErrors) return;
    ++wordy;
    if (wordy * kShareOfWordy > kExpectedTries) ADD_FAILURE() << name << ", " << outcome.report;
  });
  EXPECT_GT(tried, kExpectedTries);
}

}  // namespace
