#pragma once

// Writes a lowered program as a statement list for Omron CJ controllers (CX-Programmer mnemonics) with its
// address table, as on the paper's bench (CJ1M CPU13): steps in W10.00.., transitions in W20.00.., other
// internal bits in W30.00.., sixteen to a word in the order of the chart (W10.15 is followed by W11.00);
// timers T0000.., words D200.. . Pure function.
//
//   OmronOptions options{.addresses = {{"fc1", "I0.00"}, {"B1", "Q1.00"}, {"S1", "D100", "2001"}}};
//   Result<OmronProgram> program = write_omron(*lowering::lower_sfc(pou), options);

#include <string>
#include <vector>

#include "ladder/graphic/project.h"
#include "runtime/ground/result/result.h"

namespace stepwright::exchange {

struct OmronAddress {
  std::string variable;
  std::string address;   // "I0.00", "I:0.00", "Q1.00", "1.00", "W40.00", "D100"
  std::string source{};  // word that is copied to `address` at the start of every scan, e.g. an analog input
                         // "2001" of the paper's Table 3; empty if none
};

struct OmronOptions {
  std::vector<OmronAddress> addresses;  // every input and output of the program
};

struct OmronTableRow {
  std::string variable;
  std::string address;  // as CX-Programmer shows it: "I:0.00", "Q:1.00", "W10.00", "D100", "T0000"
  std::string type;     // "BOOL", "CHANNEL" (a word) or "TIMER"
  std::string comment;
};

struct OmronProgram {
  std::string statements;  // one instruction a line; comment lines start with '
  std::vector<OmronTableRow> table;
  // The table and the statements as one text file.
  std::string to_text() const;
};

// Fails, never guesses: E0811 an input or output without address or with one that is not Omron's, E0812 a
// construct that has no exact counterpart (named by its rung), E0813 an area that is full.
[[nodiscard]] result::Result<OmronProgram> write_omron(const graphic::Pou& ladder,
                                                       const OmronOptions& options);

}  // namespace stepwright::exchange
