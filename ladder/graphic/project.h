#pragma once

// An IEC 61131-3 project in the shape of PLCopen TC6: what the exchange formats read and write and the
// compiler takes. Declarations keep ST text for types and initial values, so that nothing is lost on the way
// through.

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "ladder/graphic/diagram.h"
#include "ladder/graphic/ladder_program.h"
#include "ladder/graphic/sfc_chart.h"

namespace stepwright::graphic {

enum class VariableSection : std::uint8_t { Local, Temp, Input, Output, InOut, External, Global };
// The keyword of IEC 61131-3: "VAR_INPUT".
const char* keyword_of(VariableSection section);

struct Variable {
  std::string name;
  std::string type;  // ST type text: "BOOL", "INT", "TON", "ARRAY[1..3] OF REAL"
  VariableSection section = VariableSection::Local;
  std::string address{};  // "%IX0.0"; empty if not located
  std::string initial{};  // ST initial value text, strings also without quotes (type_text.h); empty if none
  bool constant = false;
  bool retain = false;
  std::string comment{};
  std::uint32_t list = 0;  // which of the POU's lists it stands in; neighbours with the same share one
  Extra extra{};
  std::uint32_t where = 0;  // byte of Project::file_text, 0 = none
};

// A list of variables in a file, beside its section: index Variable::list - 1.
struct VariableList {
  std::string documentation;
  Extra extra;
};

// A type of TYPE .. END_TYPE, as ST text: "STRUCT a : INT; END_STRUCT", "(Red, Green)", "INT(0..10)".
struct DataType {
  std::string name;
  std::string type;
  std::string initial{};
  std::string comment{};
  Extra extra{};
  std::uint32_t where = 0;
};

enum class PouKind : std::uint8_t { Program, FunctionBlock, Function };

struct StBody {
  std::string text;
};

// A body as a file holds it, with the actions and transitions that a chart in it names. Lowering reads a
// statement list, rungs or a chart out of it (ladder/lowering/diagram_to_*).
struct DrawnBody {
  DiagramBody body;
  std::vector<NamedBody> actions;
  std::vector<NamedBody> transitions;
  bool final_scan = false;  // of a chart; see SfcChart::final_scan
};

struct Pou {
  std::string name;
  PouKind kind = PouKind::Program;
  std::string result_type;  // functions only
  std::vector<Variable> variables;
  std::variant<StBody, LadderProgram, SfcChart, DrawnBody> body;
  // Where an SFC was lowered to `body`: its chart, whose steps are BOOL variables of this POU with the names
  // of `step_variables` (same order as chart.steps). Viewers draw it; the container's SFC section comes from
  // it.
  SfcChart origin;
  std::vector<std::string> step_variables;
  std::vector<std::string> transition_variables;
  // BOOL variable that is TRUE in the first scan only; empty if the POU was not lowered.
  std::string first_scan_variable;
  std::vector<VariableList> lists;
  std::string comment;
  Extra extra;
  Extra interface_extra;
  std::uint32_t where = 0;
};

struct Task {
  std::string name;
  std::int64_t interval_us = 10'000;
  int priority = 0;      // 0 is the highest
  std::string single{};  // BOOL variable whose rising edge starts it; empty = periodic
  std::uint32_t resource = 0;
  std::string comment{};
  Extra extra{};
  std::uint32_t where = 0;
};

struct ProgramInstance {
  std::string name;
  std::string program;  // a Pou of kind Program
  std::string task;
  std::uint32_t resource = 0;
  std::string comment{};
  Extra extra{};
  std::uint32_t where = 0;
};

struct Resource {
  std::string name;
  std::vector<Variable> globals;
  std::vector<VariableList> lists;
  std::string comment;
  Extra extra;
};

// The parts of a file that say nothing to a compiler.
struct FileParts {
  Extra root;
  Extra file_header;
  Extra content_header;
  Extra configuration;
  Extra instances;
  std::string configuration_comment;
};

struct Project {
  std::string name;
  std::vector<DataType> types;
  std::vector<Variable> globals;
  std::vector<Pou> pous;
  std::vector<Task> tasks;
  std::vector<ProgramInstance> instances;
  std::string configuration{};            // its name; empty = a standard one
  std::uint32_t configuration_where = 0;  // byte of file_text, 0 = none
  std::vector<Resource> resources{};      // index Task::resource, ProgramInstance::resource; empty = one
  std::vector<VariableList> global_lists{};
  // The file that the project was read from: what `where` counts in. Empty if there is none.
  std::string file_name{};
  std::string file_text{};
  FileParts parts{};
};

}  // namespace stepwright::graphic
