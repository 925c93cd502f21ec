#pragma once

// A ladder diagram: rungs, each a condition that powers coils and calls. Rungs run top to bottom.

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ladder/graphic/condition.h"

namespace stepwright::graphic {

enum class CoilKind : std::uint8_t { Normal, Negated, Set, Reset, RisingEdge, FallingEdge };

struct Coil {
  CoilKind kind = CoilKind::Normal;
  std::string variable;
};

// ">1>": where a line ends that goes on wherever the same stands again (IEC 61131-3, 8.1.3). It is no
// variable; programs that are shown have them (lowering/shown_ladder.h). A line that begins with one has its
// symbol in drawings; behind other symbols, negated or with an edge it is a contact.
inline bool is_connector(std::string_view name) {
  return name.size() > 2 && name.front() == '>' && name.back() == '>';
}

// A function, function block or statement list in a rung, run only while its EN input has power
// (a function block with a BOOL input in `power_input` gets the power there and runs in every scan).
struct Block {
  std::string type;         // "TON", "MOVE", a user POU; empty for `st_body`
  std::string instance;     // name of the instance of a function block; empty for a function
  std::string power_input;  // input that takes the rung's power instead of EN ("IN"); empty = EN
  std::vector<std::pair<std::string, std::string>> inputs;   // formal parameter, ST expression
  std::vector<std::pair<std::string, std::string>> outputs;  // formal parameter, variable written
  std::string st_body;  // an ST statement list run under EN; used when `type` is empty
};

struct Rung {
  std::string label;  // target of a jump; may be empty
  std::string comment;
  Condition condition;
  std::vector<Block> blocks;  // in order, before the coils
  std::vector<Coil> coils;
  std::string jump_to;     // label to jump to while powered; may be empty
  bool is_return = false;  // leaves the POU while powered
  // A network that powers several things one after the other is several rungs: the first, and those that go
  // on with it. What they share stands in wires.
  bool goes_on = false;
  std::string place;  // mark of where it was drawn (ladder/syntax/lexer.h); empty if it was not
};

// A value that a network carries from one place to the others that read it.
struct Wire {
  std::string name;
  std::string type;    // ST; empty = that of the value
  bool keeps = false;  // its last value is read in the next scan (feedback)
};

struct LadderProgram {
  std::vector<Rung> rungs;
  std::vector<Wire> wires{};
};

}  // namespace stepwright::graphic
