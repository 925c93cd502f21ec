#pragma once

// An automaton as a function block in Structured Text: a BOOL input for each proposition, one letter a scan,
// a verdict, and memory of a fixed size. Text only; whoever compiles it says what its names must look like.
//
//   VAR_INPUT   one BOOL for each proposition; Reset : BOOL, which begins anew and reads no letter
//   VAR_OUTPUT  Verdict : INT    0 undecided, 1 TRUE (for good), 2 FALSE (for good)
//               State   : UINT   of the automaton
//               Since   : UDINT  scans since the state was entered, 0 in the scan that entered it
//
// Thread rule: pure functions. Example:
//   auto text = monitor_block(monitor->automaton, {.name = "NO_WASH", .inputs = {"wash"}});

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/ltl/automaton/automaton.h"

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
  std::string about = {};  // the formula, for the comment at the top
  BlockForm form = BlockForm::Automatic;
  // Reads a letter only when it differs from the last one, as X wants it (see stutter_report).
  bool on_changes = false;
  std::size_t most_entries = 16'384;  // of a table
  std::size_t most_branches = 20'000;
};

// Names that the block has besides its inputs. Names have no case.
std::span<const std::string_view> block_names();

// Requires an input for each proposition. L0031: table or branches would be larger than the bound.
[[nodiscard]] result::Result<std::string> monitor_block(const Automaton& automaton,
                                                        const BlockOptions& options);

}  // namespace stepwright::ltl
