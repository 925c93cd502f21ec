#pragma once

// Runs a textual chart through the compiler and the VM, scan by scan (10 ms each), and writes down what it
// does as a text with one character per scan.
//
//   ChartRun run("VAR x : BOOL; END_VAR INITIAL_STEP ...");
//   run.trace("main.q", "0010")  ->  "0011"           `go` is TRUE in the third of four scans

#include <string>
#include <vector>

#include "tests/support/compiled_program.h"

namespace stepwright::lowering {

class ChartRun {
 public:
  // `text`: declarations and chart of a program `main` that has the inputs `go` and `r`, an output `q` and a
  // mark `mark` already; `before`: POUs and types in front of it.
  explicit ChartRun(const std::string& text, const std::string& before = {})
      : program_(input(text, before)) {}

  // One line per variable; '0' to '9' = its value. `mark` is 0 before every scan.
  std::vector<std::string> traces(const std::vector<std::string>& variables, const std::string& go,
                                  const std::string& r = {}) {
    std::vector<std::string> lines(variables.size());
    for (std::size_t scan = 0; scan < go.size(); ++scan) {
      program_.set("main.go", go[scan] == '1');
      program_.set("main.r", scan < r.size() && r[scan] == '1');
      program_.set("main.mark", 0);
      program_.scan();
      for (std::size_t i = 0; i < variables.size(); ++i)
        lines[i] += static_cast<char>('0' + program_.get(variables[i]));
    }
    return lines;
  }

  std::string trace(const std::string& variable, const std::string& go, const std::string& r = {}) {
    return traces({variable}, go, r).front();
  }

  support::CompiledProgram& program() { return program_; }

 private:
  static driver::CompileInput input(const std::string& text, const std::string& before) {
    driver::CompileInput input;
    input.texts.push_back({"chart.st", before + "PROGRAM main\nVAR go, r, q : BOOL; mark : INT; END_VAR\n" +
                                           text + "\nEND_PROGRAM\n"});
    return input;
  }

  support::CompiledProgram program_;
};

}  // namespace stepwright::lowering
