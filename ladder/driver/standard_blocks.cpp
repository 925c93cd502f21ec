#include "ladder/driver/standard_blocks.h"

namespace stepwright::driver {

namespace {

constexpr std::string_view kText = R"ST(
(* Bistables: the input that dominates ends in 1. *)
FUNCTION_BLOCK SR
VAR_INPUT S1, R : BOOL; END_VAR
VAR_OUTPUT Q1 : BOOL; END_VAR
  Q1 := S1 OR (NOT R AND Q1);
END_FUNCTION_BLOCK

FUNCTION_BLOCK RS
VAR_INPUT S, R1 : BOOL; END_VAR
VAR_OUTPUT Q1 : BOOL; END_VAR
  Q1 := NOT R1 AND (S OR Q1);
END_FUNCTION_BLOCK

(* Edges: an input that is TRUE in the first scan is a rising edge, one that is FALSE no falling edge. *)
FUNCTION_BLOCK R_TRIG
VAR_INPUT CLK : BOOL; END_VAR
VAR_OUTPUT Q : BOOL; END_VAR
VAR M : BOOL; END_VAR
  Q := CLK AND NOT M;
  M := CLK;
END_FUNCTION_BLOCK

FUNCTION_BLOCK F_TRIG
VAR_INPUT CLK : BOOL; END_VAR
VAR_OUTPUT Q : BOOL; END_VAR
VAR M : BOOL := TRUE; END_VAR
  Q := NOT CLK AND NOT M;
  M := NOT CLK;
END_FUNCTION_BLOCK

(* Counters: the limits of INT stop them. *)
FUNCTION_BLOCK CTU
VAR_INPUT CU, R : BOOL; PV : INT; END_VAR
VAR_OUTPUT Q : BOOL; CV : INT; END_VAR
VAR M : BOOL; END_VAR
  IF R THEN
    CV := 0;
  ELSIF CU AND NOT M AND (CV < 32767) THEN
    CV := CV + 1;
  END_IF;
  M := CU;
  Q := CV >= PV;
END_FUNCTION_BLOCK

FUNCTION_BLOCK CTD
VAR_INPUT CD, LD : BOOL; PV : INT; END_VAR
VAR_OUTPUT Q : BOOL; CV : INT; END_VAR
VAR M : BOOL; END_VAR
  IF LD THEN
    CV := PV;
  ELSIF CD AND NOT M AND (CV > -32768) THEN
    CV := CV - 1;
  END_IF;
  M := CD;
  Q := CV <= 0;
END_FUNCTION_BLOCK

(* Both edges in one scan cancel each other. *)
FUNCTION_BLOCK CTUD
VAR_INPUT CU, CD, R, LD : BOOL; PV : INT; END_VAR
VAR_OUTPUT QU, QD : BOOL; CV : INT; END_VAR
VAR MU, MD, UP, DOWN : BOOL; END_VAR
  UP := CU AND NOT MU;
  DOWN := CD AND NOT MD;
  MU := CU;
  MD := CD;
  IF R THEN
    CV := 0;
  ELSIF LD THEN
    CV := PV;
  ELSIF UP AND NOT DOWN AND (CV < 32767) THEN
    CV := CV + 1;
  ELSIF DOWN AND NOT UP AND (CV > -32768) THEN
    CV := CV - 1;
  END_IF;
  QU := CV >= PV;
  QD := CV <= 0;
END_FUNCTION_BLOCK

(* Timers: figure 15. Time is that of the scan, so all timers of a scan agree. *)
FUNCTION_BLOCK TON
VAR_INPUT IN : BOOL; PT : TIME; END_VAR
VAR_OUTPUT Q : BOOL; ET : TIME; END_VAR
VAR M : BOOL; START : TIME; END_VAR
  IF IN THEN
    IF NOT M THEN
      START := __NOW();
    END_IF;
    ET := __NOW() - START;
    Q := ET >= PT;
    IF Q THEN
      ET := PT;
    END_IF;
  ELSE
    Q := FALSE;
    ET := T#0s;
  END_IF;
  M := IN;
END_FUNCTION_BLOCK

FUNCTION_BLOCK TOF
VAR_INPUT IN : BOOL; PT : TIME; END_VAR
VAR_OUTPUT Q : BOOL; ET : TIME; END_VAR
VAR M : BOOL; START : TIME; END_VAR
  IF IN THEN
    Q := TRUE;
    ET := T#0s;
  ELSE
    IF M THEN
      START := __NOW();
    END_IF;
    IF Q THEN
      ET := __NOW() - START;
      Q := ET < PT;
      IF NOT Q THEN
        ET := PT;
      END_IF;
    END_IF;
  END_IF;
  M := IN;
END_FUNCTION_BLOCK

(* A pulse ends after PT whatever the input does; ET stays at PT until the input is FALSE. *)
FUNCTION_BLOCK TP
VAR_INPUT IN : BOOL; PT : TIME; END_VAR
VAR_OUTPUT Q : BOOL; ET : TIME; END_VAR
VAR M, RUNNING : BOOL; START : TIME; END_VAR
  IF IN AND NOT M AND NOT RUNNING THEN
    RUNNING := TRUE;
    START := __NOW();
  END_IF;
  M := IN;
  IF RUNNING THEN
    ET := __NOW() - START;
    IF ET >= PT THEN
      ET := PT;
      RUNNING := FALSE;
    END_IF;
  END_IF;
  Q := RUNNING;
  IF NOT RUNNING AND NOT IN THEN
    ET := T#0s;
  END_IF;
END_FUNCTION_BLOCK
)ST";

}  // namespace

std::string_view standard_blocks() {
  return kText;
}

}  // namespace stepwright::driver
