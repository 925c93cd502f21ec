#pragma once

// The exit codes of every command (stable: scripts rely on them).

namespace stepwright::result {

enum class ExitCode : int {
  Done = 0,
  BadInput = 1,         // the input is wrong; the diagnostic is on stderr
  Usage = 2,            // the command line is wrong
  NoPlan = 3,           // proved: no plan exists
  BudgetExhausted = 4,  // time or memory ended before there was an answer
  RuntimeFault = 5,     // a fault at run time: a trap, a lost process, a goal missed
};

constexpr int to_int(ExitCode code) {
  return static_cast<int>(code);
}

}  // namespace stepwright::result
