#include <gtest/gtest.h>

#include "ladder/driver/sheets.h"
#include "ladder/exchange/plcopen_reader.h"
#include "ladder/print/print.h"
#include "tests/unit/ladder/exchange/plcopen_samples.h"

namespace stepwright::print {
namespace {

std::string text_of_st(const std::string& st) {
  driver::CompileInput input;
  input.texts.push_back({"p.st", st});
  const auto sheets = driver::sheets_of(input);
  return sheets ? print_text(*sheets, {.project = "Cell"}) : result::to_string(sheets.error());
}

std::string text_of_xml(const std::string& xml) {
  const auto project = exchange::read_plcopen("p.xml", xml);
  if (!project) return result::to_string(project.error());
  driver::CompileInput input;
  input.projects.push_back(&*project);
  const auto sheets = driver::sheets_of(input);
  return sheets ? print_text(*sheets, {.project = "Cell"}) : result::to_string(sheets.error());
}

// Without the three lines of the title.
std::string body_of(const std::string& text) {
  std::size_t at = 0;
  for (int i = 0; i < 3; ++i) at = text.find('\n', at) + 1;
  return text.substr(at);
}

TEST(PrintText, WhenFunctionIsPrinted_ThenLinesHaveTheNumbersOfTheFile) {
  const std::string text = text_of_st(
      "FUNCTION limit : INT\nVAR_INPUT\n  value : INT; (* raw *)\n  top : INT := 9; // bound\nEND_VAR\n"
      "  (* The rest\n     is easy. *)\n  IF value > top THEN limit := top; END_IF;\nEND_FUNCTION\n");
  EXPECT_NE(text.find("FUNCTION limit : INT"), std::string::npos) << text;
  EXPECT_EQ(body_of(text), R"(
Declarations
  Section    Name   Type  Initial  Comment
  ────────────────────────────────────────
  VAR_INPUT  value  INT            raw
  VAR_INPUT  top    INT   9        bound

    6    (* The rest
    7       is easy. *)
    8    IF value > top THEN limit := top; END_IF;

Cross references
  Variable  Type  Written  Read
  ─────────────────────────────
  limit     INT   8
  top       INT            8
  value     INT            8
)");
}

TEST(PrintText, WhenChartIsPrinted_ThenItIsDrawnWithItsActionsAndReferences) {
  const std::string text = text_of_st(
      "PROGRAM p\nVAR lamp AT %QX0.0 : BOOL; n : INT; END_VAR\nINITIAL_STEP A: lamp(N); count(P); END_STEP\n"
      "TRANSITION go FROM A TO A := n < 5; END_TRANSITION\nACTION count:\n  n := n + 1;\n  n := n * 2;\n"
      "END_ACTION\nEND_PROGRAM\n");
  EXPECT_EQ(body_of(text), R"(
Declarations
  Section  Name  Type  Address
  ────────────────────────────
  VAR      lamp  BOOL  %QX0.0
  VAR      n     INT

       │
 go ──>│
    ╔══╧══╗
    ║  A  ║───[N lamp]
    ╚═════╝  └[P count]
       │
       │
  go ━━╋━━ n < 5
       │
       │
       ▼ A

ACTION count
    1  n := n + 1;
    2  n := n * 2;

Cross references
  Variable  Type  Address  Written           Read
  ───────────────────────────────────────────────────────────────
  lamp      BOOL  %QX0.0   A
  n         INT            count:1, count:2  go, count:1, count:2
)");
}

TEST(PrintText, WhenLadderIsPrinted_ThenNetworksAreNumberedAndCommented) {
  const std::string text = text_of_xml(exchange::editor_ladder());
  EXPECT_NE(text.find("PROGRAM main"), std::string::npos) << text;
  EXPECT_NE(text.find("│ 2    The lamp, late"), std::string::npos) << text;
  EXPECT_NE(text.find("  lamp      BOOL  1        1, 2"), std::string::npos) << text;
  EXPECT_NE(text.find("CONFIGURATION Config0"), std::string::npos) << text;
}

TEST(PrintText, WhenRungIsWiderThanTheText_ThenItGoesOnInAnotherLine) {
  graphic::LadderProgram program;
  graphic::Rung& rung = program.rungs.emplace_back();
  std::vector<graphic::Condition> contacts;
  for (int i = 0; i < 12; ++i) contacts.push_back(graphic::contact("contact_" + std::to_string(i)));
  rung.condition = graphic::all(std::move(contacts));
  rung.coils = {{graphic::CoilKind::Normal, "lamp"}};
  graphic::Sheet sheet{"PROGRAM", "p"};
  sheet.body = program;
  const std::string text = print_text({sheet}, {});
  EXPECT_NE(text.find("─> 1"), std::string::npos) << text;
  EXPECT_NE(text.find("1 >─"), std::string::npos) << text;
  for (int i = 0; i < 12; ++i)
    EXPECT_NE(text.find("contact_" + std::to_string(i)), std::string::npos) << text;
}

TEST(PrintText, WhenGlobalsAreShared_ThenTheirUsesAreListedOnce) {
  const std::string text = text_of_st(
      "VAR_GLOBAL stop AT %IX0.1 : BOOL; END_VAR\n"
      "PROGRAM a\nVAR_EXTERNAL stop : BOOL; END_VAR VAR x : BOOL; END_VAR\nx := stop;\nEND_PROGRAM\n"
      "PROGRAM b\nVAR_EXTERNAL stop : BOOL; END_VAR\nstop := FALSE;\nEND_PROGRAM\n");
  EXPECT_NE(text.find("  stop      BOOL  %IX0.1   b: 8     a: 4\n"), std::string::npos) << text;
}

}  // namespace
}  // namespace stepwright::print
