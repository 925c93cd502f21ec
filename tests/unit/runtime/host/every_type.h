#pragma once

// Programs that have a variable of every type that a value can have, and two tasks that write them.

#include <array>
#include <string>
#include <vector>

namespace stepwright::host {

struct KindOfValue {
  std::string name;                     // part of identifiers
  std::string type;                     // as it is declared
  std::array<std::string, 4> literals;  // no mixture of the bits or characters of two is a third
};

inline const std::vector<KindOfValue>& kinds_of_value() {
  static const std::vector<KindOfValue> kinds = {
      {"bool", "BOOL", {"FALSE", "TRUE", "FALSE", "TRUE"}},
      {"sint", "SINT", {"15", "112", "51", "85"}},
      {"int", "INT", {"3855", "28784", "13107", "21845"}},
      {"dint", "DINT", {"252645135", "1886417008", "858993459", "1431655765"}},
      {"lint", "LINT", {"16#0F0F0F0F0F0F0F0F", "16#7070707070707070", "16#3333333333333333", "16#55"}},
      {"usint", "USINT", {"15", "240", "51", "170"}},
      {"uint", "UINT", {"3855", "61680", "13107", "43690"}},
      {"udint", "UDINT", {"16#0F0F0F0F", "16#F0F0F0F0", "16#33333333", "16#AAAAAAAA"}},
      {"ulint", "ULINT", {"16#0F0F0F0F0F0F0F0F", "16#F0F0F0F0F0F0F0F0", "16#3333333333333333", "16#AA"}},
      {"byte", "BYTE", {"16#0F", "16#F0", "16#33", "16#AA"}},
      {"word", "WORD", {"16#0F0F", "16#F0F0", "16#3333", "16#AAAA"}},
      {"dword", "DWORD", {"16#0F0F0F0F", "16#F0F0F0F0", "16#33333333", "16#AAAAAAAA"}},
      {"lword", "LWORD", {"16#0F0F0F0F0F0F0F0F", "16#F0F0F0F0F0F0F0F0", "16#3333333333333333", "16#AA"}},
      {"real", "REAL", {"1.1", "-2.7E10", "3.3E-7", "123456.7"}},
      {"lreal", "LREAL", {"1.1", "-2.7E100", "3.3E-70", "123456.7"}},
      {"time", "TIME", {"T#1d2h3m4s5ms", "T#77us", "T#9h", "T#1ms"}},
      {"date", "DATE", {"D#1970-01-02", "D#2024-02-29", "D#2099-12-31", "D#2001-09-09"}},
      {"tod", "TOD", {"TOD#00:00:01", "TOD#12:30:00.5", "TOD#23:59:59", "TOD#06:07:08"}},
      {"dt",
       "DT",
       {"DT#1970-01-02-00:00:01", "DT#2024-02-29-12:30:00", "DT#2099-12-31-23:59:59",
        "DT#2001-09-09-01:46:40"}},
      {"char", "CHAR", {"CHAR#'O'", "CHAR#'p'", "CHAR#'3'", "CHAR#'U'"}},
      {"wchar", "WCHAR", {"WCHAR#\"O\"", "WCHAR#\"p\"", "WCHAR#\"3\"", "WCHAR#\"U\""}},
      {"string", "STRING[12]", {"'aaaa'", "'bbbbbbbbbbb'", "''", "'abababa'"}},
      {"wstring", "WSTRING[12]", {"\"aaaa\"", "\"bbbbbbbbbbb\"", "\"\"", "\"abababa\""}},
      {"mode", "Mode", {"Mode#IDLE", "Mode#RUN", "Mode#HOLD", "Mode#DONE"}},
      {"level", "Level", {"3855", "28784", "13107", "21845"}},
      {"wide", "Wide", {"16#0F0F0F0F0F0F0F0F", "16#F0F0F0F0F0F0F0F0", "16#3333333333333333", "16#AA"}},
  };
  return kinds;
}

inline const char* types_of_every_type() {
  return R"(TYPE
  Mode : (IDLE := 257, RUN := 514, HOLD := 1028, DONE := 2056);
  Level : INT(0..32000);
  Wide : ULINT(0..16#F0F0F0F0F0F0F0F0);
END_TYPE
)";
}

// One of each behind that many bytes, in structures, arrays, arrays of arrays and function blocks that lie in
// each other.
inline std::string every_type_nested(int pad) {
  std::string members = pad == 0 ? "" : "  pad : ARRAY[1.." + std::to_string(pad) + "] OF BYTE;\n";
  std::string lists;
  for (const KindOfValue& kind : kinds_of_value()) {
    members += "  v_" + kind.name + " : " + kind.type + ";\n";
    lists += "  l_" + kind.name + " : ARRAY[0..1, 2..4] OF " + kind.type + ";\n";
  }
  return types_of_every_type() + std::string("TYPE Inner : STRUCT\n") + members +
         "  ref : REF_TO DINT; END_STRUCT; END_TYPE\n"
         "TYPE Outer : STRUCT flag : BOOL; inner : ARRAY[0..1] OF Inner; odd : BYTE; END_STRUCT; END_TYPE\n"
         "FUNCTION_BLOCK Holder\n"
         "VAR_INPUT edge : BOOL R_EDGE; END_VAR VAR_OUTPUT q : USINT; END_VAR\n"
         "VAR outer : Outer; refs : ARRAY[0..2] OF REF_TO INT; timer : TON;\n" +
         lists +
         "END_VAR\n"
         "IF edge THEN q := q + 1; END_IF; timer(IN := edge, PT := T#1s); END_FUNCTION_BLOCK\n"
         "PROGRAM main\n"
         "VAR first : BOOL; holders : ARRAY[0..1] OF Holder; last : REF_TO Inner; n : DINT; END_VAR\n"
         "holders[0](edge := first); first := NOT first; n := n + 1;\n"
         "END_PROGRAM\n";
}

// Two tasks, `fast` and `slow`, that write one variable of each kind: x, with what each of them wrote last
// beside it. The fast one counts in `bad` how often x was neither, and says in `which` of what kind; `merges`
// counts the cycles of the slow one, which computes for `work` rounds before it writes.
inline std::string two_writers(int work) {
  std::string structs, globals, externals, fast_tables, slow_tables, check, fast, slow;
  int index = 0;
  const auto add = [&](const std::string& name, const std::string& type, const std::string& from_fast,
                       const std::string& from_slow) {
    const std::string s = "s_" + name + "[1]";
    structs += "TYPE S_" + name + " : STRUCT pad : ARRAY[0.." + std::to_string(index % 7) +
               "] OF BYTE; x : " + type + "; last : " + type + "; y : " + type + "; END_STRUCT; END_TYPE\n";
    const std::string variable = "  s_" + name + " : ARRAY[0..1] OF S_" + name + ";\n";
    globals += variable;
    externals += variable;
    check += "IF " + s + ".x <> " + s + ".last AND " + s + ".x <> " + s +
             ".y THEN bad := bad + 1; which := " + std::to_string(index) + "; END_IF;\n";
    fast += s + ".last := " + from_fast + "; " + s + ".x := " + s + ".last;\n";
    slow += s + ".x := " + from_slow + "; " + s + ".y := " + s + ".x;\n";
    ++index;
  };
  for (const KindOfValue& kind : kinds_of_value()) {
    std::string values;
    for (const std::string& literal : kind.literals) values += (values.empty() ? "" : ", ") + literal;
    const std::string table =
        "  t_" + kind.name + " : ARRAY[0..3] OF " + kind.type + " := [" + values + "];\n";
    fast_tables += table;
    slow_tables += table;
    add(kind.name, kind.type, "t_" + kind.name + "[n]", "t_" + kind.name + "[n]");
  }
  add("ref", "REF_TO DINT", "REF(targets[n * 77])", "REF(targets[m])");
  const std::string shared = externals + "  targets : ARRAY[0..4095] OF DINT; bad, which, merges : DINT;\n";
  return types_of_every_type() + structs + "CONFIGURATION c\nVAR_GLOBAL\n" + globals +
         "  targets : ARRAY[0..4095] OF DINT; bad, which, merges : DINT;\nEND_VAR\n"
         "TASK fast(INTERVAL := T#1ms, PRIORITY := 0);\nTASK slow(INTERVAL := T#2ms, PRIORITY := 1);\n"
         "PROGRAM pf WITH fast : quick;\nPROGRAM ps WITH slow : heavy;\nEND_CONFIGURATION\n"
         "PROGRAM quick\nVAR_EXTERNAL\n" +
         shared + "END_VAR\nVAR n : DINT; begun : BOOL;\n" + fast_tables + "END_VAR\nIF begun THEN\n" +
         check + "END_IF;\nbegun := TRUE; n := (n + 1) MOD 4;\n" + fast +
         "END_PROGRAM\n"
         "PROGRAM heavy\nVAR_EXTERNAL\n" +
         shared + "END_VAR\nVAR n, m, i, sum : DINT;\n" + slow_tables + "END_VAR\nFOR i := 1 TO " +
         std::to_string(work) +
         " DO sum := sum + i MOD 7; END_FOR;\n"
         "n := (n + 3) MOD 4; m := (m + 1237) MOD 4096;\n" +
         slow + "merges := merges + 1;\nEND_PROGRAM\n";
}

}  // namespace stepwright::host
