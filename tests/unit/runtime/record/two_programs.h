#pragma once

// Two programs, the second of which takes over what the first one kept.
//
//   TwoPrograms change("PROGRAM MAIN VAR n : INT; END_VAR n := n + 1; END_PROGRAM", "...");
//   change.before.scan();
//   change.carry();
//   EXPECT_EQ(change.after.get("MAIN.n"), 1);

#include <string>

#include "runtime/record/variable_transfer.h"
#include "tests/support/compiled_program.h"

namespace stepwright::record {

class TwoPrograms {
 public:
  TwoPrograms(const std::string& before_text, const std::string& after_text)
      : before({{{"before.st", before_text}}}),
        after({{{"after.st", after_text}}}),
        from(StateLayout::of(before.loaded().program()).value()),
        to(StateLayout::of(after.loaded().program()).value()),
        transfer(VariableTransfer::between(from, to)) {}

  void carry() { transfer.apply(before.image().bytes(), after.image().bytes()); }
  const TransferReport& report() const { return transfer.report(); }

  support::CompiledProgram before;
  support::CompiledProgram after;
  StateLayout from;
  StateLayout to;
  VariableTransfer transfer;
};

// A program MAIN with these declarations and this body.
inline std::string program(const std::string& declarations, const std::string& body = "") {
  return "PROGRAM MAIN\n" + declarations + "\n" + body + "\nEND_PROGRAM\n";
}

}  // namespace stepwright::record
