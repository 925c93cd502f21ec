#include "tests/unit/ladder/driver/error_case.h"

namespace stepwright::driver_test {

namespace {

// The body of a program with strings.
#define TEXTS(statements)                                                                                   \
  "FUNCTION f : BOOL\nVAR_IN_OUT x : STRING; END_VAR\nVAR_INPUT n : INT; c : CHAR; END_VAR\nEND_FUNCTION\n" \
  "PROGRAM main\nVAR s, t : STRING[10]; w : WSTRING; c : CHAR; wc : WCHAR; i : INT; b : BOOL; r : REF_TO "  \
  "CHAR; "                                                                                                  \
  "END_VAR\n" statements "\nEND_PROGRAM\n"

constexpr ErrorCase kCases[] = {
    {"TextIntoInteger", "E0301", 7, 6, TEXTS("i := 'text';"), "TO_INT"},
    {"IntegerIntoText", "E0301", 7, 6, TEXTS("s := i;"), "TO_STRING"},
    {"LiteralIntoText", "E0301", 7, 6, TEXTS("s := 5;")},
    {"NarrowIntoWide", "E0301", 7, 6, TEXTS("w := 'a';"), "double quotes"},
    {"WideIntoNarrow", "E0301", 7, 6, TEXTS("s := w;"), "WSTRING_TO_STRING"},
    {"WideLiteralTyped", "E0301", 7, 6, TEXTS("w := WSTRING#'a';"), "double quotes"},
    {"TextIntoCharacter", "E0301", 7, 6, TEXTS("c := s;"), "TO_CHAR"},
    {"LongLiteralIntoCharacter", "E0301", 7, 6, TEXTS("c := 'ab';")},
    {"TextPlusText", "E0302", 7, 8, TEXTS("s := s + t;"), "CONCAT"},
    {"TextAndInteger", "E0302", 7, 8, TEXTS("b := s = i;")},
    {"NarrowAndWide", "E0302", 7, 8, TEXTS("b := s = w;")},
    {"NegatedText", "E0302", 7, 6, TEXTS("s := -s;")},
    {"InitialTooLong", "E0304", 2, 22, "PROGRAM main\nVAR s : STRING[3] := 'four'; END_VAR\nEND_PROGRAM"},
    {"InitialOfOtherWidth", "E0301", 2, 22,
     "PROGRAM main\nVAR s : STRING[3] := \"abc\"; END_VAR\nEND_PROGRAM"},
    {"InitialNotConstant", "E0303", 2, 31,
     "PROGRAM main\nVAR a : STRING; b : STRING := a; END_VAR\nEND_PROGRAM"},
    {"CharacterZero", "E0308", 7, 8, TEXTS("c := s[0];"), "1 to 10"},
    {"CharacterBeyond", "E0308", 7, 3, TEXTS("s[11] := c;"), "1 to 10"},
    {"CharacterTwoIndexes", "E0307", 7, 6, TEXTS("c := s[1, 2];")},
    {"CharacterByReal", "E0301", 7, 8, TEXTS("c := s[1.5];")},
    {"CharacterHasNoAddress", "E0409", 7, 10, TEXTS("r := REF(s[1]);")},
    {"LengthOfInteger", "E0302", 7, 6, TEXTS("i := LEN(i);"), "TO_STRING"},
    {"JoinMixedWidths", "E0301", 7, 16, TEXTS("s := CONCAT(s, w);"), "WSTRING_TO_STRING"},
    {"CutByText", "E0301", 7, 14, TEXTS("s := LEFT(s, t);")},
    {"CutByNegative", "E0304", 7, 14, TEXTS("s := LEFT(s, -1);")},
    {"MidWithoutPosition", "E0403", 7, 6, TEXTS("s := MID(s, 1);"), "IN L P"},
    {"TextIsNoNumber", "E0304", 7, 20, TEXTS("i := STRING_TO_INT('x');")},
    {"TextIsTooLargeANumber", "E0304", 7, 20, TEXTS("i := STRING_TO_INT('32768');")},
    {"WideCharacterOfText", "E0301", 7, 7, TEXTS("wc := STRING_TO_WCHAR(s);")},
    {"InOutOfOtherWidth", "E0301", 7, 3, TEXTS("f(w, 1, c);")},
    {"InOutOfLiteral", "E0409", 7, 3, TEXTS("f('abc', 1, c);")},
    {"CaseOfText", "E0301", 7, 6, TEXTS("CASE s OF 'a': i := 1; END_CASE;")},
    {"CaseOfLongLabel", "E0301", 7, 11, TEXTS("CASE c OF 'ab': i := 1; END_CASE;")},
};

#undef TEXTS

}  // namespace

std::span<const ErrorCase> text_error_cases() {
  return kCases;
}

}  // namespace stepwright::driver_test
