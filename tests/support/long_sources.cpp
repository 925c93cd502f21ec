#include "tests/support/long_sources.h"

namespace stepwright::support {

namespace {

std::string number(int i) {
  return std::to_string(i);
}

// One piece of text for each of 0..count-1.
template <typename Piece>
std::string each(int count, Piece piece) {
  std::string text;
  for (int i = 0; i < count; ++i) text += piece(i);
  return text;
}

std::string repeated(const std::string& text, int times) {
  return each(times, [&](int) { return text; });
}

std::string program(const std::string& variables, const std::string& body) {
  return "PROGRAM main\nVAR\n" + variables + "END_VAR\n" + body + "END_PROGRAM\n";
}

std::string dint_program(const std::string& body) {
  return program("  x, y : DINT;\n", body);
}

}  // namespace

std::string many_rungs(int count) {
  const auto coil = [](int i) { return "m" + number(i < 0 ? 0 : i); };
  std::string variables = each(16, [](int i) {
    return "  in" + number(i) + " AT %IX" + number(i / 8) + "." + number(i % 8) + " : BOOL;\n";
  });
  variables += each(count, [&](int i) { return "  " + coil(i) + " : BOOL;\n"; });
  return program(variables, each(count, [&](int i) {
                   return coil(i) + " := (" + coil(i - 1) + " OR in" + number(i % 16) + ") AND NOT " +
                          coil(i - 2) + ";\n";
                 }));
}

std::string many_rungs_in_a_line(int count) {
  std::string text = many_rungs(count);
  for (char& c : text)
    if (c == '\n') c = ' ';
  return text;
}

std::string many_tags(int count) {
  const std::string external = each(count, [](int i) { return "  g" + number(i) + " : INT;\n"; });
  return "VAR_GLOBAL\n" +
         each(count, [](int i) { return "  g" + number(i) + " AT %MW" + number(i) + " : INT;\n"; }) +
         "END_VAR\nPROGRAM main\nVAR_EXTERNAL\n" + external + "END_VAR\n" +
         each(count, [](int i) { return "  g" + number(i) + " := " + number(i % 1000) + ";\n"; }) +
         "END_PROGRAM\n";
}

std::string many_steps(int count) {
  std::string text = "PROGRAM main\nVAR\n  go AT %IX0.0 : BOOL;\n";
  text += each(count, [](int i) { return "  q" + number(i) + " : BOOL;\n"; });
  text += "END_VAR\nINITIAL_STEP S0: q0(N); END_STEP\n";
  text += each(count - 1,
               [](int i) { return "STEP S" + number(i + 1) + ": q" + number(i + 1) + "(N); END_STEP\n"; });
  text += each(count, [&](int i) {
    return "TRANSITION FROM S" + number(i) + " TO S" + number((i + 1) % count) + " := go; END_TRANSITION\n";
  });
  return text + "END_PROGRAM\n";
}

std::string many_alternatives(int count) {
  std::string text = "PROGRAM main\nVAR n : INT; END_VAR\nINITIAL_STEP S: END_STEP\n";
  text += each(count, [](int i) { return "STEP T" + number(i) + ": END_STEP\n"; });
  text += each(count, [](int i) {
    return "TRANSITION FROM S TO T" + number(i) + " := n = " + number(i % 30'000) +
           "; END_TRANSITION\nTRANSITION FROM T" + number(i) + " TO S := TRUE; END_TRANSITION\n";
  });
  return text + "END_PROGRAM\n";
}

std::string long_condition(int count) {
  return "PROGRAM main\nVAR contact_with_a_long_name : BOOL; END_VAR\nINITIAL_STEP S0: END_STEP\n"
         "STEP S1: END_STEP\nTRANSITION FROM S0 TO S1 := " +
         each(count, [](int i) { return std::string(i > 0 ? " AND\n " : "") + "contact_with_a_long_name"; }) +
         "; END_TRANSITION\nTRANSITION FROM S1 TO S0 := TRUE; END_TRANSITION\nEND_PROGRAM\n";
}

std::string many_selections(int count) {
  return dint_program(
      repeated("CASE x OF 1: y := 2; END_CASE;\nFOR x := 0 TO y BY 2 DO y := y - 1; END_FOR;\n", count));
}

std::string many_locals(int count) {
  return "FUNCTION f : DINT\nVAR\n" +
         each(count - 1, [](int i) { return "  v" + number(i) + " : DINT;\n"; }) +
         "END_VAR\n  f := v0;\nEND_FUNCTION\n" + dint_program("x := f();\n");
}

std::string many_tasks(int count) {
  return "PROGRAM p END_PROGRAM\nCONFIGURATION c\n" +
         each(count,
              [](int i) { return "  TASK t" + number(i) + "(INTERVAL := T#10ms, PRIORITY := 1);\n"; }) +
         each(count, [](int i) { return "  PROGRAM p" + number(i) + " WITH t" + number(i) + " : p;\n"; }) +
         "END_CONFIGURATION\n";
}

std::string many_background_programs(int count) {
  return "PROGRAM p END_PROGRAM\nCONFIGURATION c\n" +
         each(8, [](int i) { return "  TASK t" + number(i) + "(INTERVAL := T#10ms, PRIORITY := 1);\n"; }) +
         "  PROGRAM first WITH t0 : p;\n" +
         each(count, [](int i) { return "  PROGRAM p" + number(i) + " : p;\n"; }) + "END_CONFIGURATION\n";
}

std::string large_frames(int tasks) {
  return "FUNCTION large : INT\nVAR a : ARRAY[1..16000000] OF BYTE; END_VAR\n  a[1] := 1;\n  large := 1;\n"
         "END_FUNCTION\nPROGRAM p\nVAR n : INT; END_VAR\n  n := large();\nEND_PROGRAM\nCONFIGURATION c\n" +
         each(tasks,
              [](int i) { return "  TASK t" + number(i) + "(INTERVAL := T#10ms, PRIORITY := 1);\n"; }) +
         each(tasks, [](int i) { return "  PROGRAM p" + number(i) + " WITH t" + number(i) + " : p;\n"; }) +
         "END_CONFIGURATION\n";
}

std::string chart_in_blocks(int depth) {
  const std::string instance(250, 'i');
  return "FUNCTION_BLOCK B0\nINITIAL_STEP S: END_STEP\nEND_FUNCTION_BLOCK\n" +
         each(depth,
              [&](int i) {
                return "FUNCTION_BLOCK B" + number(i + 1) + "\nVAR " + instance + " : B" + number(i) +
                       "; END_VAR\n  " + instance + "();\nEND_FUNCTION_BLOCK\n";
              }) +
         program("  x : B" + number(depth) + ";\n", "x();\n");
}

std::string many_arguments(int count) {
  return dint_program("x := MAX(" + each(count, [](int i) { return (i > 0 ? "," : "") + number(i); }) +
                      ");\n");
}

std::string bounded_array(const std::string& lower, const std::string& upper) {
  return program("  x : ARRAY[" + lower + ".." + upper + "] OF BYTE;\n", "x[" + lower + "] := 1;\n");
}

std::string string_of(int characters) {
  return program("  x : STRING[" + number(characters) + "];\n", "x := 'a';\n");
}

std::string variable_at(const std::string& address) {
  return program("  x AT " + address + " : BYTE;\n", "x := 1;\n");
}

std::string many_callees(int count) {
  return each(count,
              [](int i) {
                const std::string name = "F" + number(i);
                return "FUNCTION " + name + " : DINT\nVAR_INPUT a : DINT; END_VAR\n  " + name +
                       " := a + 1;\nEND_FUNCTION\n";
              }) +
         dint_program(each(count, [](int i) { return "  x := F" + number(i) + "(x);\n"; }));
}

std::string many_fields(int count) {
  return "TYPE Large : STRUCT\n" + each(count, [](int i) { return "  f" + number(i) + " : INT;\n"; }) +
         "END_STRUCT; END_TYPE\n" +
         program("  v : Large;\n", each(count, [](int i) { return "  v.f" + number(i) + " := 1;\n"; }));
}

std::string many_enumerators(int count) {
  return "TYPE Large : DINT (" + each(count, [](int i) { return (i > 0 ? ", e" : "e") + number(i); }) +
         "); END_TYPE\n" +
         program("  v : Large;\n  x : DINT;\n", "CASE v OF\n" + each(count, [](int i) {
                                                  return "  Large#e" + number(i) + ": x := 1;\n";
                                                }) + "END_CASE;\n");
}

std::string many_labels(int count) {
  return dint_program(
      "CASE x OF\n" +
      each(count, [](int i) { return number(i * 3) + ".." + number(i * 3 + 1) + ": y := 1;\n"; }) +
      "END_CASE;\n");
}

std::string many_branches(int count) {
  return dint_program("IF x = 0 THEN y := 0;\n" +
                      each(count, [](int i) { return "ELSIF x = " + number(i + 1) + " THEN y := 1;\n"; }) +
                      "END_IF;\n");
}

std::string many_constants(int count) {
  return program("  x : LREAL;\n", each(count, [](int i) { return "  x := x + " + number(i) + ".5;\n"; }));
}

std::string many_elements(int count) {
  return program("  x : ARRAY[1.." + number(count) + "] OF DINT := [" +
                     each(count, [](int i) { return (i > 0 ? ", " : "") + number(i); }) + "];\n",
                 "");
}

std::string repeated_elements(int count) {
  return program("  x : ARRAY[1.." + number(count) + "] OF INT := [" + number(count) + "(7)];\n", "");
}

std::string many_unknown_names(int count) {
  return program(each(count, [](int i) { return "  name" + number(i) + " : INT;\n"; }),
                 each(count, [](int i) { return "  naem" + number(i) + " := 1;\n"; }));
}

std::string many_syntax_errors(int count) {
  return dint_program(repeated("x := ) ;\n", count));
}

std::string nested_parentheses(int depth) {
  return dint_program("x := " + repeated("(", depth) + "1" + repeated(")", depth) + ";\n");
}

std::string nested_negations(int depth) {
  return program("  x : BOOL;\n", "x := " + repeated("NOT ", depth) + "x;\n");
}

std::string nested_ifs(int depth) {
  return dint_program(repeated("IF x = 1 THEN\n", depth) + "x := 2;\n" + repeated("END_IF;\n", depth));
}

std::string nested_cases(int depth) {
  return dint_program(repeated("CASE x OF 1:\n", depth) + "x := 2;\n" + repeated("END_CASE;\n", depth));
}

std::string nested_comments(int depth) {
  return repeated("(*", depth) + repeated("*)", depth) + "\n" + dint_program("x := 1;\n");
}

std::string open_comments(int depth) {
  return repeated("(*", depth) + "\n" + dint_program("x := 1;\n");
}

std::string nested_arrays(int depth) {
  return program("  x : " + repeated("ARRAY[0..0] OF ", depth) + "INT;\n", "");
}

std::string nested_structures(int depth) {
  return program("  x : " + repeated("STRUCT a : ", depth) + "INT" + repeated("; END_STRUCT", depth) + ";\n",
                 "");
}

std::string chained_structures(int depth, bool inner_first) {
  const auto type = [](int i, const std::string& member) {
    return "T" + number(i) + " : STRUCT a : " + member + "; END_STRUCT;\n";
  };
  const std::string types =
      inner_first ? type(0, "INT") + each(depth, [&](int i) { return type(i + 1, "T" + number(i)); })
                  : each(depth, [&](int i) { return type(i, "T" + number(i + 1)); }) + type(depth, "INT");
  return "TYPE\n" + types + "END_TYPE\n" + program("  x : T" + number(inner_first ? depth : 0) + ";\n", "");
}

std::string chained_blocks(int depth) {
  return each(depth,
              [&](int i) {
                const std::string inner = i + 1 < depth ? "B" + number(i + 1) : "INT";
                return "FUNCTION_BLOCK B" + number(i) + "\nVAR b : " + inner +
                       "; END_VAR\nEND_FUNCTION_BLOCK\n";
              }) +
         program("  x : B0;\n", "x();\n");
}

std::string chained_calls(int depth) {
  return each(depth,
              [&](int i) {
                const std::string name = "F" + number(i);
                const std::string result = i + 1 < depth ? "F" + number(i + 1) + "(a)" : "a";
                return "FUNCTION " + name + " : DINT\nVAR_INPUT a : DINT; END_VAR\n  " + name +
                       " := " + result + ";\nEND_FUNCTION\n";
              }) +
         dint_program("x := F0(x);\n");
}

std::string doubled_blocks(int depth) {
  return "FUNCTION_BLOCK B0\nVAR b : BOOL; END_VAR\n  b := NOT b;\nEND_FUNCTION_BLOCK\n" +
         each(depth,
              [](int i) {
                return "FUNCTION_BLOCK B" + number(i + 1) + "\nVAR a, b : B" + number(i) +
                       "; END_VAR\n  a();\n  b();\nEND_FUNCTION_BLOCK\n";
              }) +
         program("  x : B" + number(depth) + ";\n", "x();\n");
}

std::string long_name(int characters) {
  const std::string name(static_cast<std::size_t>(characters), 'a');
  return program("  " + name + " : INT;\n", name + " := 1;\n");
}

std::string long_namespaces(int characters) {
  std::string name = "a";
  while (name.size() + 4 < static_cast<std::size_t>(characters)) name += ".a";
  const std::string last(static_cast<std::size_t>(characters) - name.size() - 1, 't');
  return "NAMESPACE " + name + "\nTYPE " + last + " : INT; END_TYPE END_NAMESPACE\n" +
         program("  x : " + name + "." + last + ";\n", "x := 1;\n");
}

std::string nested_namespaces(int depth) {
  return each(depth, [](int) { return "NAMESPACE a\n"; }) +
         each(depth, [](int) { return "END_NAMESPACE\n"; }) + program("", "");
}

std::string many_namespaces(int count) {
  const auto name = [](const char* prefix, int i) { return prefix + std::to_string(i); };
  return each(count,
              [&](int i) {
                return "NAMESPACE " + name("n", i) + " FUNCTION " + name("f", i) + " : INT\n" + name("f", i) +
                       " := 1; END_FUNCTION END_NAMESPACE USING " + name("n", i) + ";\n";
              }) +
         program("  x : INT;\n", each(count, [&](int i) { return "x := x + " + name("f", i) + "();\n"; }));
}

std::string many_dimensions(int count) {
  const auto list = [&](const std::string& piece) {
    return "[" + each(count, [&](int i) { return (i > 0 ? "," : "") + piece; }) + "]";
  };
  return program("  x : ARRAY" + list("0..0") + " OF INT;\n", "x" + list("0") + " := 1;\n");
}

std::string huge_types(int count) {
  return "TYPE\n" + each(count, [](int i) { return "T" + number(i) + " : ARRAY[1..32000000] OF BYTE;\n"; }) +
         "END_TYPE\n" + dint_program("x := 1;\n");
}

}  // namespace stepwright::support
