#include "tests/unit/ladder/driver/error_case.h"

namespace stepwright::driver_test {

namespace {

// The body of a test beside a function, a block and a program that runs.
#define IN_TEST(statements)                                                                                \
  "FUNCTION f : INT VAR_INPUT n : INT; END_VAR f := n; END_FUNCTION FUNCTION_BLOCK fb VAR_INPUT x : INT; " \
  "END_VAR VAR_TEMP t : INT; END_VAR VAR CONSTANT k : INT := 1; END_VAR t := x; END_FUNCTION_BLOCK\n"      \
  "PROGRAM main VAR level : INT; END_VAR level := level + 1; END_PROGRAM\n"                                \
  "TEST 't' VAR i : INT; b : BOOL; s : STRING; w : WSTRING; r : REAL; block : fb; tm : TIME; "             \
  "END_VAR\n" statements "\nEND_TEST\n"

constexpr ErrorCase kCases[] = {
    {"AssertInProgram", "E0901", 3, 1, BODY("ASSERT_TRUE(b);"), "TEST"},
    {"AdvanceInProgram", "E0901", 3, 16, BODY("IF b THEN i := ADVANCE_TIME(T#1s); END_IF;"), "TEST"},
    {"ScansInBlock", "E0901", 2, 1,
     "FUNCTION_BLOCK f\nRUN_SCANS(1);\nEND_FUNCTION_BLOCK\nPROGRAM main\nEND_PROGRAM"},
    {"ScansHaveNoResult", "E0410", 4, 6, IN_TEST("i := RUN_SCANS(1);")},
    {"AssertOfInteger", "E0301", 4, 13, IN_TEST("ASSERT_TRUE(i);"), "<> 0"},
    {"AssertTooFew", "E0403", 4, 1, IN_TEST("ASSERT_EQ(i);"), "ASSERT_EQ(ACTUAL, EXPECTED[, MESSAGE])"},
    {"AssertTooMany", "E0403", 4, 28, IN_TEST("ASSERT_EQ(i, 1, 'message', 2);"), "MESSAGE"},
    {"AssertUnknownFormal", "E0402", 4, 14, IN_TEST("ASSERT_EQ(i, wanted := 1);"), "EXPECTED"},
    {"AssertTwice", "E0405", 4, 24, IN_TEST("ASSERT_EQ(i, ACTUAL := 1);")},
    {"AssertMixed", "E0302", 4, 14, IN_TEST("ASSERT_EQ(i, s);")},
    {"AssertOrderOfReferences", "E0302", 4, 19, IN_TEST("ASSERT_LT(REF(i), REF(i));")},
    {"AssertBlock", "E0302", 4, 18, IN_TEST("ASSERT_EQ(block, block);")},
    {"AssertNearOfText", "E0302", 4, 1, IN_TEST("ASSERT_NEAR(s, 's', 1);"), "three numbers"},
    {"AssertNearOfTimes", "E0302", 4, 1, IN_TEST("ASSERT_NEAR(tm, T#1s, 5);"), "TIME"},
    {"AssertWideMessage", "E0301", 4, 16, IN_TEST("ASSERT_TRUE(b, w);"), "WSTRING_TO_STRING"},
    {"AssertLiteralTooLarge", "E0302", 4, 14, IN_TEST("ASSERT_EQ(b, 2);")},
    {"AdvanceByNumber", "E0301", 4, 14, IN_TEST("ADVANCE_TIME(5);"), "T#"},
    {"ScansByReal", "E0301", 4, 11, IN_TEST("RUN_SCANS(r);"), "REAL_TO_LINT"},
    {"AssertWithEnable", "E0402", 4, 1, IN_TEST("ASSERT_TRUE(EN := b, b);")},
    {"UnknownInstanceMember", "E0204", 4, 6, IN_TEST("main.levl := 1;"), "'level'"},
    {"WriteConstantOfInstance", "E0401", 4, 7, IN_TEST("block.k := 2;")},
    {"ReadTemporaryOfInstance", "E0204", 4, 12, IN_TEST("i := block.t;"), "copy"},
    {"JumpFromTest", "E0104", 4, 1, IN_TEST("JMP label;")},
    {"TestInput", "E0208", 1, 20, "TEST 't' VAR_INPUT x : INT; END_VAR END_TEST PROGRAM main END_PROGRAM",
     ""},
    {"TestTemporary", "E0208", 1, 19, "TEST 't' VAR_TEMP x : INT; END_VAR END_TEST PROGRAM main END_PROGRAM"},
    {"TestWithoutName", "E0104", 1, 6, "TEST ''\nEND_TEST\nPROGRAM main\nEND_PROGRAM", "what it shows"},
    {"TestWithWideName", "E0104", 1, 6, "TEST \"a\"\nEND_TEST\nPROGRAM main\nEND_PROGRAM", "TEST '"},
    {"TestWithoutEnd", "E0105", 1, 1, "TEST 'a'\nPROGRAM main\nEND_PROGRAM"},
    {"TestTwice", "E0202", 3, 6, "TEST 'a'\nEND_TEST\nTEST 'a'\nEND_TEST\nPROGRAM main\nEND_PROGRAM",
     "t.st:1"},
    {"EndTestAlone", "E0104", 3, 1, "PROGRAM main\nEND_PROGRAM\nEND_TEST"},
    {"ProgramTypeInProgram", "E0203", 2, 9,
     "PROGRAM a\nVAR x : b; END_VAR\nEND_PROGRAM\nPROGRAM b\nEND_PROGRAM\n"
     "CONFIGURATION c TASK t(INTERVAL := T#1s); PROGRAM p WITH t : a; END_CONFIGURATION"},
    {"MockOfNothing", "E0902", 3, 15, "PROGRAM main\nEND_PROGRAM\nMOCK FUNCTION g : INT\nEND_MOCK",
     "standard functions"},
    {"MockOfOtherKind", "E0902", 3, 21,
     "FUNCTION g : INT\ng := 1; END_FUNCTION\nMOCK FUNCTION_BLOCK g\nEND_MOCK\nPROGRAM main\nEND_PROGRAM"},
    {"MockLacksInput", "E0902", 3, 15,
     "FUNCTION g : INT VAR_INPUT a : INT; END_VAR\ng := a; END_FUNCTION\nMOCK FUNCTION g : "
     "INT\nEND_MOCK\nPROGRAM main\n"
     "END_PROGRAM"},
    {"MockOfOtherType", "E0902", 3, 33,
     "FUNCTION g : INT VAR_INPUT a : INT; END_VAR\ng := a; END_FUNCTION\nMOCK FUNCTION g : INT VAR_INPUT a : "
     "DINT; END_VAR\n"
     "END_MOCK\nPROGRAM main\nEND_PROGRAM"},
    {"MockOfOtherResult", "E0902", 3, 15,
     "FUNCTION g : INT\ng := 1; END_FUNCTION\nMOCK FUNCTION g : DINT\nEND_MOCK\nPROGRAM main\nEND_PROGRAM"},
    {"MockTwice", "E0202", 5, 15,
     "FUNCTION g : INT\ng := 1; END_FUNCTION\nMOCK FUNCTION g : INT\nEND_MOCK\nMOCK FUNCTION g : "
     "INT\nEND_MOCK\nPROGRAM main\n"
     "END_PROGRAM"},
    {"MockBodyIsWrong", "E0201", 4, 6,
     "FUNCTION g : INT\ng := 1; END_FUNCTION\nMOCK FUNCTION g : INT\ng := x;\nEND_MOCK\nPROGRAM "
     "main\nEND_PROGRAM"},
};

#undef IN_TEST

}  // namespace

std::span<const ErrorCase> test_error_cases() {
  return kCases;
}

}  // namespace stepwright::driver_test
