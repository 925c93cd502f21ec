#include <gtest/gtest.h>

#include "ladder/source/diagnostic_sink.h"
#include "ladder/source/name_table.h"
#include "ladder/source/render.h"
#include "ladder/source/suggestion.h"

namespace {

using namespace stepwright::source;
namespace result = stepwright::result;

TEST(SourceSet, Location_WhenOffsetIsGiven_ThenLineAndColumnCountCharacters) {
  SourceSet sources;
  const FileId file = sources.add("a.st", "one\n\xC3\xA4\xC3\xB6 x\nlast");
  EXPECT_EQ(sources.location({file, 0}).line, 1u);
  const result::Location x = sources.location({file, 9});  // behind two letters of two bytes
  EXPECT_EQ(x.line, 2u);
  EXPECT_EQ(x.column, 4u);
  EXPECT_EQ(sources.location({file, 999}).line, 3u);
}

TEST(SourceSet, Location_WhenTheLineIsLong_ThenEveryColumnIsThatOfAWalkAlongIt) {
  std::string text = "first\n";
  while (text.size() < 2000) text += "a\xC3\xA4\xE6\xB0\xB4 ";
  SourceSet sources;
  const FileId file = sources.add("a.st", text);
  std::uint32_t column = 1;
  for (std::uint32_t at = 6; at < text.size(); ++at) {
    const LineColumn found = sources.line_column({file, at});
    ASSERT_EQ(found.line, 2u);
    ASSERT_EQ(found.column, column) << "byte " << at;
    if ((static_cast<unsigned char>(text[at]) & 0xC0u) != 0x80u) ++column;
  }
}

TEST(SourceSet, Views_WhenMoreTextsAreAdded_ThenStayValid) {
  SourceSet sources;
  const std::string_view first = sources.text(sources.add("a", "short"));
  for (int i = 0; i < 100; ++i) sources.add("b", "other");
  EXPECT_EQ(first, "short");
}

TEST(NameTable, Intern_WhenOnlyTheCaseDiffers_ThenIsOneName) {
  NameTable names;
  const NameId lamp = names.intern("Lamp");
  EXPECT_EQ(names.intern("LAMP"), lamp);
  EXPECT_FALSE(names.intern("lamp2") == lamp);
  EXPECT_EQ(names.folded(lamp), "LAMP");
}

TEST(DiagnosticSink, Take_WhenReportedInAnyOrder_ThenSortedAndOnce) {
  SourceSet sources;
  const FileId file = sources.add("a.st", "abc\ndef");
  DiagnosticSink sink(sources);
  sink.error("E0201", {file, 4}, "second");
  sink.error("E0201", {file, 4}, "second again");
  sink.warning("W0001", {file, 1}, "first");
  EXPECT_TRUE(sink.has_errors());
  const auto found = sink.take();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].message, "first");
  EXPECT_EQ(found[1].where.line, 2u);
  EXPECT_FALSE(sink.has_errors());
}

TEST(DiagnosticSink, Report_WhenThereAreTooMany_ThenTheListIsBounded) {
  SourceSet sources;
  const FileId file = sources.add("a.st", std::string(5000, 'x'));
  DiagnosticSink sink(sources);
  for (std::uint32_t i = 0; i < 5000; ++i) sink.error("E0201", {file, i}, "x");
  // A flood of warnings drowns no error.
  for (std::uint32_t i = 0; i < 300; ++i) sink.warning("W0001", {file, i}, "x");
  const auto found = sink.take();
  ASSERT_EQ(found.size(), 2 * DiagnosticSink::kLimit + 1);
  EXPECT_EQ(found.back().severity, result::Severity::Note);
  EXPECT_EQ(found.back().message, "4900 more are not shown");
}

TEST(DiagnosticSink, IsFull_WhenOnlyWarningsAreMany_ThenErrorsAreStillKept) {
  SourceSet sources;
  const FileId file = sources.add("a.st", std::string(5000, 'x'));
  DiagnosticSink sink(sources);
  for (std::uint32_t i = 0; i < 300; ++i) sink.warning("W0001", {file, i}, "x");
  EXPECT_FALSE(sink.is_full());
  for (std::uint32_t i = 0; i < DiagnosticSink::kLimit; ++i) sink.error("E0201", {file, i}, "x");
  EXPECT_TRUE(sink.is_full());
  sink.error("E0201", {file, 4000}, {});
  EXPECT_EQ(sink.error_count(), DiagnosticSink::kLimit + 1);
}

TEST(DiagnosticSink, Take_WhenAnotherModuleNamesPlaces_ThenTheyAreSortedAmongTheOthers) {
  SourceSet sources;
  const FileId file = sources.add("a.st", "one\ntwo\nthree");
  DiagnosticSink sink(sources);
  sink.error("E0201", {file, 8}, "line 3");
  sink.add({{"E0711", result::Severity::Error, {"a.st", 2, 1}, "line 2", ""},
            {"E0711", result::Severity::Error, {"a.st", 2, 1}, "line 2 again", ""},
            {"E0711", result::Severity::Error, {"other.xml", 1, 1}, "elsewhere", ""}});
  const auto found = sink.take();
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].message, "line 2");
  EXPECT_EQ(found[1].message, "line 3");
  EXPECT_EQ(found[2].message, "elsewhere");
}

