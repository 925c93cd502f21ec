// Every diagnostic of the compiler: a source that provokes it, the code and the place.

#include <gtest/gtest.h>

#include "ladder/driver/compile.h"
#include "tests/unit/ladder/driver/error_case.h"

namespace {

using stepwright::driver::compile;
using stepwright::driver::CompileInput;
using stepwright::driver_test::ErrorCase;
using stepwright::result::Diagnostics;

Diagnostics diagnostics_of(const std::string& text) {
  CompileInput input;
  input.texts.push_back({"t.st", text});
  const auto output = compile(input);
  return output ? output->warnings : output.error();
}

#define TAGGED(pragma) "PROGRAM main\nVAR x : INT;" pragma " END_VAR\nx := x + 1;\nEND_PROGRAM"

const ErrorCase kCases[] = {
    {"BadCharacter", "E0101", 3, 8, BODY("i := i ? 1;")},
    {"UnterminatedComment", "E0102", 3, 9, BODY("i := 1; (* never")},
    {"BadNumber", "E0103", 3, 6, BODY("i := 2#12;")},
    {"BadDuration", "E0103", 3, 7, BODY("tm := T#5x;")},
    {"MissingSemicolon", "E0104", 3, 7, BODY("i := 1\nj := 2;")},
    {"EqualForAssign", "E0104", 3, 3, BODY("i = 1;"), ":="},
    {"ReservedName", "E0104", 2, 5, "PROGRAM main\nVAR then : INT; END_VAR\nEND_PROGRAM", "reserved"},
    {"DoubledUnderscore", "E0101", 2, 6, "PROGRAM main\nVAR a__b : INT; END_VAR\nEND_PROGRAM", "leave"},
    {"MissingEndIf", "E0105", 3, 1, BODY("IF b THEN i := 1;")},
    {"LiteralTooLarge", "E0108", 3, 27, BODY("i := 18446744073709551615 * 18446744073709551615;")},
    {"Undeclared", "E0201", 3, 1, BODY("lmp := TRUE;"), "'lamp'"},
    {"UnknownFunction", "E0201", 3, 6, BODY("r := SQRTT(r);"), "'SQRT'"},
    {"DuplicateVariable", "E0202", 2, 14, "PROGRAM main\nVAR x : INT; x : BOOL; END_VAR\nEND_PROGRAM"},
    {"DuplicatePou", "E0202", 3, 9, "PROGRAM main\nEND_PROGRAM\nPROGRAM MAIN\nEND_PROGRAM"},
    {"StandardBlockTaken", "E0202", 1, 16,
     "FUNCTION_BLOCK TON\nEND_FUNCTION_BLOCK\nPROGRAM main\nEND_PROGRAM"},
    {"UnknownType", "E0203", 2, 9, "PROGRAM main\nVAR x : BOL; END_VAR\nEND_PROGRAM", "'BOOL'"},
    {"UnknownMember", "E0204", 3, 8, BODY("b := t.X;")},
    {"InternalMember", "E0204", 3, 8, BODY("b := t.M;")},
    {"PouAsVariable", "E0205", 3, 6, BODY("i := TON;")},
    {"BlockInItself", "E0206", 2, 9,
     "FUNCTION_BLOCK f\nVAR x : f; END_VAR\nEND_FUNCTION_BLOCK\nPROGRAM main\nEND_PROGRAM"},
    {"FunctionRecursion", "E0206", 1, 10,
     "FUNCTION f : INT\nVAR_INPUT n : INT; END_VAR\nf := f(n - 1);\nEND_FUNCTION\nPROGRAM main\nVAR x : INT; "
     "END_VAR\nx := f(3);\nEND_PROGRAM"},
    {"MissingGlobal", "E0207", 2, 14, "PROGRAM main\nVAR_EXTERNAL x : INT; END_VAR\nEND_PROGRAM"},
    {"BlockInFunction", "E0208", 2, 5,
     "FUNCTION f : INT\nVAR x : TON; END_VAR\nf := 1;\nEND_FUNCTION\nPROGRAM main\nEND_PROGRAM"},
    {"TooLarge", "E0209", 2, 9, "PROGRAM main\nVAR x : ARRAY[0..100000000] OF LREAL; END_VAR\nEND_PROGRAM"},
    {"RealToInt", "E0301", 3, 6, BODY("i := r;"), "REAL_TO_INT"},
    {"DintToInt", "E0301", 3, 6, BODY("i := d;"), "DINT_TO_INT"},
    {"IntCondition", "E0301", 3, 4, BODY("IF i THEN j := 1; END_IF;"), "<> 0"},
    {"NumberForTime", "E0301", 3, 13, BODY("t(IN:=b,PT:=5);"), "T#"},
    {"IntAnd", "E0302", 3, 8, BODY("i := i AND j;")},
    {"BoolPlus", "E0302", 3, 8, BODY("b := b + b;")},
    {"PowerOfBool", "E0302", 3, 8, BODY("r := b ** 2;")},
    {"PowerToInt", "E0301", 3, 8, BODY("i := i ** 2;"), "LREAL_TO_INT"},
    {"NegativeShift", "E0304", 3, 13, BODY("w := SHL(w, -1);"), "other way"},
    {"ShiftOfInt", "E0302", 3, 6, BODY("w := SHL(i, 1);"), "WORD#16#1"},
    {"MuxConstant", "E0308", 3, 10, BODY("i := MUX(2, i, j);"), "0 to 1"},
    {"SelOfBlock", "E0302", 3, 6, BODY("i := SEL(b, t, t);")},
    {"MaxMixed", "E0301", 3, 13, BODY("i := MAX(i, tm);")},
    {"UnknownFormal", "E0402", 3, 12, BODY("i := LIMIT(MNN := 1, IN := i, MX := 3);"), "'MN'"},
    {"OutputOfFunction", "E0402", 3, 10, BODY("i := ABS(IN => j);"), ""},
    {"UnknownConversion", "E0201", 3, 6, BODY("r := INT_TO_REEL(i);"), "'REAL'"},
    {"NoConversion", "E0301", 3, 7, BODY("tm := BOOL_TO_TIME(b);")},
    {"TruncOfInt", "E0302", 3, 6, BODY("i := TRUNC_INT(i);")},
    {"BcdOfInt", "E0302", 3, 6, BODY("i := INT_BCD_TO_INT(i);"), "LWORD"},
    {"TypedFunction", "E0301", 3, 17, BODY("i := ADD_INT(i, r);"), "REAL_TO_INT"},
    {"ChainOfTypes", "E0301", 3, 15, BODY("b := GT(3, i, tm);")},
    {"EndianOfReal", "E0302", 3, 6, BODY("r := TO_BIG_ENDIAN(r);")},
    {"ValidOfInt", "E0302", 3, 6, BODY("b := IS_VALID(i);")},
    {"TimeTimesTime", "E0302", 3, 10, BODY("tm := tm * tm;")},
    {"TypedTime", "E0301", 3, 20, BODY("tm := ADD_TIME(tm, i);")},
    {"MulTimeFactor", "E0302", 3, 7, BODY("tm := MUL_TIME(tm, tm);")},
    {"BoundNotConstant", "E0303", 2, 44,
     "PROGRAM main\nVAR n : INT; x : ARRAY[1..3] OF INT := [1, n]; END_VAR\nEND_PROGRAM"},
    {"OutOfRange", "E0304", 3, 6, BODY("i := 40000;"), "-32768"},
    {"LogOfZero", "E0304", 3, 9, BODY("r := LN(0);")},
    {"RealDivision", "E0305", 3, 10, BODY("r := r / 0.0;")},
    {"ConstantDivision", "E0305", 3, 10, BODY("i := j / 0;")},
    {"BadBounds", "E0306", 2, 15, "PROGRAM main\nVAR x : ARRAY[3..1] OF INT; END_VAR\nEND_PROGRAM"},
    {"IndexCount", "E0307", 3, 6, BODY("i := a[1, 2];")},
    {"ConstantIndex", "E0308", 3, 8, BODY("i := a[4];"), "1 to 3"},
    {"TooManyValues", "E0309", 2, 38,
     "PROGRAM main\nVAR x : ARRAY[1..2] OF INT := [1, 2, 3]; END_VAR\nEND_PROGRAM"},
    {"WriteConstant", "E0401", 3, 1,
     "PROGRAM main\nVAR CONSTANT c : INT := 1; END_VAR\nc := 2;\nEND_PROGRAM"},
    {"WriteInput", "E0401", 3, 1,
     "FUNCTION_BLOCK f\nVAR_INPUT x : INT; END_VAR\nx := 2;\nEND_FUNCTION_BLOCK\nPROGRAM main\nEND_PROGRAM"},
    {"WritePlantInput", "E0401", 3, 1,
     "PROGRAM main\nVAR x AT %IX0.0 : BOOL; END_VAR\nx := TRUE;\nEND_PROGRAM"},
    {"WriteOutputFromOutside", "E0401", 3, 3, BODY("t.Q := TRUE;")},
    {"UnknownParameter", "E0402", 3, 3, BODY("t(INN := b);"), "'IN'"},
    {"OutputWithAssign", "E0402", 3, 3, BODY("t(Q := b);"), ""},
    {"ArgumentCount", "E0403", 3, 6, BODY("r := SQRT(r, r);")},
    {"NotCallable", "E0404", 3, 1, BODY("i(3);")},
    {"DuplicateArgument", "E0405", 3, 12, BODY("t(IN := b, IN := b);")},
    {"ForReal", "E0406", 3, 5, BODY("FOR r := 1 TO 3 DO i := 1; END_FOR;")},
    {"DuplicateCase", "E0407", 5, 1, BODY("CASE i OF\n1..3: j := 1;\n2: j := 2;\nEND_CASE;")},
    {"CaseOfReal", "E0301", 3, 6, BODY("CASE r OF 1: j := 1; END_CASE;"), "IF"},
    {"ExitOutside", "E0408", 3, 1, BODY("EXIT;")},
    {"NeedsVariable", "E0409", 3, 12,
     "FUNCTION_BLOCK f\nVAR_IN_OUT x : INT; END_VAR END_FUNCTION_BLOCK PROGRAM main VAR y : f; END_VAR\n y(x "
     ":= (1 + "
     "2));\nEND_PROGRAM"},
    {"BlockResult", "E0410", 3, 6, BODY("b := t(IN := b);")},
    {"MissingInOut", "E0411", 4, 1,
     "FUNCTION_BLOCK f\nVAR_IN_OUT x : INT; END_VAR END_FUNCTION_BLOCK\nPROGRAM main VAR y : f; "
     "END_VAR\ny();\nEND_PROGRAM"},
    {"OpenAddressOfGlobal", "E0504", 2, 6, "VAR_GLOBAL\nx AT %I* : BOOL; END_VAR\nPROGRAM main\nEND_PROGRAM"},
    {"EdgeOfGlobal", "E0208", 2, 1, "VAR_GLOBAL\nx : BOOL R_EDGE; END_VAR\nPROGRAM main\nEND_PROGRAM"},
    {"ConstantBlock", "E0208", 2, 1, "VAR_GLOBAL CONSTANT\nx : TON; END_VAR\nPROGRAM main\nEND_PROGRAM"},
    {"RetainedConstant", "E0208", 2, 1,
     "VAR_GLOBAL CONSTANT RETAIN\nx : INT := 1; END_VAR\nPROGRAM main\nEND_PROGRAM"},
    {"EdgeOfMember", "E0208", 2, 5,
     "TYPE S : STRUCT\nx : BOOL R_EDGE; END_STRUCT; END_TYPE\nPROGRAM main\nEND_PROGRAM"},
    {"BoundTooLarge", "E0304", 2, 18,
     "PROGRAM main\nVAR x : ARRAY[0..18446744073709551615] OF INT; END_VAR\nEND_PROGRAM"},
    {"LargeRealWithoutType", "E0304", 3, 22, BODY("b := 'x' < TO_STRING(1.0E300);")},
    {"BadAddress", "E0501", 2, 10, "PROGRAM main\nVAR x AT %IX0.9 : BOOL; END_VAR\nEND_PROGRAM"},
    {"AddressSize", "E0502", 2, 10, "PROGRAM main\nVAR x AT %IW0 : BOOL; END_VAR\nEND_PROGRAM", "%IX"},
    {"Overlap", "W0016", 2, 37,
     "PROGRAM main\nVAR x AT %IX2.0 : BOOL; END_VAR VAR y AT %IW1 : INT; END_VAR\nEND_PROGRAM"},
    {"AddressInBlock", "E0504", 2, 10,
     "FUNCTION_BLOCK f\nVAR x AT %QX0.0 : BOOL; END_VAR\nEND_FUNCTION_BLOCK\nPROGRAM main\nEND_PROGRAM"},
    {"TwoPrograms", "E0601", 3, 9, "PROGRAM a\nEND_PROGRAM\nPROGRAM b\nEND_PROGRAM"},
    {"UnknownTask", "E0602", 5, 16,
     "PROGRAM a\nEND_PROGRAM\nCONFIGURATION c\nTASK fast(INTERVAL := T#1ms);\nPROGRAM p WITH fst : "
     "a;\nEND_CONFIGURATION",
     "'fast'"},
    {"UnknownProgram", "E0603", 5, 22,
     "PROGRAM a\nEND_PROGRAM\nCONFIGURATION c\nTASK fast(INTERVAL := T#1ms);\nPROGRAM p WITH fast: "
     "b;\nEND_CONFIGURATION"},
    {"TaskOfNoTime", "E0604", 4, 23,
     "PROGRAM a\nEND_PROGRAM\nCONFIGURATION c\nTASK fast(INTERVAL := T#0s);\nPROGRAM p WITH fast: "
     "a;\nEND_CONFIGURATION"},
    {"TwoConfigurations", "E0605", 8, 15,
     "PROGRAM a\nEND_PROGRAM\nCONFIGURATION c\nTASK f(INTERVAL := T#1ms);\nPROGRAM p WITH f: "
     "a;\nEND_CONFIGURATION\n\nCONFIGURATION d\nEND_CONFIGURATION"},
    {"UnknownStep", "E0703", 4, 23,
     "PROGRAM main\nVAR b : BOOL; END_VAR\nINITIAL_STEP S1: END_STEP\nTRANSITION FROM S1 TO S3 := b; "
     "END_TRANSITION\nEND_PROGRAM"},
    {"UnknownQualifier", "E0703", 3, 20,
     "PROGRAM main\nVAR b : BOOL; END_VAR\nINITIAL_STEP S1: b(Q); END_STEP\nTRANSITION FROM S1 TO S1 := b; "
     "END_TRANSITION\nEND_PROGRAM"},
    {"ErrorInChartAction", "E0201", 6, 3,
     "PROGRAM main\nVAR b : BOOL; END_VAR\nINITIAL_STEP S1: act(N); END_STEP\nTRANSITION FROM S1 TO S1 := b; "
     "END_TRANSITION\nACTION act:\n  missing := 1;\nEND_ACTION\nEND_PROGRAM"},
    {"ErrorInTransition", "E0301", 4, 29,
     "PROGRAM main\nVAR n : INT; END_VAR\nINITIAL_STEP S1: END_STEP\nTRANSITION FROM S1 TO S1 := n; "
     "END_TRANSITION\nEND_PROGRAM"},
    {"Unreachable", "W0001", 4, 1, BODY("RETURN;\ni := 1;")},
    {"UnusedResult", "W0002", 3, 1, BODY("ABS(i);")},
    {"ForeignCode", "W0017", 3, 9, BODY("i := 1; {j = 2;}")},
    {"ForeignCall", "W0017", 3, 1, BODY("{SetFbVar(I, 2)} i := 1;")},
    {"ForeignBlock", "W0017", 3, 1, BODY("{{ if (x) { y(); } }} i := 1;"), "in ST"},
    {"TagPragmaSemicolon", "E0110", 2, 25, TAGGED("{unit := 'l'; decimals := 1}"), "commas"},
    {"TagPragmaKey", "E0110", 2, 27, TAGGED("{unit := 'l', decimal := 1}"), "'decimals'"},
    {"TagPragmaEquals", "E0110", 2, 19, TAGGED("{unit = 'l'}"), "unit := "},
    {"TagPragmaTwice", "E0110", 2, 27, TAGGED("{unit := 'l', unit := 'm'}")},
    {"TagPragmaDecimals", "E0110", 2, 26, TAGGED("{decimals := 10}")},
    {"TagPragmaHalfDecimals", "E0110", 2, 26, TAGGED("{decimals := 1.5}")},
    {"TagPragmaRange", "E0110", 2, 23, TAGGED("{range := 5..5}"), "0..200"},
    {"TagPragmaOneEnd", "E0110", 2, 24, TAGGED("{range := 5}"), "0..200"},
    {"TagPragmaNumber", "E0110", 2, 23, TAGGED("{range := a..5}")},
    {"TagPragmaNoText", "E0110", 2, 22, TAGGED("{unit := l}"), "'l'"},
    {"TagPragmaOpenText", "E0110", 2, 22, TAGGED("{unit := 'l}"), "close"},
    {"TagPragmaEscape", "E0110", 2, 24, TAGGED("{unit := 'l$x'}"), "dollar"},
    {"TagPragmaList", "E0110", 2, 24, TAGGED("{values := 'low'}"), "['closed'"},
    {"TagPragmaInBody", "W0020", 3, 9, BODY("i := 1; {unit := 'l'}"), "VAR"},
    {"TagPragmaOfMember", "W0020", 2, 21,
     "TYPE\ns : STRUCT a : INT; {unit := 'l'} END_STRUCT;\nEND_TYPE\nPROGRAM main\nVAR x : s; END_VAR\nx.a "
     ":= 1;\nEND_PROGRAM"},
    {"TagPragmaOfInnerMember", "W0020", 2, 57,
     "PROGRAM main\nVAR x : STRUCT s : STRUCT a : INT; END_STRUCT; b : INT; {unit := 'l'} END_STRUCT; "
     "END_VAR\n"
     "x.b := x.s.a;\nEND_PROGRAM"},
    {"TagPragmaOfInstance", "W0020", 2, 5,
     "PROGRAM main\nVAR t : TON; {unit := 'l'} END_VAR\nt(IN := TRUE);\nEND_PROGRAM", "[tags]"},
    {"TagPragmaOfInstances", "W0020", 2, 5,
     "PROGRAM main\nVAR t : ARRAY[0..1] OF TON; {group := 'g'} END_VAR\nt[0](IN := TRUE);\nEND_PROGRAM",
     "[tags]"},
    {"TagPragmaOfStructure", "W0020", 2, 5,
     "PROGRAM main\nVAR x : STRUCT a : INT; END_STRUCT; {unit := 'l'} END_VAR\nx.a := x.a + 1;\nEND_PROGRAM"},
    {"TagPragmaOfTemp", "W0020", 2, 10,
     "PROGRAM main\nVAR_TEMP x : INT; {unit := 'l'} END_VAR VAR y : INT; END_VAR\nx := 1;\ny := y + "
     "x;\nEND_PROGRAM"},
    {"TagPragmaOfExternal", "W0020", 3, 14,
     "VAR_GLOBAL x : INT; {unit := 'm'} END_VAR\nPROGRAM main\nVAR_EXTERNAL x : INT; {unit := 'l'} "
     "END_VAR\nx := x + 1;\nEND_PROGRAM",
     "VAR_GLOBAL"},
    {"TagPragmaInFunction", "W0020", 2, 11,
     "FUNCTION f : INT\nVAR_INPUT x : INT; {unit := 'l'} END_VAR\nf := x;\nEND_FUNCTION\nPROGRAM "
     "main\nVAR y : INT; END_VAR\ny := f(y);\nEND_PROGRAM"},
    {"TagPragmaNamesOfBool", "W0020", 2, 5,
     "PROGRAM main\nVAR x : BOOL; {values := ['a', 'b', 'c']} END_VAR\nx := NOT x;\nEND_PROGRAM"},
    {"TagPragmaNamesOfReal", "W0020", 2, 5,
     "PROGRAM main\nVAR x : ARRAY[0..1] OF REAL; {values := ['a', 'b']} END_VAR\nx[0] := x[0] + "
     "1.0;\nEND_PROGRAM"},
    {"TagPragmaNearly", "W0020", 2, 13, TAGGED("{units := 'l'}"), "'unit'"},
    {"ForeignBlockOpen", "E0102", 3, 9, BODY("i := 1; {{ if (x) { y(); }"), "}}"},
};

std::vector<ErrorCase> all_cases() {
  std::vector<ErrorCase> cases(std::begin(kCases), std::end(kCases));
  for (const auto more :
       {stepwright::driver_test::type_error_cases(), stepwright::driver_test::configuration_error_cases(),
        stepwright::driver_test::text_error_cases(), stepwright::driver_test::habit_error_cases(),
        stepwright::driver_test::test_error_cases()})
    cases.insert(cases.end(), more.begin(), more.end());
  return cases;
}

class CompileError : public testing::TestWithParam<ErrorCase> {};

TEST_P(CompileError, Compile_WhenSourceIsWrong_ThenOneDiagnosticSaysWhere) {
  const ErrorCase& expected = GetParam();
  const Diagnostics found = diagnostics_of(expected.text);
  ASSERT_EQ(found.size(), 1u) << to_string(found);
  EXPECT_EQ(found[0].code, expected.code) << to_string(found);
  EXPECT_EQ(found[0].where.file, "t.st");
  EXPECT_EQ(found[0].where.line, expected.line) << to_string(found);
  EXPECT_EQ(found[0].where.column, expected.column) << to_string(found);
  EXPECT_FALSE(found[0].message.empty());
  if (expected.hint != nullptr) {
    EXPECT_NE(found[0].hint.find(expected.hint), std::string::npos) << to_string(found);
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, CompileError, testing::ValuesIn(all_cases()),
                         [](const auto& each) { return each.param.name; });

TEST(Recovery, Compile_WhenSeveralMistakes_ThenEachIsReportedOnce) {
  const Diagnostics found = diagnostics_of(
      "PROGRAM main\nVAR x : INT; y : BOL; END_VAR\n"
      "x := ;\nIF x > THEN x := 1; END_IF;\ny := 3;\ny := y + 1;\nFOR x := 1 TO DO x := 2; END_FOR;\n"
      "zz := 1;\nx := x + zz;\nEND_PROGRAM\n");
  std::vector<std::uint32_t> lines;
  for (const auto& each : found) lines.push_back(each.where.line);
  EXPECT_EQ(lines, (std::vector<std::uint32_t>{2, 3, 4, 7, 8})) << to_string(found);
}

TEST(Recovery, Compile_WhenAPouIsBroken_ThenTheOthersAreStillChecked) {
  const Diagnostics found = diagnostics_of(
      "FUNCTION_BLOCK a\nVAR x : INT END_VAR\nx := 1;\nEND_FUNCTION_BLOCK\n"
      "PROGRAM main\nVAR b : BOOL; END_VAR\nb := 5;\nEND_PROGRAM\n");
  ASSERT_EQ(found.size(), 2u) << to_string(found);
  EXPECT_EQ(found[0].where.line, 2u);
  EXPECT_EQ(found[1].where.line, 7u);
}

TEST(Recovery, Compile_WhenATestIsBroken_ThenTheOthersAreStillChecked) {
  const Diagnostics found = diagnostics_of(
      "TEST 'one'\nVAR x : INT END_VAR\nx := ;\nEND_TEST\n"
      "TEST 'two'\nIF TRUE THEN ASSERT_EQ(1, 1);\n"
      "TEST 'three'\nVAR y : INT;\n"
      "TEST 'four'\nASSERT_TRUE(5);\nmain.n := TRUE;\nEND_TEST\n"
      "PROGRAM main\nVAR n : BOOL; END_VAR\nn := 5;\nEND_PROGRAM\n");
  std::vector<std::uint32_t> lines;
  for (const auto& each : found) lines.push_back(each.where.line);
  EXPECT_EQ(lines, (std::vector<std::uint32_t>{2, 3, 6, 8, 10, 15})) << to_string(found);
}

TEST(Recovery, Compile_WhenTheTextIsCutAnywhere_ThenItEndsWithDiagnostics) {
  const std::string text =
      "TYPE C : (A, B); S : STRUCT x : INT; END_STRUCT END_TYPE\nFUNCTION f : INT VAR_INPUT a : INT; END_VAR "
      "f := a; "
      "END_FUNCTION\nPROGRAM main VAR t : TON; s : S; b : BOOL; i : INT; END_VAR t(IN := b, PT := T#1s); "
      "CASE i OF 1: b := TRUE; "
      "ELSE i := f(2); END_CASE; FOR i := 1 TO 3 BY 1 DO s.x := i; END_FOR; REPEAT i := 1; UNTIL b "
      "END_REPEAT; "
      "END_PROGRAM";
  ASSERT_TRUE(diagnostics_of(text).empty()) << to_string(diagnostics_of(text));
  for (std::size_t length = 0; length + 12 < text.size(); ++length)
    EXPECT_FALSE(diagnostics_of(text.substr(0, length)).empty()) << text.substr(0, length);
}

}  // namespace
