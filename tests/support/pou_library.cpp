#include "tests/support/pou_library.h"

namespace stepwright::support {

namespace {

// Wrapping, as DINT does.
std::int32_t wrapped(std::int64_t value) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(value));
}

std::string replace_all(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

// @I: the number of the function, @C: a call of the one at half its number.
constexpr const char* kFunction = R"ST(
(* Scales and folds a value. *)
FUNCTION Lib_F@I : DINT
VAR_INPUT
  value : DINT;
  mode : INT := 3;
END_VAR
VAR
  i : INT;
  acc : DINT;
  buffer : ARRAY[0..7] OF DINT;
  point : Lib_Point;
END_VAR
  acc := value + @I;
  FOR i := 0 TO 7 DO
    buffer[i] := acc * 3 + INT_TO_DINT(i);
    IF buffer[i] > 1000 THEN
      acc := acc - buffer[i] / 7;
    ELSE
      acc := acc + buffer[i];
    END_IF;
  END_FOR;
  CASE mode OF
    0..2: acc := acc + 1;
    3: acc := acc + 5;
  ELSE
    acc := acc - 1;
  END_CASE;
  point.x := acc;
  point.y := buffer[3];
  WHILE point.x > 100000 DO
    point.x := point.x / 2;
  END_WHILE;
  Lib_F@I := point.x + point.y MOD 97 + @C;
END_FUNCTION
)ST";

std::int32_t run_function(int number, std::int32_t value) {
  std::int32_t acc = wrapped(std::int64_t{value} + number);
  std::int32_t buffer[8];
  for (int i = 0; i < 8; ++i) {
    buffer[i] = wrapped(std::int64_t{acc} * 3 + i);
    acc = wrapped(buffer[i] > 1000 ? std::int64_t{acc} - buffer[i] / 7 : std::int64_t{acc} + buffer[i]);
  }
  std::int32_t x = wrapped(std::int64_t{acc} + 5);
  while (x > 100000) x /= 2;
  const std::int64_t called = number > 1 ? run_function(number / 2, value % 50) : 0;
  return wrapped(std::int64_t{x} + buffer[3] % 97 + called);
}

// @I: the number of the block, @V and @B: declaration and call of the one at half its number.
constexpr const char* kBlock = R"ST(
(* Counts by states. *)
FUNCTION_BLOCK Lib_B@I
VAR_INPUT
  run : BOOL;
  limit : DINT := 10;
END_VAR
VAR_OUTPUT
  ticks : DINT;
  state : Lib_State;
  done : BOOL;
END_VAR
VAR
  last : Lib_Point;
  history : ARRAY[1..4] OF Lib_Point;
  delay : TON;
  i : INT;
@V
END_VAR
  delay(IN := run, PT := T#1s);
  CASE state OF
    Lib_State#Idle:
      IF run THEN
        state := Lib_State#Busy;
        ticks := ticks + 1;
      END_IF;
    Lib_State#Busy:
      ticks := ticks + 1;
      IF (ticks >= limit) OR delay.Q THEN
        state := Lib_State#Ended;
      END_IF;
    Lib_State#Ended:
      done := TRUE;
  END_CASE;
  FOR i := 4 TO 2 BY -1 DO
    history[i] := history[i - 1];
  END_FOR;
  last.x := ticks;
  last.y := limit - ticks;
  history[1] := last;
@B
END_FUNCTION_BLOCK
)ST";

std::string function_text(int number) {
  std::string text = replace_all(kFunction, "@C", number > 1 ? "Lib_F@H(value MOD 50)" : "0");
  text = replace_all(std::move(text), "@H", std::to_string(number / 2));
  return replace_all(std::move(text), "@I", std::to_string(number));
}

std::string block_text(int number) {
  const bool nested = number > 1;
  std::string text = replace_all(kBlock, "@V", nested ? "  inner : Lib_B@H;" : "");
  text = replace_all(std::move(text), "@B",
                     nested ? "  inner(run := run, limit := limit);\n  ticks := ticks + inner.ticks;" : "");
  text = replace_all(std::move(text), "@H", std::to_string(number / 2));
  return replace_all(std::move(text), "@I", std::to_string(number));
}

// Ticks of the first call with `run`.
std::int32_t run_block(int number) {
  return 1 + (number > 1 ? run_block(number / 2) : 0);
}

}  // namespace

PouLibrary pou_library(int count) {
  PouLibrary library;
  library.text =
      "TYPE\n  Lib_Point : STRUCT x, y : DINT; END_STRUCT;\n  Lib_State : (Idle, Busy, Ended);\nEND_TYPE\n";
  std::string variables;
  std::string body;
  for (int i = 1; i <= (count + 1) / 2; ++i) {
    const std::string number = std::to_string(i);
    library.text += function_text(i);
    body += "  sum := sum + Lib_F" + number + "(" + number + ");\n";
    library.sum = wrapped(std::int64_t{library.sum} + run_function(i, i));
    if (2 * i > count) break;
    library.text += block_text(i);
    variables += "  b" + number + " : Lib_B" + number + ";\n";
    body += "  b" + number + "(run := TRUE);\n  ticks := ticks + b" + number + ".ticks;\n";
    library.ticks += run_block(i);
  }
  library.text +=
      "\nPROGRAM main\nVAR\n  sum, ticks : DINT;\n" + variables + "END_VAR\n" + body + "END_PROGRAM\n";
  return library;
}

}  // namespace stepwright::support
