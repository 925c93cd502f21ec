#pragma once

// An automaton as a function block in Structured Text: a BOOL input for each proposition, one letter a scan,
// a verdict, and memory of a fixed size. Text only; whoever compiles it says what its names must look like.
//
//   VAR_INPUT   one BOOL for each proposition; Reset : BOOL, which begins anew and reads no letter
//   VAR_OUTPUT  Verdict : INT    0 undecided, 1 TRUE (for good), 2 FALSE (for good)
//               State   : UINT   of the automaton
//               Since   : UDINT  scans since the state was entered, 0 in the scan that entered it
//
// Propositions that timers make (syntax_tree.h) are no inputs: the block has a TON for each.
//
// As a PROGRAM it takes what its propositions mean from expressions, says besides
//   Undecided, Satisfied, Failed : BOOL   one of them holds
//   Left : UINT                           transitions to TRUE, at least; 65535: none leads there
// and begins anew when somebody sets Reset, when it takes over from a program with another automaton, or,
// once it has failed, when charts begin anew.
//
// Thread rule: pure functions. Example:
//   auto text = monitor_block(monitor->automaton, {.name = "NO_WASH", .inputs = {"wash"}});

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/ltl/automaton/automaton.h"
#include "supervisor/ltl/syntax/syntax_tree.h"

namespace stepwright::ltl {

enum class BlockForm : std::uint8_t {
  Automatic,  // a table, if its size is within the bound
  Table,      // one look for every four propositions
  Branches,   // IFs that ask for one proposition each: to be read by people
};

struct BlockOptions {
  std::string name = "LTL_MONITOR";
  // Of each proposition: legal names, different from each other and from block_names().
  std::vector<std::string> inputs = {};
  std::string about = {};               // the formula, for the comment at the top
  const SyntaxTree* formula = nullptr;  // the automaton's, if it has timers
  BlockForm form = BlockForm::Automatic;
  // Reads a letter only when it differs from the last one, as X wants it (see stutter_report).
  bool on_changes = false;
  std::size_t most_entries = 16'384;  // of a table
  std::size_t most_branches = 20'000;
};

// Names that a block or a program has besides its inputs. Names have no case.
std::span<const std::string_view> block_names();
std::span<const std::string_view> program_names();

// Requires an input for each proposition. L0031: table or branches would be larger than the bound.
[[nodiscard]] result::Result<std::string> monitor_block(const Automaton& automaton,
                                                        const BlockOptions& options);

struct MonitorProgram {
  std::string text;                  // the statements with expressions are its first ones
  std::vector<std::uint32_t> lines;  // of each proposition: where its expression stands; 0 of a timer's
};

// `expressions` in ST, of each proposition; those of timers are not looked at. `stops`: the program ends the
// scan, and the outputs are safe, as soon as the verdict is FALSE (__STOP, ladder/driver/watcher.h).
[[nodiscard]] result::Result<MonitorProgram> monitor_program(const Automaton& automaton,
                                                             const std::vector<std::string>& expressions,
                                                             bool stops, const BlockOptions& options);

}  // namespace stepwright::ltl
