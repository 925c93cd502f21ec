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
  EXPECT_EQ(sink.take().size(), DiagnosticSink::kLimit);
}

TEST(Suggestion, DidYouMean_WhenANameIsNear_ThenNamesIt) {
  const std::string_view names[] = {"lamp", "level", "__EDGE0"};
  EXPECT_EQ(did_you_mean("LMAP", names), "did you mean 'lamp'?");
  EXPECT_EQ(did_you_mean("levle", names), "did you mean 'level'?");
  EXPECT_EQ(did_you_mean("pressure", names), "");
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

}  // namespace