TEST(Suggestion, DidYouMean_WhenANameIsNear_ThenNamesIt) {
  const std::string_view names[] = {"lamp", "level", "__EDGE0"};
  EXPECT_EQ(did_you_mean("LMAP", names), "did you mean 'lamp'?");
  EXPECT_EQ(did_you_mean("levle", names), "did you mean 'level'?");
  EXPECT_EQ(did_you_mean("pressure", names), "");
  EXPECT_EQ(did_you_mean(std::string(1'000'000, 'x'), names), "");
}

result::Diagnostic unknown_name() {
  result::Diagnostic diagnostic;
  diagnostic.code = "E0201";
  diagnostic.where.file = "a.st";
  diagnostic.where.line = 2;
  diagnostic.where.column = 7;
  diagnostic.message = "'zz' is not declared";
  diagnostic.hint = "look";
  return diagnostic;
}

TEST(Render, Diagnostic_WhenTheTextIsKnown_ThenTheCaretStandsBelow) {
  const NamedText texts[] = {{"a.st", "x := 1;\n\ty := zz;\n"}};
  EXPECT_EQ(render(unknown_name(), texts),
            "a.st:2:7: error E0201: 'zz' is not declared\n"
            "  2 | \ty := zz;\n"
            "    | \t     ^\n"
            "  hint: look\n");
}

TEST(Render, Diagnostic_WhenTheTextIsUnknown_ThenOnlyThePlaceIsNamed) {
  EXPECT_EQ(render(unknown_name(), {}), "a.st:2:7: error E0201: 'zz' is not declared\n  hint: look\n");
}

std::string caret_line(const std::string& text, std::uint32_t column, RenderStyle style = {}) {
  result::Diagnostic diagnostic = unknown_name();
  diagnostic.where.line = 1;
  diagnostic.where.column = column;
  diagnostic.hint.clear();
  const NamedText texts[] = {{"a.st", text}};
  const std::string all = render(diagnostic, texts, style);
  return all.substr(all.find('\n') + 1);
}

TEST(Render, Caret_WhenCharactersAreWideOrCombine_ThenItStandsBelow) {
  // Two letters of two columns each; an e with a combining acute accent.
  EXPECT_EQ(caret_line("\xE6\xB0\xB4\xE4\xBD\x8D x", 4), "  1 | \xE6\xB0\xB4\xE4\xBD\x8D x\n    |      ^\n");
  EXPECT_EQ(caret_line("e\xCC\x81 x", 4), "  1 | e\xCC\x81 x\n    |   ^\n");
  EXPECT_EQ(caret_line("\xC3\xA4\xC3\xB6 x", 4), "  1 | \xC3\xA4\xC3\xB6 x\n    |    ^\n");
}

TEST(Render, Line_WhenItHoldsControlCharactersOrBadBytes_ThenTheTerminalIsSafe) {
  EXPECT_EQ(caret_line("a\x1b[31m\xFF b", 8), "  1 | a?[31m? b\n    |        ^\n");
  // A control character of two bytes, and one that turns the text around.
  EXPECT_EQ(caret_line("a\xC2\x9B\x33m\xE2\x80\xAE b", 6), "  1 | a?3m? b\n    |      ^\n");
}

TEST(Render, Line_WhenItIsLong_ThenItIsCutAroundTheCaret) {
  const std::string text = std::string(300, 'a') + "X" + std::string(300, 'b');
  const std::string shown = caret_line(text, 301, {.width = 30});
  EXPECT_EQ(shown, "  1 | ..." + std::string(10, 'a') + "X" + std::string(19, 'b') + "...\n    |    " +
                       std::string(10, ' ') + "^\n");
  const std::string longer = std::string(100'000, 'a') + "X" + std::string(100'000, 'b');
  EXPECT_EQ(caret_line(longer, 100'001, {.width = 30}), shown);
  std::string letters;
  for (int i = 0; i < 50'000; ++i) letters += "\xC3\xA4";
  EXPECT_NE(caret_line(letters + "X" + letters, 50'001, {.width = 30}).find("\xC3\xA4X\xC3\xA4"),
            std::string::npos);
  EXPECT_EQ(caret_line(std::string(40, 'a'), 41, {.width = 30}),
            "  1 | ..." + std::string(30, 'a') + "\n    |    " + std::string(30, ' ') + "^\n");
  EXPECT_EQ(caret_line(std::string(40, 'a'), 1, {.width = 30}),
            "  1 | " + std::string(30, 'a') + "...\n    | ^\n");
}

TEST(Render, Colour_WhenAsked_ThenTheWordAndTheCaretAreColoured) {
  const std::string shown = render(unknown_name(), {}, {.colour = true});
  EXPECT_NE(shown.find("\x1b[1;31merror E0201:\x1b[0m"), std::string::npos);
  EXPECT_EQ(render(unknown_name(), {}).find('\x1b'), std::string::npos);
}

}  // namespace
