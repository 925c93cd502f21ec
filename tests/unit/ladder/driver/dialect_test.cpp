// What a dialect permits: it runs there with the right value, and the standard refuses it with one error that
// names the dialect.

#include "ladder/source/dialect.h"

#include <gtest/gtest.h>

#include "tests/support/compiled_program.h"

namespace {

using namespace stepwright;

struct Permitted {
  const char* name;
  const char* dialect;
  std::int64_t value;  // of main.x after one scan
  const char* code;    // what the standard says, and where
  std::uint32_t line;
  const char* text;
};

void PrintTo(const Permitted& permitted, std::ostream* out) {
  *out << permitted.name;
}

driver::CompileInput input_of(const std::string& text, const source::Dialect& dialect) {
  driver::CompileInput input;
  input.texts.push_back({"Motors.st", text});
  input.dialect = &dialect;
  return input;
}

const Permitted kPermitted[] = {
    {"InputOfAProgram", "matiec", 4, "E0401", 3,
     "PROGRAM main\nVAR_INPUT k : INT := 3; END_VAR VAR x : INT; END_VAR\nk := k + 1;\nx := k;\nEND_PROGRAM"},
    {"InputOfABlock", "codesys", 30, "E0401", 3,
     "FUNCTION_BLOCK f\nVAR_INPUT n : INT; END_VAR VAR_OUTPUT q : INT; END_VAR\nn := 3 * n;\nq := n;\n"
     "END_FUNCTION_BLOCK\nPROGRAM main\nVAR b : f; x : INT; END_VAR\nb(n := 10, q => x);\nEND_PROGRAM"},
    {"InputOfAFunction", "matiec", 30, "E0401", 3,
     "FUNCTION f : INT\nVAR_INPUT n : INT; END_VAR\nn := 3 * n;\nf := n;\nEND_FUNCTION\n"
     "PROGRAM main\nVAR x : INT; END_VAR\nx := f(10);\nEND_PROGRAM"},
    // The caller's array is not written: 1 + 5.
    {"InputThatIsAnArray", "matiec", 6, "E0401", 3,
     "FUNCTION f : INT\nVAR_INPUT a : ARRAY[1..2] OF INT; END_VAR\na[1] := 5;\nf := a[1];\nEND_FUNCTION\n"
     "PROGRAM main\nVAR list : ARRAY[1..2] OF INT := [1, 2]; x : INT; END_VAR\nx := f(list) + "
     "list[1];\nEND_PROGRAM"},
    {"DottedEnumerator", "codesys", 7, "E0205", 4,
     "TYPE Color : (Red, Green := 7); END_TYPE\nPROGRAM main\nVAR c : Color; x : INT; END_VAR\nc := "
     "Color.Green;\n"
     "x := TO_INT(c);\nEND_PROGRAM"},
    {"DottedLabel", "codesys", 2, "E0205", 5,
     "TYPE Color : (Red, Green := 7); END_TYPE\nPROGRAM main\nVAR c : Color := Green; x : INT; END_VAR\nCASE "
     "c OF\n"
     "Color.Green: x := 2;\nEND_CASE;\nEND_PROGRAM"},
    {"QualifiedByTheFile", "codesys", 5, "E0201", 4,
     "VAR_GLOBAL speed : INT := 5; END_VAR\nPROGRAM main\nVAR x : INT; END_VAR\nx := "
     "Motors.speed;\nEND_PROGRAM"},
    {"QualifiedConstant", "codesys", 5, "E0201", 4,
     "VAR_GLOBAL CONSTANT speed : INT := 5; END_VAR\nPROGRAM main\nVAR x : INT; END_VAR\nx := Motors.speed;\n"
     "END_PROGRAM"},
    {"WordPlusInteger", "codesys", 0xFFFE, "E0302", 3,
     "PROGRAM main\nVAR w : WORD := 16#FFFF; i : INT := -1; x : WORD; END_VAR\nx := w + i;\nEND_PROGRAM"},
    {"DwordPlusInteger", "codesys", 9, "E0302", 3,
     "PROGRAM main\nVAR w : DWORD := 10; i : INT := -1; x : DWORD; END_VAR\nx := w + i;\nEND_PROGRAM"},
    {"ByteTimesLiteral", "codesys", 44, "E0302", 3,
     "PROGRAM main\nVAR b : BYTE := 100; x : BYTE; END_VAR\nx := b * 3;\nEND_PROGRAM"},
    {"WordBesideInteger", "codesys", 1, "E0302", 3,
     "PROGRAM main\nVAR w : WORD := 16#FFFF; i : INT := -1; x : BOOL; END_VAR\nx := w > i;\nEND_PROGRAM"},
    {"WordIntoInteger", "codesys", -1, "E0301", 3,
     "PROGRAM main\nVAR w : WORD := 16#FFFF; x : INT; END_VAR\nx := w;\nEND_PROGRAM"},
    {"BitOfAnInteger", "codesys", 5, "E0302", 3,
     "PROGRAM main\nVAR x : INT := 1; END_VAR\nx.2 := x.0;\nEND_PROGRAM"},
    {"SignOfATemporary", "codesys", -32767, "E0302", 4,
     "PROGRAM main\nVAR x : INT; END_VAR VAR_TEMP t : INT; END_VAR\nt := 1;\nt.15 := TRUE; x := "
     "t;\nEND_PROGRAM"},
    {"ByteTimesReal", "codesys", 300, "E0302", 3,
     "PROGRAM main\nVAR b : BYTE := 200; r : REAL := 1.5; x : REAL; END_VAR\nx := b * r;\nEND_PROGRAM"},
    // The literal needs more bits than the WORD has: 6e9 in 32 bits.
    {"WordTimesLargeLiteral", "codesys", 1705032704, "E0302", 3,
     "PROGRAM main\nVAR w : WORD := 60000; x : DWORD; END_VAR\nx := w * 100000;\nEND_PROGRAM"},
    {"WordPlusNegativeLiteral", "codesys", 0xFFFF, "E0302", 3,
     "PROGRAM main\nVAR w : WORD := 5; x : WORD; END_VAR\nx := w + (-6);\nEND_PROGRAM"},
    {"WordBesideNegativeLiteral", "codesys", 1, "E0302", 3,
     "PROGRAM main\nVAR w : WORD := 5; x : BOOL; END_VAR\nx := w > -1;\nEND_PROGRAM"},
    {"LargestOfBoth", "codesys", 200, "E0301", 3,
     "PROGRAM main\nVAR b : BYTE := 200; i : INT := -3; x : INT; END_VAR\nx := MAX(b, i);\nEND_PROGRAM"},
    {"LogicOnAnInteger", "codesys", 0x34, "E0302", 3,
     "PROGRAM main\nVAR i : INT := 16#1234; x : INT; END_VAR\nx := i AND 16#FF;\nEND_PROGRAM"},
    {"SignInWiderBits", "codesys", 0xFFFFFFFE, "E0302", 3,
     "PROGRAM main\nVAR i : INT := -2; w : DWORD := 16#FFFFFFFF; x : DWORD; END_VAR\nx := w AND "
     "i;\nEND_PROGRAM"},
    {"ComplementOfAnInteger", "codesys", -6, "E0302", 3,
     "PROGRAM main\nVAR i : INT := 5; x : INT; END_VAR\nx := NOT i;\nEND_PROGRAM"},
    {"ShiftOfAnInteger", "codesys", 12, "E0302", 3,
     "PROGRAM main\nVAR u : UINT := 3; x : UINT; END_VAR\nx := SHL(u, 2);\nEND_PROGRAM"},
    {"IndexOfBits", "codesys", 8, "E0301", 3,
     "PROGRAM main\nVAR b : BYTE := 2; a : ARRAY[1..2] OF INT := [7, 8]; x : INT; END_VAR\nx := "
     "a[b];\nEND_PROGRAM"},
    {"RootOfBits", "codesys", 15, "E0302", 3,
     "PROGRAM main\nVAR b : BYTE := 225; x : REAL; END_VAR\nx := SQRT(b);\nEND_PROGRAM"},
    {"TimesBits", "codesys", 6000000, "E0302", 3,
     "PROGRAM main\nVAR b : BYTE := 3; x : TIME; END_VAR\nx := T#2ms * b;\nEND_PROGRAM"},
    {"Pointer", "codesys", 7, "E0104", 2,
     "PROGRAM main\nVAR p : POINTER TO INT; y : INT := 7; x : INT; END_VAR\np := ADR(y);\n"
     "IF p <> 0 THEN x := p^; END_IF;\np := 0;\nEND_PROGRAM"},
    {"VariableOfABlock", "matiec", 9, "E0204", 6,
     "FUNCTION_BLOCK f\nVAR n : INT := 4; END_VAR VAR_OUTPUT q : INT; END_VAR\nq := n;\nEND_FUNCTION_BLOCK\n"
     "PROGRAM main VAR b : f; x : INT; END_VAR\nb.n := 5;\nb();\nx := b.q + 4;\nEND_PROGRAM"},
    {"SmallerThanItsAddress", "matiec", 5, "E0502", 2,
     "PROGRAM main\nVAR a AT %ML1 : DWORD; END_VAR\nVAR b AT %MD2 : DWORD; x : DWORD; END_VAR\na := 5;\nx := "
     "b;\n"
     "END_PROGRAM"},
    {"EndIfWithoutSemicolon", "codesys", 6, "E0104", 4,
     "PROGRAM main\nVAR x : INT; i : INT; END_VAR\nFOR i := 1 TO 3 DO\nIF i > 0 THEN x := x + i; "
     "END_IF\nEND_FOR\n"
     "END_PROGRAM"},
    {"RealToWord", "matiec", 4, "E0301", 3,
     "PROGRAM main\nVAR r : REAL := 3.6; x : WORD; END_VAR\nx := REAL_TO_WORD(r);\nEND_PROGRAM"},
    {"WordToReal", "codesys", 65535, "E0301", 3,
     "PROGRAM main\nVAR w : WORD := 16#FFFF; x : REAL; END_VAR\nx := WORD_TO_REAL(w);\nEND_PROGRAM"},
    {"DoubleQuotes", "matiec", 3, "E0301", 2,
     "PROGRAM main\nVAR s : STRING := \"abc\"; x : INT; END_VAR\nx := LEN(s);\nEND_PROGRAM"},
};

class Dialects : public testing::TestWithParam<Permitted> {};

TEST_P(Dialects, WhenItIsPermitted_ThenItRunsWithTheRightValue) {
  const source::Dialect* dialect = source::find_dialect(GetParam().dialect);
  ASSERT_NE(dialect, nullptr);
  support::CompiledProgram program(input_of(GetParam().text, *dialect));
  EXPECT_FALSE(program.scan().trap);
  EXPECT_EQ(program.get("main.x"), GetParam().value);
}

TEST_P(Dialects, WhenTheSourceIsStandard_ThenOneErrorNamesTheDialect) {
  const auto output = driver::compile(input_of(GetParam().text, source::standard_dialect()));
  ASSERT_FALSE(output);
  const result::Diagnostics& found = output.error();
  EXPECT_EQ(found[0].code, GetParam().code) << to_string(found);
  EXPECT_EQ(found[0].where.line, GetParam().line) << to_string(found);
  EXPECT_NE(found[0].hint.find("--dialect "), std::string::npos) << to_string(found);
  EXPECT_NE(found[0].hint.find(GetParam().dialect), std::string::npos) << to_string(found);
}

INSTANTIATE_TEST_SUITE_P(Sources, Dialects, testing::ValuesIn(kPermitted),
                         [](const auto& each) { return each.param.name; });

TEST(Dialect, WhenAnInputIsWritten_ThenAWarningSaysSo) {
  const auto output = driver::compile(input_of(kPermitted[0].text, *source::find_dialect("matiec")));
  ASSERT_TRUE(output);
  ASSERT_EQ(output->warnings.size(), 1u);
  EXPECT_EQ(output->warnings[0].code, "W0019");
}

TEST(Dialect, WhenAnInputSensesAnEdge_ThenNoDialectLetsItBeWritten) {
  const auto output = driver::compile(input_of(
      "FUNCTION_BLOCK f\nVAR_INPUT n : BOOL R_EDGE; END_VAR\nn := TRUE;\nEND_FUNCTION_BLOCK\nPROGRAM main\n"
      "VAR b : f; END_VAR\nb();\nEND_PROGRAM",
      *source::find_dialect("codesys")));
  ASSERT_FALSE(output);
  EXPECT_EQ(output.error()[0].code, "E0401");
  EXPECT_EQ(output.error()[0].hint.find("--dialect"), std::string::npos);
}

TEST(Dialect, WhenALibraryIsChecked_ThenItNeedsNoProgram) {
  driver::CompileInput input =
      input_of("FUNCTION twice : INT\nVAR_INPUT n : INT; END_VAR\ntwice := 2 * n;\nEND_FUNCTION",
               source::standard_dialect());
  EXPECT_FALSE(driver::compile(input));
  input.library = true;
  const auto output = driver::compile(input);
  ASSERT_TRUE(output) << to_string(output.error());
  EXPECT_TRUE(output->container.empty());
  input.texts[0].text = "FUNCTION twice : INT\nVAR_INPUT n : INT; END_VAR\ntwice := 2 * m;\nEND_FUNCTION";
  EXPECT_FALSE(driver::compile(input));
}

}  // namespace
