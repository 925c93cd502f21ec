#include "tests/unit/ladder/driver/error_case.h"

namespace stepwright::driver_test {

namespace {

// The body of a program with types of edition 3.
#define TYPES(statements)                                                                                    \
  "TYPE Light : (Red, Green); Shade : (Blue, Red); Node : STRUCT v : INT; END_STRUCT; END_TYPE\n"            \
  "PROGRAM main\nVAR l : Light; s : Shade; p : INT(0..9); i : INT; r : REF_TO INT; rb : REF_TO BOOL; "       \
  "w : WORD; n, m : Node; q AT %QX0.0 : BOOL; a : ARRAY[1..3] OF INT; c : REF_TO Node; END_VAR\n" statements \
  "\nEND_PROGRAM\n"

// A structure whose members begin on line 2.
#define STRUCTURE(head, members)                       \
  "TYPE T : STRUCT " head "\n" members                 \
  "\nEND_STRUCT; Mode : (Off, On); END_TYPE\nPROGRAM " \
  "main\nEND_PROGRAM\n"

constexpr ErrorCase kCases[] = {
    {"PlacesOverlap", "E0506", 3, 6, STRUCTURE("", "a AT %W0 : WORD;\nb AT %B1 : BYTE;"), "OVERLAP"},
    {"BitsOverlap", "E0506", 3, 6, STRUCTURE("", "a AT %X0.7 : BOOL;\nb AT %B0 : BYTE;"), "OVERLAP"},
    {"PlaceMissing", "E0506", 3, 1, STRUCTURE("", "a AT %W0 : WORD;\nb : BYTE;"), "all members or to none"},
    {"PlaceMissingInOverlap", "E0506", 3, 1, STRUCTURE("OVERLAP", "a AT %W0 : WORD;\nb : BYTE;")},
    {"PlaceOfTwo", "E0501", 2, 9, STRUCTURE("", "a, b AT %B0 : BYTE;"), "its own place"},
    {"PlaceOfOtherSize", "E0502", 2, 6, STRUCTURE("", "a AT %W0 : DINT;"), "%B0"},
    {"PlaceOfBool", "E0502", 2, 6, STRUCTURE("", "a AT %B0 : BOOL;"), "%X0.0"},
    {"BitPlaceOfByte", "E0502", 2, 6, STRUCTURE("", "a AT %X0.0 : BYTE;"), "%B0"},
    {"BitPlaceOfArray", "E0502", 2, 6, STRUCTURE("", "a AT %X0.0 : ARRAY[1..2] OF BYTE;")},
    {"NoBit", "E0501", 2, 6, STRUCTURE("", "a AT %X3 : BOOL;"), "%X3.0"},
    {"BitNine", "E0501", 2, 6, STRUCTURE("", "a AT %X3.9 : BOOL;"), "%X3.0"},
    {"PlaceBeyond", "E0501", 2, 6, STRUCTURE("", "a AT %B99999999999 : BYTE;"), "%B4"},
    {"PlaceTooFar", "E0209", 2, 1, STRUCTURE("", "a AT %B33554431 : WORD;")},
    {"AddressOfMember", "E0504", 2, 6, STRUCTURE("", "a AT %MB0 : BYTE;"), "%B4"},
    {"PlaceOfVariable", "E0501", 2, 10, "PROGRAM main\nVAR x AT %B0 : BYTE; END_VAR\nEND_PROGRAM"},
    {"OverlapOfText", "E0506", 3, 5, STRUCTURE("OVERLAP", "a : DWORD;\nb : STRING[2];"), "bit strings"},
    {"OverlapOfBool", "E0506", 3, 5, STRUCTURE("OVERLAP", "a : DWORD;\nb : STRUCT c : BOOL; END_STRUCT;")},
    {"OverlapOfEnumeration", "E0506", 3, 5, STRUCTURE("OVERLAP", "a : INT;\nb : Mode;")},
    {"OverlapOfReference", "E0506", 2, 5, STRUCTURE("OVERLAP", "a : REF_TO INT;\nb : DWORD;")},
    {"OverlapOfSubrange", "E0506", 2, 5, STRUCTURE("OVERLAP", "a : ARRAY[1..2] OF INT(0..5);\nb : DWORD;")},
    {"ReferenceToBitMember", "E0409", 3, 10,
     "PROGRAM main\nVAR s : STRUCT b AT %X0.0 : BOOL; END_STRUCT; r : REF_TO BOOL; END_VAR\nr := REF(s.b);\n"
     "END_PROGRAM"},
    {"BadDate", "E0103", 3, 6, BODY("i := D#2026-02-30;"), "D#"},
    {"BadTimeOfDay", "E0103", 3, 6, BODY("i := TOD#24:00:00;"), "TOD#"},
    {"BadEscape", "E0103", 3, 9, BODY("i := 'ab$Zc';"), "$$"},
    {"WideCharacter", "E0103", 3, 7, BODY("i := '\xE2\x82\xAC';"), "beyond 255"},
    {"EnumerationOutOfBase", "E0304", 1, 27,
     "TYPE T : USINT (A := 255, B, C); END_TYPE\nPROGRAM main\nEND_PROGRAM"},
    {"EnumerationOfReal", "E0301", 1, 10, "TYPE T : REAL (A, B); END_TYPE\nPROGRAM main\nEND_PROGRAM"},
    {"EnumerationMixed", "E0302", 4, 18, TYPES("IF l = Red AND l <> s THEN i := 1; END_IF;")},
    {"EnumerationOrder", "E0302", 4, 6, TYPES("IF l < Green THEN i := 1; END_IF;")},
    {"EnumerationAmbiguous", "E0201", 4, 6, TYPES("CASE Red OF Red: i := 1; END_CASE;"), "Type#RED"},
    {"EnumerationForeign", "E0204", 4, 12, TYPES("l := Light#Blue;")},
    {"SubrangeConstant", "E0304", 4, 6, TYPES("p := 10;"), "0 to 9"},
    {"SubrangeEmpty", "E0304", 2, 13, "PROGRAM main\nVAR x : INT(5..4); END_VAR\nEND_PROGRAM"},
    {"SubrangeOfReal", "E0301", 2, 9, "PROGRAM main\nVAR x : REAL(1..2); END_VAR\nEND_PROGRAM"},
    {"SubrangeInitial", "E0304", 2, 22, "PROGRAM main\nVAR x : INT(0..4) := 5; END_VAR\nEND_PROGRAM"},
    {"ReferenceToOther", "E0301", 4, 7, TYPES("rb := REF(i);")},
    {"ReferenceNotFollowed", "E0301", 4, 6, TYPES("r := i;")},
    {"ReferenceMember", "E0204", 4, 8, TYPES("i := c.v;"), "^.v"},
    {"FollowNoReference", "E0301", 4, 6, TYPES("i := i^;"), "REF_TO"},
    {"ReferenceArithmetic", "E0302", 4, 8, TYPES("r := r + 1;")},
    {"ReferenceToBit", "E0409", 4, 11, TYPES("rb := REF(q);")},
    {"ReferenceToConstant", "E0401", 3, 10,
     "PROGRAM main\nVAR CONSTANT c : INT := 1; END_VAR VAR r : REF_TO INT; END_VAR\nr := "
     "REF(c);\nEND_PROGRAM"},
    {"ReferenceToTemporary", "E0412", 3, 10,
     "PROGRAM main\nVAR_TEMP t : INT; END_VAR VAR r : REF_TO INT; END_VAR\nr := REF(t);\nEND_PROGRAM",
     "VAR_TEMP"},
    {"ReferenceToLocal", "E0412", 3, 10,
     "FUNCTION f : BOOL\nVAR a : ARRAY[1..2] OF INT; r : REF_TO INT; END_VAR\nr := "
     "REF(a[1]);\nEND_FUNCTION\nPROGRAM "
     "main\nEND_PROGRAM"},
    {"AttemptNoReference", "E0301", 4, 6, TYPES("r ?= i;"), ":="},
    {"StructureEquality", "E0302", 4, 6, TYPES("IF n = m THEN i := 1; END_IF;")},
    {"PartOfInteger", "E0409", 4, 6, TYPES("i := INT_TO_WORD(i).%X1;")},
    {"PartOfNumber", "E0302", 4, 4, TYPES("IF i.%X1 THEN i := 1; END_IF;"), "INT_TO_WORD"},
    {"PartOutside", "E0308", 4, 1, TYPES("w.%X16 := TRUE;"), "0 to 15"},
    {"PartTooLarge", "E0308", 4, 1, TYPES("w.%D0 := 1;")},
    {"OpenArrayVariable", "E0208", 2, 9, "PROGRAM main\nVAR x : ARRAY[*] OF INT; END_VAR\nEND_PROGRAM",
     "bounds"},
    {"OpenArrayMixed", "E0306", 2, 24,
     "FUNCTION f : INT\nVAR_INPUT x : ARRAY[*, 1..2] OF INT; END_VAR\nEND_FUNCTION\nPROGRAM "
     "main\nEND_PROGRAM"},
    {"BoundOfScalar", "E0301", 4, 18, TYPES("i := LOWER_BOUND(i, 1);")},
    {"BoundOfDimension", "E0307", 4, 21, TYPES("i := LOWER_BOUND(a, 2);")},
    {"UsingOfNothing", "E0201", 2, 7, "PROGRAM main\nUSING Plant;\nEND_PROGRAM"},
    {"InternalElsewhere", "E0204", 7, 6,
     "NAMESPACE a\nFUNCTION INTERNAL f : INT\nf := 1;\nEND_FUNCTION\nEND_NAMESPACE\n"
     "PROGRAM main VAR x : INT; END_VAR\nx := a.f();\nEND_PROGRAM"},
    {"InternalNamespaceElsewhere", "E0204", 3, 31,
     "NAMESPACE a\nNAMESPACE INTERNAL b TYPE T : INT; END_TYPE END_NAMESPACE END_NAMESPACE\n"
     "PROGRAM main VAR x : INT; y : a.b.T; END_VAR\nx := y;\nEND_PROGRAM"},
    {"NameOfSeveralNamespaces", "E0201", 5, 6,
     "NAMESPACE a FUNCTION f : INT\nf := 1; END_FUNCTION END_NAMESPACE\n"
     "NAMESPACE b FUNCTION f : INT\nf := 2; END_FUNCTION END_NAMESPACE PROGRAM main USING a, b; VAR x : INT; "
     "END_VAR\n"
     "x := f();\nEND_PROGRAM"},
    {"InternalTypeElsewhere", "E0204", 3, 9,
     "NAMESPACE a TYPE INTERNAL T : INT; END_TYPE FUNCTION f : T\nf := 1; END_FUNCTION END_NAMESPACE PROGRAM "
     "main\n"
     "VAR x : a.T; END_VAR\nx := a.f();\nEND_PROGRAM",
     "stands in a"},
    {"InternalByUsing", "E0204", 3, 6,
     "NAMESPACE a FUNCTION INTERNAL f : INT\nf := 1; END_FUNCTION END_NAMESPACE PROGRAM main USING a; VAR x "
     ": INT; "
     "END_VAR\nx := f();\nEND_PROGRAM"},
    {"UsingBehindDeclarations", "E0104", 2, 1,
     "NAMESPACE a TYPE T : INT; END_TYPE\nUSING b; END_NAMESPACE NAMESPACE b END_NAMESPACE\nPROGRAM main\n"
     "END_PROGRAM",
     "before the declarations"},
    {"TwiceInANamespace", "E0202", 1, 18,
     "NAMESPACE a TYPE F : INT; END_TYPE END_NAMESPACE\nNAMESPACE A FUNCTION_BLOCK f END_FUNCTION_BLOCK "
     "END_NAMESPACE PROGRAM main\nEND_PROGRAM"},
    {"RecursionInANamespace", "E0206", 1, 22,
     "NAMESPACE a FUNCTION f : INT\nf := a.f();\nEND_FUNCTION END_NAMESPACE PROGRAM main\nEND_PROGRAM"},
    {"NamespaceWithoutEnd", "E0105", 3, 1,
     "PROGRAM main\nEND_PROGRAM\nNAMESPACE a\nFUNCTION f : INT\nf := 1;\nEND_FUNCTION"},
    {"ProgramInANamespace", "E0104", 2, 1,
     "NAMESPACE a\nPROGRAM main\nEND_PROGRAM\nEND_NAMESPACE\nPROGRAM main\nEND_PROGRAM"},
    {"UnknownInANamespace", "E0203", 2, 9,
     "NAMESPACE a TYPE T : INT; END_TYPE END_NAMESPACE PROGRAM main\nVAR x : a.U; END_VAR\nEND_PROGRAM"},
    {"EdgeOfInteger", "E0208", 2, 11,
     "FUNCTION_BLOCK f\nVAR_INPUT x : INT R_EDGE; END_VAR\nEND_FUNCTION_BLOCK\nPROGRAM main\nEND_PROGRAM"},
    {"EdgeOfLocal", "E0208", 2, 5, "PROGRAM main\nVAR x : BOOL F_EDGE; END_VAR\nEND_PROGRAM"},
    {"RetainedTemporary", "E0208", 2, 17, "PROGRAM main\nVAR_TEMP RETAIN x : BOOL; END_VAR\nEND_PROGRAM"},
    {"AddressInStructure", "E0504", 1, 22,
     "TYPE T : STRUCT x AT %MW0 : INT; END_STRUCT END_TYPE\nPROGRAM main\nEND_PROGRAM"},
    {"NothingAsValue", "E0410", 3, 6,
     "FUNCTION f VAR_INPUT x : INT; END_VAR END_FUNCTION\nPROGRAM main VAR i : INT; END_VAR\ni := "
     "f(1);\nEND_PROGRAM",
     "=>"},
    {"EnableNotBool", "E0301", 3, 13, BODY("t(IN:=b,EN:=i);"), "INT_TO_BOOL"},
};

}  // namespace

std::span<const ErrorCase> type_error_cases() {
  return kCases;
}

}  // namespace stepwright::driver_test
