#include "tests/unit/ladder/driver/error_case.h"

namespace stepwright::driver_test {

namespace {

// A configuration with programs for it; line 5 is what a case gives, between two lines of tasks and the end.
#define CELL(line)                                                                                         \
  "FUNCTION_BLOCK Work VAR_INPUT n : INT; END_VAR END_FUNCTION_BLOCK FUNCTION_BLOCK Late VAR_IN_OUT n : "  \
  "INT; "                                                                                                  \
  "END_VAR END_FUNCTION_BLOCK\n"                                                                           \
  "PROGRAM a VAR_INPUT x : INT; END_VAR VAR_OUTPUT y : INT; END_VAR VAR w : Work; l : Late; n : INT; k : " \
  "INT; "                                                                                                  \
  "END_VAR l(n := n); w(n := k); END_PROGRAM PROGRAM o VAR b AT %I* : BOOL; END_VAR END_PROGRAM\n"         \
  "CONFIGURATION c VAR_GLOBAL g : INT; go : BOOL; list : ARRAY[1..2] OF BOOL; END_VAR\n"                   \
  "TASK fast(INTERVAL := T#1ms);\n" line "\nEND_CONFIGURATION\n"

constexpr ErrorCase kCases[] = {
    {"TriggerOfInteger", "E0604", 5, 16, CELL("TASK t(SINGLE:=g); PROGRAM p WITH fast : a;"), "BOOL"},
    {"TriggerConstant", "E0604", 5, 16, CELL("TASK t(SINGLE:=TRUE); PROGRAM p WITH fast : a;"), "%IX0.0"},
    {"TriggerUnknown", "E0201", 5, 16, CELL("TASK t(SINGLE:=goo); PROGRAM p WITH fast : a;"), "'go'"},
    {"TriggerOfNoOutput", "E0201", 5, 16, CELL("TASK t(SINGLE:=p.n); PROGRAM p WITH fast : a;")},
    {"IntervalTooFine", "E0604", 5, 20, CELL("TASK t(INTERVAL := T#1ns); PROGRAM p WITH fast : a;")},
    {"TasksOnlyTriggered", "E0604", 3, 15,
     "PROGRAM a\nEND_PROGRAM\nCONFIGURATION c VAR_GLOBAL go : BOOL; END_VAR TASK t(SINGLE := go); PROGRAM p "
     "WITH t : "
     "a; END_CONFIGURATION\n",
     "interval"},
    {"ConnectionInverted", "E0606", 5, 30, CELL("PROGRAM p WITH fast : a(x := NOT go);"), "compute"},
    {"ConnectionUnknown", "E0402", 5, 25, CELL("PROGRAM p WITH fast : a(z := g);"), "'x'"},
    {"ConnectionOfInternal", "E0402", 5, 25, CELL("PROGRAM p WITH fast : a(n := g);")},
    {"ConnectionComputed", "E0606", 5, 32, CELL("PROGRAM p WITH fast : a(x := g + 1);"), "compute"},
    {"ConnectionWithoutName", "E0606", 5, 25, CELL("PROGRAM p WITH fast : a(g);"), "input := source"},
    {"ConnectionOfType", "E0301", 5, 30, CELL("PROGRAM p WITH fast : a(x := go);")},
    {"ConnectionToConstant", "E0409", 5, 30, CELL("PROGRAM p WITH fast : a(y => 5);")},
    {"BlockTaskUnknownBlock", "E0606", 5, 25, CELL("PROGRAM p WITH fast : a(n WITH fast);")},
    {"BlockTaskUnknownTask", "E0602", 5, 32, CELL("PROGRAM p WITH fast : a(w WITH slow);")},
    {"BlockTaskInOut", "E0606", 5, 25, CELL("PROGRAM p WITH fast : a(l WITH fast);"), "in the call"},
    {"BlockTaskInOneInstance", "E0606", 5, 47,
     CELL("PROGRAM p WITH fast : a(w WITH fast); PROGRAM q WITH fast : a;"), "all instances"},
    {"ConfiguredUnknown", "E0606", 5, 41,
     CELL("PROGRAM p WITH fast : a; VAR_CONFIG p.w.zz : INT := 1; END_VAR"), "resource"},
    {"ConfiguredUnknownProgram", "E0606", 5, 37,
     CELL("PROGRAM p WITH fast : a; VAR_CONFIG q.n : INT := 1; END_VAR")},
    {"ConfiguredType", "E0301", 5, 43, CELL("PROGRAM p WITH fast : a; VAR_CONFIG p.n : DINT := 1; END_VAR")},
    {"ConfiguredNothing", "E0606", 5, 39, CELL("PROGRAM p WITH fast : a; VAR_CONFIG p.n : INT; END_VAR")},
    {"ConfiguredNotOpen", "E0504", 5, 44,
     CELL("PROGRAM p WITH fast : a; VAR_CONFIG p.n AT %MW0 : INT; END_VAR"), "AT %I*"},
    {"ConfiguredArea", "E0504", 5, 44,
     CELL("PROGRAM p WITH fast : o; VAR_CONFIG p.b AT %QX0.0 : BOOL; END_VAR")},
    {"OpenAddressLeft", "E0505", 2, 164, CELL("PROGRAM p WITH fast : o;"), "VAR_CONFIG p.b"},
    {"AccessPathWithoutVariable", "E0104", 5, 41,
     CELL("PROGRAM p WITH fast : a; VAR_ACCESS v : : INT READ_ONLY; END_VAR"), nullptr},
    {"TaskTwiceInAResource", "E0202", 5, 6, CELL("TASK fast(INTERVAL := T#2ms); PROGRAM p WITH fast : a;")},
    {"InOutOfProgram", "E0411", 2, 9, "\nPROGRAM main\nVAR_IN_OUT x : INT; END_VAR\nEND_PROGRAM"},
};

}  // namespace

std::span<const ErrorCase> configuration_error_cases() {
  return kCases;
}

}  // namespace stepwright::driver_test
