#include "tests/unit/ladder/driver/error_case.h"

namespace stepwright::driver_test {

namespace {

constexpr ErrorCase kCases[] = {
    {"ElseIfInTwoWords", "E0105", 4, 1, BODY("IF b THEN i := 1;\nELSE IF i > 3 THEN i := 2;\nEND_IF;"),
     "ELSIF"},
    {"Elseif", "E0104", 4, 1, BODY("IF b THEN i := 1;\nELSEIF i > 3 THEN i := 2;\nELSE i := 3;\nEND_IF;"),
     "ELSIF"},
    {"Elif", "E0104", 4, 1, BODY("IF b THEN i := 1;\nELIF i > 3 THEN i := 2;\nEND_IF;"), "ELSIF"},
    {"AssignmentInIf", "E0104", 3, 6, BODY("IF i := 5 THEN b := TRUE; END_IF;"), "'='"},
    {"AssignmentInElsif", "E0104", 3, 36,
     BODY("IF b THEN b := FALSE; ELSIF b OR i := 5 THEN b := TRUE; END_IF;"), "'='"},
    {"AssignmentInWhile", "E0104", 3, 9, BODY("WHILE i := 5 DO i := 1; END_WHILE;"), "'='"},
    {"AssignmentInUntil", "E0104", 3, 24, BODY("REPEAT i := 1; UNTIL i := 5 END_REPEAT;"), "'='"},
    {"AssignmentInParentheses", "E0104", 3, 9, BODY("b := (i := 3);"), "'='"},
    {"ArrowInIf", "E0104", 3, 6, BODY("IF i => 5 THEN b := TRUE; END_IF;"), "'>='"},
    {"DurationWithoutPrefix", "E0103", 3, 19, BODY("t(IN := b, PT  := 5s);"), "T#5s"},
    {"CompoundDuration", "E0103", 3, 7, BODY("tm := 1h30m;"), "T#1h30m"},
    {"ArrayCalled", "E0404", 3, 6, BODY("i := a(3);"), "a[...]"},
    {"ArrayCalledWritten", "E0409", 3, 1, BODY("a(3) := 4;"), "a[...]"},
    {"TextCalled", "E0404", 2, 52,
     "PROGRAM main\nVAR s : STRING; c : CHAR; END_VAR VAR END_VAR c := s(1);\nEND_PROGRAM", "s[...]"},
    {"DoubleEqual", "E0101", 3, 8, BODY("b := i == 5;"), "'='"},
    {"DoubleEqualAssigns", "E0101", 3, 3, BODY("i == 5;"), "'='"},
    {"ExclamationEqual", "E0101", 3, 8, BODY("b := i != 5;"), "'<>'"},
    {"DoubleAmpersand", "E0101", 3, 8, BODY("b := b && lamp;"), "AND"},
    {"DoubleBar", "E0101", 3, 8, BODY("b := b || lamp;"), "OR"},
    {"Exclamation", "E0101", 3, 6, BODY("b := !lamp;"), "NOT"},
    {"Percent", "E0101", 3, 8, BODY("i := j % 3;"), "MOD"},
    {"PlusEqual", "E0101", 3, 3, BODY("i += 5;"), "x := x + ..."},
    {"MinusEqual", "E0101", 3, 3, BODY("i -= 5;"), "x := x - ..."},
    {"TimesEqual", "E0101", 3, 3, BODY("i *= 5;"), "x := x * ..."},
    {"OverEqual", "E0101", 3, 3, BODY("i /= 5;"), "x := x / ..."},
    {"PlusPlus", "E0104", 3, 2, BODY("i++;"), "x := x + 1"},
    {"MinusMinus", "E0104", 3, 2, BODY("i--;"), "x := x - 1"},
    {"InputWritten", "E0401", 3, 1, "PROGRAM main\nVAR_INPUT k : INT; END_VAR\nk := 3;\nEND_PROGRAM",
     "copy it"},
    {"PlantInputWritten", "E0401", 3, 1, BODY("%IX0.3 := TRUE;"), "%Q"},
    {"NamedPlantInputWritten", "E0401", 3, 1,
     "PROGRAM main\nVAR x AT %IX0.0 : BOOL; END_VAR\nx := TRUE;\nEND_PROGRAM", "%Q"},
    {"OutputOfABlockWritten", "E0401", 3, 3, BODY("t.Q := TRUE;"), "inputs"},
    {"ConstantWritten", "E0401", 3, 1,
     "PROGRAM main\nVAR CONSTANT k : INT := 1; END_VAR\nk := 3;\nEND_PROGRAM", "without CONSTANT"},
    {"Method", "E0107", 3, 1,
     "FUNCTION_BLOCK fb\nVAR x : INT; END_VAR\nMETHOD PUBLIC go : INT\nVAR_INPUT a : INT; END_VAR\ngo := "
     "a;\nEND_METHOD\nx := 1;\nEND_FUNCTION_BLOCK\nPROGRAM main\nVAR f : fb; END_VAR\nf();\nEND_PROGRAM",
     "function block with inputs"},
    {"MethodBehindTheBody", "E0107", 4, 1,
     "FUNCTION_BLOCK fb\nVAR x : INT; END_VAR\nx := 1;\nMETHOD go\nx := 2;\nEND_METHOD\nEND_FUNCTION_BLOCK\n"
     "PROGRAM main\nVAR f : fb; END_VAR\nf();\nEND_PROGRAM"},
    {"Property", "E0107", 2, 1,
     "FUNCTION_BLOCK fb\nPROPERTY p : INT\nGET p := 1; END_GET\nEND_PROPERTY\nVAR x : INT; END_VAR\nx := 1;\n"
     "END_FUNCTION_BLOCK\nPROGRAM main\nVAR f : fb; END_VAR\nf();\nEND_PROGRAM"},
    {"Extends", "E0107", 1, 19,
     "FUNCTION_BLOCK fb EXTENDS base\nVAR x : INT; END_VAR\nx := 1;\nEND_FUNCTION_BLOCK\nPROGRAM main\nVAR f "
     ": fb; "
     "END_VAR\nf();\nEND_PROGRAM"},
    {"Implements", "E0107", 1, 19,
     "FUNCTION_BLOCK fb IMPLEMENTS one, other\nVAR x : INT; END_VAR\nx := 1;\nEND_FUNCTION_BLOCK\nPROGRAM "
     "main\nVAR f "
     ": fb; END_VAR\nf();\nEND_PROGRAM"},
    {"AbstractBlock", "E0107", 1, 16,
     "FUNCTION_BLOCK ABSTRACT fb\nVAR x : INT; END_VAR\nx := 1;\nEND_FUNCTION_BLOCK\nPROGRAM main\nVAR f : "
     "fb; "
     "END_VAR\nf();\nEND_PROGRAM"},
    {"Interface", "E0107", 1, 1,
     "INTERFACE I\nMETHOD go : INT END_METHOD\nEND_INTERFACE\nPROGRAM main\nEND_PROGRAM"},
    {"Class", "E0107", 1, 1,
     "CLASS C\nVAR x : INT; END_VAR\nMETHOD PUBLIC go : INT go := 1; END_METHOD\nEND_CLASS\nPROGRAM "
     "main\nEND_PROGRAM"},
    {"PrivateVariables", "E0107", 2, 5, "PROGRAM main\nVAR PRIVATE x : INT; END_VAR\nx := 1;\nEND_PROGRAM"},
    {"This", "E0107", 3, 6, BODY("i := THIS^.x;"), "as they are"},
};

}  // namespace

std::span<const ErrorCase> habit_error_cases() {
  return kCases;
}

}  // namespace stepwright::driver_test
