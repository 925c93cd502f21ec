#pragma once

// An IEC 61131-3 project in the shape of PLCopen TC6: what the exchange formats read and write and the
// compiler takes. Declarations keep ST text for types and initial values, so that nothing is lost on the way
// through.

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "ladder/graphic/ladder_program.h"
#include "ladder/graphic/sfc_chart.h"

namespace stepwright::graphic {

enum class VariableSection : std::uint8_t { Local, Temp, Input, Output, InOut, External, Global };

struct Variable {
  std::string name;
  std::string type;  // ST type text: "BOOL", "INT", "TON", "ARRAY[1..3] OF REAL"
  VariableSection section = VariableSection::Local;
  std::string address{};  // "%IX0.0"; empty if not located
  std::string initial{};  // ST initial value text; empty if none
  bool constant = false;
  bool retain = false;
  std::string comment{};
};

enum class PouKind : std::uint8_t { Program, FunctionBlock, Function };

struct StBody {
  std::string text;
};

struct Pou {
  std::string name;
  PouKind kind = PouKind::Program;
  std::string result_type;  // functions only
  std::vector<Variable> variables;
  std::variant<StBody, LadderProgram, SfcChart> body;
  // Where an SFC was lowered to `body`: its chart, whose steps are BOOL variables of this POU with the names
  // of `step_variables` (same order as chart.steps). Viewers draw it; the container's SFC section comes from
  // it.
  SfcChart origin;
  std::vector<std::string> step_variables;
  std::vector<std::string> transition_variables;
  // BOOL variable that is TRUE in the first scan only; empty if the POU was not lowered.
  std::string first_scan_variable;
};

struct Task {
  std::string name;
  std::int64_t interval_us = 10'000;
  int priority = 0;  // 0 is the highest
};

struct ProgramInstance {
  std::string name;
  std::string program;  // a Pou of kind Program
  std::string task;
};

struct Project {
  std::string name;
  std::vector<Variable> globals;
  std::vector<Pou> pous;
  std::vector<Task> tasks;
  std::vector<ProgramInstance> instances;
};

}  // namespace stepwright::graphic
