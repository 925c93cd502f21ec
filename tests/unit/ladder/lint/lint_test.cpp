// Every warning: sources that give it, at which place, and sources that must not.

#include <gtest/gtest.h>

#include "ladder/driver/compile.h"
#include "ladder/driver/library_texts.h"

namespace {

using namespace stepwright;

// "W0003 at 2:5" for each diagnostic.
std::vector<std::string> found_in(const std::string& text, lint::Level level = lint::Level::Default) {
  driver::CompileInput input;
  input.texts.push_back({"t.st", text});
  input.lint = level;
  const auto output = driver::compile(input);
  std::vector<std::string> found;
  for (const auto& each : output ? output->warnings : output.error())
    found.push_back(each.code + " at " + std::to_string(each.where.line) + ":" +
                    std::to_string(each.where.column));
  return found;
}

using Found = std::vector<std::string>;

struct WarningCase {
  const char* name;
  const char* text;
  Found expected;
  lint::Level level = lint::Level::Default;
};

void PrintTo(const WarningCase& each, std::ostream* out) {
  *out << each.name;
}

// The statements stand in line 3.
#define BODY(statements)                                                                                    \
  "PROGRAM main\nVAR i, j : INT := 1; b, c : BOOL := TRUE; r, s : REAL := 0.5; u : UINT := 1; t : TON; "    \
  "a : ARRAY[1..3] OF INT := [1, 2, 3]; p : REF_TO INT; END_VAR\n" statements                               \
  "\ni := j; j := i + a[1]; b := c; c := r > s; r := s; s := r + 1.0; u := u + 1; t(IN := b, PT := T#1s); " \
  "p := REF(i); j := p^; a[1] := j;\nEND_PROGRAM\n"

const WarningCase kCases[] = {
    {"NothingWrong", BODY(""), {}},
    {"ConstantsOfDeclarations",
     "VAR_GLOBAL CONSTANT g : INT := 2; END_VAR\nTYPE T : ARRAY[0..g] OF INT; END_TYPE\nPROGRAM main\n"
     "VAR CONSTANT n : INT := 3; m : INT := n + 1; l : INT := 4; END_VAR\n"
     "VAR a : ARRAY[1..n] OF INT; b : INT := m; c : STRING[l]; t : T; END_VAR\n"
     "  a[1] := b; b := a[2]; c := 'a'; t[0] := 1;\nEND_PROGRAM\n",
     {}},
    {"WrittenByReference",
     "PROGRAM main\nVAR x, y, z : INT; r : REF_TO INT := REF(x); s : REF_TO INT; END_VAR\n"
     "  s := REF(y); r^ := 5; s^ := 6; z := x + y;\nEND_PROGRAM\n",
     {}},
    {"EnableInSmallLetters",
     "FUNCTION f : INT\nVAR_INPUT en : BOOL; a : INT; END_VAR VAR_OUTPUT eno : BOOL; END_VAR\nf := a;\n"
     "END_FUNCTION\nPROGRAM main\nVAR x : INT; END_VAR\n  x := f(a := 1);\nEND_PROGRAM\n",
     {}},
    // W0002
    {"UserFunctionIgnored",
     "FUNCTION f : INT\nVAR_INPUT x : INT; END_VAR\nf := x;\nEND_FUNCTION\nPROGRAM main\n  "
     "f(3);\nEND_PROGRAM\n",
     {"W0002 at 6:3"}},
    {"FunctionWithOutputCalled",
     "FUNCTION f : INT\nVAR_INPUT x : INT; END_VAR VAR_OUTPUT y : INT; END_VAR\nf := x; y := "
     "x;\nEND_FUNCTION\n"
     "PROGRAM main\nVAR n : INT; END_VAR\n  f(x := 3, y => n);\nEND_PROGRAM\n",
     {}},
    {"FunctionThatWritesAGlobalCalled",
     "VAR_GLOBAL g : INT; END_VAR\nPROGRAM main\n  f(3);\nEND_PROGRAM\n"
     "FUNCTION f : INT\nVAR_INPUT x : INT; END_VAR\nf := x; g := x;\nEND_FUNCTION\n",
     {}},
    // W0003, W0004, W0005
    {"UnusedLocal", "PROGRAM main\nVAR x : INT; END_VAR\nEND_PROGRAM\n", {"W0003 at 2:5"}},
    {"UnusedGlobal", "VAR_GLOBAL g : INT; END_VAR\nPROGRAM main\nEND_PROGRAM\n", {"W0003 at 1:12"}},
    {"UnusedInstance", "PROGRAM main\nVAR t : TON; END_VAR\nEND_PROGRAM\n", {"W0003 at 2:5"}},
    {"UnusedExternal",
     "VAR_GLOBAL g : INT; END_VAR\nPROGRAM main\nVAR_EXTERNAL g : INT; END_VAR\nEND_PROGRAM\n",
     {"W0003 at 1:12", "W0003 at 3:14"}},
    {"LocatedIsWiring", "PROGRAM main\nVAR x AT %IX0.0 : BOOL; END_VAR\nEND_PROGRAM\n", {}},
    {"GlobalOnlyInAFunctionBlock",
     "VAR_GLOBAL g : INT; END_VAR\nFUNCTION_BLOCK f\n  g := g + 1;\nEND_FUNCTION_BLOCK\nPROGRAM main\nVAR x "
     ": f; "
     "END_VAR\n  x();\nEND_PROGRAM\n",
     {}},
    {"UnusedInput",
     "FUNCTION_BLOCK f\nVAR_INPUT x, y : INT; END_VAR\nVAR_OUTPUT q : INT; END_VAR\n  q := "
     "x;\nEND_FUNCTION_BLOCK\n"
     "PROGRAM main\nVAR x : f; END_VAR\n  x(x := 1, y := 2);\nEND_PROGRAM\n",
     {"W0004 at 2:14"}},
    {"UnusedPouOnlyWithAll",
     "FUNCTION f : INT\n  f := 1;\nEND_FUNCTION\nPROGRAM main\nEND_PROGRAM\n",
     {"W0005 at 1:10"},
     lint::Level::All},
    {"UnusedPouByDefault", "FUNCTION f : INT\n  f := 1;\nEND_FUNCTION\nPROGRAM main\nEND_PROGRAM\n", {}},
    // W0006
    {"NeverWritten", "PROGRAM main\nVAR x, y : INT; END_VAR\n  y := x;\nEND_PROGRAM\n", {"W0006 at 3:8"}},
    {"WithAFirstValue", "PROGRAM main\nVAR x : INT := 3; y : INT; END_VAR\n  y := x;\nEND_PROGRAM\n", {}},
    {"KeptFromScanToScan", "PROGRAM main\nVAR x, y : INT; END_VAR\n  y := x; x := y + 1;\nEND_PROGRAM\n", {}},
    {"TemporaryReadFirst",
     "PROGRAM main\nVAR_TEMP x : INT; END_VAR\nVAR y : INT; END_VAR\n  y := x; x := y;\nEND_PROGRAM\n",
     {"W0006 at 4:8"}},
    {"WrittenLaterInTheLoop",
     "FUNCTION f : INT\nVAR i, last : INT; END_VAR\n  FOR i := 1 TO 3 DO IF i > 1 THEN f := last; END_IF; "
     "last := i; "
     "END_FOR;\nEND_FUNCTION\nPROGRAM main\nVAR n : INT; END_VAR\n  n := f();\nEND_PROGRAM\n",
     {}},
    {"NeverWrittenInTheLoop",
     "FUNCTION f : INT\nVAR i, last : INT; END_VAR\n  FOR i := 1 TO 3 DO f := last; END_FOR;\n  last := "
     "3;\nEND_FUNCTION\nPROGRAM main\nVAR n : INT; END_VAR\n  n := f();\nEND_PROGRAM\n",
     {"W0006 at 3:27"}},
    {"ResultNeverGiven",
     "FUNCTION f : INT\nVAR n : INT; END_VAR\n  n := 1;\nEND_FUNCTION\nPROGRAM main\nVAR n : INT; END_VAR\n  "
     "n := "
     "f();\nEND_PROGRAM\n",
     {"W0006 at 1:10"}},
    {"OutputNeverWritten",
     "FUNCTION_BLOCK f\nVAR_OUTPUT q, z : INT; END_VAR\n  q := 1;\nEND_FUNCTION_BLOCK\nPROGRAM main\nVAR x : "
     "f; "
     "END_VAR\n  x();\nEND_PROGRAM\n",
     {"W0006 at 2:15"}},
    {"WrittenByACall",
     "FUNCTION_BLOCK f\nVAR_IN_OUT x : INT; END_VAR VAR_OUTPUT q : INT; END_VAR\n  x := x + 1; q := x;\n"
     "END_FUNCTION_BLOCK\nPROGRAM main\nVAR y : f; n, m, k : INT; END_VAR\n  y(x := n, q => m); k := n + "
     "m;\nEND_PROGRAM\n",
     {}},
    // W0007
    {"TwoProgramsDriveOneOutput",
     "VAR_GLOBAL o AT %QX0.0 : BOOL; END_VAR\nPROGRAM a\nVAR x : BOOL := TRUE; END_VAR\n  o := "
     "x;\nEND_PROGRAM\n"
     "PROGRAM b\nVAR x : BOOL := TRUE; END_VAR\n  %QX0.0 := x;\nEND_PROGRAM\nCONFIGURATION c\nTASK "
     "t(INTERVAL := "
     "T#1ms);\nPROGRAM a1 WITH t : a;\nPROGRAM b1 WITH t : b;\nEND_CONFIGURATION\n",
     {"W0007 at 4:3"}},
    {"OverlappingAddresses",
     "PROGRAM a\n  %QB1 := 3;\nEND_PROGRAM\nPROGRAM b\n  %QX1.7 := FALSE;\nEND_PROGRAM\nCONFIGURATION "
     "c\nTASK "
     "t(INTERVAL := T#1ms);\nPROGRAM a1 WITH t : a;\nPROGRAM b1 WITH t : b;\nEND_CONFIGURATION\n",
     {"W0007 at 5:3"}},
    {"SetHereResetThere",
     "VAR_GLOBAL o AT %QX0.0 : BOOL; x AT %IX0.0 : BOOL; END_VAR\nPROGRAM a\n  o := o OR x;\nEND_PROGRAM\n"
     "PROGRAM b\n  o := o AND NOT x;\nEND_PROGRAM\nCONFIGURATION c\nTASK t(INTERVAL := T#1ms);\nPROGRAM a1 "
     "WITH t : "
     "a;\nPROGRAM b1 WITH t : b;\nEND_CONFIGURATION\n",
     {}},
    {"OneProgramTwoInstances",
     "PROGRAM a\nVAR o AT %QX0.0 : BOOL; x AT %IX0.0 : BOOL; END_VAR\n  o := x;\nEND_PROGRAM\nCONFIGURATION "
     "c\nTASK "
     "t(INTERVAL := T#1ms);\nPROGRAM a1 WITH t : a;\nPROGRAM a2 WITH t : a;\nEND_CONFIGURATION\n",
     {"W0007 at 3:3"}},
    {"TwiceInOneText",
     "PROGRAM a\nVAR o AT %QX0.0 : BOOL; x AT %IX0.0 : BOOL; END_VAR\n  o := FALSE; IF x THEN o := x; "
     "END_IF;\nEND_PROGRAM\n",
     {}},
    // W0008
    {"WhileNothingChanges", BODY("WHILE b DO i := i + 1; END_WHILE;"), {"W0008 at 3:1"}},
    {"WhileItsVariableChanges", BODY("WHILE i < 9 DO i := i + 1; END_WHILE;"), {}},
    {"WhileLeftByExit", BODY("WHILE TRUE DO i := i + 1; IF i > 9 THEN EXIT; END_IF; END_WHILE;"), {}},
    {"WhileTrue", BODY("WHILE TRUE DO i := i + 1; END_WHILE;"), {"W0008 at 3:1"}},
    {"ExitOfAnInnerLoopDoesNotCount",
     BODY("WHILE b DO FOR i := 1 TO 3 DO EXIT; END_FOR; END_WHILE;"),
     {"W0008 at 3:1"}},
    {"RepeatUntilBlock", BODY("REPEAT t(IN := TRUE, PT := T#0s); UNTIL t.Q END_REPEAT;"), {}},
    {"RepeatNothingChanges", BODY("REPEAT i := i + 1; UNTIL b END_REPEAT;"), {"W0008 at 3:1"}},
    {"WhileThroughAReference", BODY("WHILE i < 9 DO p^ := p^ + 1; END_WHILE;"), {}},
    {"WhileACalledBlockWritesTheGlobal",
     "VAR_GLOBAL g : INT; END_VAR\nFUNCTION_BLOCK f\n  g := g + 1;\nEND_FUNCTION_BLOCK\nPROGRAM main\nVAR x "
     ": f; "
     "END_VAR\n  WHILE g < 9 DO x(); END_WHILE;\nEND_PROGRAM\n",
     {}},
    // W0009
    {"ForVariableWritten", BODY("FOR i := 1 TO 3 DO i := 3; END_FOR;"), {"W0009 at 3:20"}},
    {"ForVariableOfTheNextLoop", BODY("FOR i := 1 TO 3 DO j := i; END_FOR; i := 7;"), {}},
    // W0010
    {"RealEqual", BODY("b := r = s;"), {"W0010 at 3:8"}, lint::Level::All},
    {"RealEqualByDefault", BODY("b := r = s;"), {}},
    {"RealNotEqualZero", BODY("b := r <> 0.0;"), {}, lint::Level::All},
    {"IntegersEqual", BODY("b := i = j;"), {}},
    // W0011
    {"LiteralCondition", BODY("IF TRUE THEN i := 1; END_IF;"), {"W0011 at 3:4"}},
    {"ConstantSwitch",
     "PROGRAM main\nVAR CONSTANT debug : BOOL := FALSE; END_VAR VAR i : INT; END_VAR\n  IF debug "
     "THEN i := i + 1; END_IF;\nEND_PROGRAM\n",
     {}},
    {"ComparedWithItself", BODY("IF i = i THEN j := 1; END_IF;"), {"W0011 at 3:6"}},
    {"UnsignedBelowZero", BODY("b := u < 0;"), {"W0011 at 3:8"}},
    // W0012
    {"AssignedToItself", BODY("a[1] := a[1];"), {"W0012 at 3:1"}},
    {"AssignedToAnother", BODY("a[1] := a[2];"), {}},
    // W0013
    {"HidesAGlobal",
     "VAR_GLOBAL n : INT; END_VAR\nPROGRAM main\nVAR n : INT; END_VAR\n  n := n + 1;\nEND_PROGRAM\n",
     {"W0003 at 1:12", "W0013 at 3:5"},
     lint::Level::All},
    {"HidesAnEnumerator",
     "TYPE C : (Red, Green); END_TYPE\nPROGRAM main\nVAR red : INT; END_VAR\n  red := red + "
     "1;\nEND_PROGRAM\n",
     {"W0013 at 3:5"},
     lint::Level::All},
    // W0014
    {"EnumerationWithElse",
     "TYPE C : (Red, Green, Blue); END_TYPE\nPROGRAM main\nVAR c : C; n : INT; END_VAR\n  CASE c OF Red: n "
     ":= 1; c := "
     "Green; ELSE n := 2; END_CASE;\nEND_PROGRAM\n",
     {}},
    {"EnumerationLeavesOut",
     "TYPE C : (Red, Green, Blue); END_TYPE\nPROGRAM main\nVAR c : C; n : INT; END_VAR\n  CASE c OF Red: n "
     ":= 1; c := "
     "Green; END_CASE;\nEND_PROGRAM\n",
     {"W0014 at 4:3"}},
    {"IntegerCaseMayLeaveOut", BODY("CASE i OF 1: j := 1; END_CASE;"), {}},
    // W0015
    {"EmptyThen", BODY("IF b THEN END_IF;"), {"W0015 at 3:4"}, lint::Level::All},
    {"EmptyThenByDefault", BODY("IF b THEN END_IF;"), {}},
    // Nothing of the lowering shows.
    {"Chart",
     "PROGRAM main\nVAR x AT %IX0.0 : BOOL; n : INT; lamp AT %QX0.0 : BOOL; END_VAR\nINITIAL_STEP A: "
     "lamp(N); "
     "work(N); END_STEP\nSTEP B: lamp(L, T#5s); END_STEP\nTRANSITION FROM A TO B := x; "
     "END_TRANSITION\nTRANSITION "
     "FROM B TO A := B.T > T#7s; END_TRANSITION\nACTION work:\n  n := n + 1;\nEND_ACTION\nEND_PROGRAM\n",
     {}},
    {"ChartAction",
     "PROGRAM main\nVAR x AT %IX0.0 : BOOL; n : INT; END_VAR\nINITIAL_STEP A: work(N); END_STEP\nTRANSITION "
     "FROM A TO "
     "A := x; END_TRANSITION\nACTION work:\n  n := n;\nEND_ACTION\nEND_PROGRAM\n",
     {"W0012 at 6:3"}},
};

class Warning : public testing::TestWithParam<WarningCase> {};

TEST_P(Warning, Check_WhenProgramIsLinted_ThenExactlyTheExpectedIsReported) {
  EXPECT_EQ(found_in(GetParam().text, GetParam().level), GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(Cases, Warning, testing::ValuesIn(kCases),
                         [](const auto& each) { return std::string(each.param.name); });

TEST(Suppression, Check_WhenAPragmaNamesTheCode_ThenTheLineIsSilent) {
  EXPECT_EQ(
      found_in("PROGRAM main\nVAR\n  x : INT; {no_warning W0003}\n  {no_warning W0003, W0006}\n  y : INT;\n"
               "  z : INT; {no_warning W0006}\n  v : INT; {no_warning}\nEND_VAR\nEND_PROGRAM\n"),
      (Found{"W0003 at 6:3"}));
}

TEST(Level, Check_WhenNone_ThenNothingIsSaid) {
  EXPECT_EQ(found_in("PROGRAM main\nVAR x : INT; END_VAR\nEND_PROGRAM\n", lint::Level::None), Found{});
}

TEST(Errors, Check_WhenTheProgramIsWrong_ThenNoWarningFollowsFromTheMistake) {
  EXPECT_EQ(found_in("PROGRAM main\nVAR x : INT; y : BOL; END_VAR\nEND_PROGRAM\n"), (Found{"E0203 at 2:18"}));
}

graphic::Rung rung(const std::string& contact, graphic::CoilKind kind, const std::string& coil) {
  graphic::Rung rung;
  rung.condition = graphic::contact(contact);
  rung.coils.push_back({kind, coil});
  return rung;
}

Found found_in(const std::vector<graphic::Rung>& rungs) {
  graphic::Project project;
  graphic::Pou pou;
  pou.name = "main";
  for (const char* name : {"start", "stop", "motor"}) {
    graphic::Variable variable;
    variable.name = name;
    variable.type = "BOOL";
    variable.initial = "FALSE";
    pou.variables.push_back(variable);
  }
  graphic::LadderProgram ladder;
  ladder.rungs = rungs;
  pou.body = ladder;
  project.pous.push_back(pou);
  driver::CompileInput input;
  input.projects.push_back(&project);
  input.lint = lint::Level::Default;
  const auto output = driver::compile(input);
  Found found;
  for (const auto& each : output ? output->warnings : output.error())
    found.push_back(each.code + " " + each.where.file + ":" + std::to_string(each.where.line));
  return found;
}

TEST(Coils, Check_WhenABitHasTwoCoils_ThenTheSecondIsNamed) {
  using graphic::CoilKind;
  EXPECT_EQ(found_in({rung("start", CoilKind::Normal, "motor"), rung("stop", CoilKind::Normal, "motor")}),
            (Found{"W0007 main.ld:2"}));
  EXPECT_EQ(found_in({rung("start", CoilKind::Set, "motor"), rung("stop", CoilKind::Reset, "motor")}),
            Found{});
}

// The library as if a user had written it (the blocks whose names are reserved cannot be, and ANY_INT is for
// the library alone).
TEST(Library, Check_WhenItIsCompiledAsAUsersText_ThenItGivesNoWarning) {
  driver::CompileInput input;
  for (const driver::LibraryText& each : driver::library_texts()) {
    const bool reserved = each.name == "library/bistables.st" || each.name == "library/counters.st" ||
                          each.name == "library/timers.st";
    std::string text(each.text);
    for (std::size_t at = text.find(": ANY_INT"); at != std::string::npos; at = text.find(": ANY_INT"))
      text.replace(at, 9, ": LINT");
    if (!reserved) input.texts.push_back({std::string(each.name), std::move(text)});
  }
  ASSERT_GT(input.texts.size(), 3u);
  input.texts.push_back({"main.st", "PROGRAM main\nEND_PROGRAM\n"});
  input.lint = lint::Level::Default;
  const auto output = driver::compile(input);
  ASSERT_TRUE(output) << to_string(output.error());
  EXPECT_TRUE(output->warnings.empty()) << to_string(output->warnings);
}

}  // namespace
