#pragma once

// The compiler as one function: IEC 61131-3 sources in, a bytecode container out.
//
// Pure: no file, clock or environment is read, nothing is kept between calls, so any number of threads may
// compile at once. The same input gives the same bytes. 1000 rungs take a few milliseconds.
//
//   driver::CompileInput input;
//   input.texts.push_back({"blink.st", text});
//   auto output = driver::compile(input);
//   if (!output) print(result::to_string(output.error()));
//
// Texts and a graphic project may be mixed: a project's POUs may call the functions of a text. Standard
// function blocks (TON .. RS) are there without being named.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "ladder/driver/watcher.h"
#include "ladder/graphic/project.h"
#include "ladder/lint/lint.h"
#include "ladder/source/dialect.h"
#include "ladder/source/source_set.h"
#include "runtime/ground/result/result.h"

namespace stepwright::driver {

struct CompileInput {
  std::vector<source::NamedText> texts;             // ST, in the order in which diagnostics name them
  std::vector<const graphic::Project*> projects{};  // LD, SFC, ST POUs of exchange files or a plan
  // The folder, as an absolute path, that paths in the container are relative to: that of who will read them.
  // Files outside of it are named from the folder that they share, so that equal sources give equal
  // containers wherever they are compiled. Diagnostics name files as `texts` does.
  std::string folder{};
  // Further warnings (ladder/lint) than those of the compiler itself.
  lint::Level lint = lint::Level::None;
  // The container brings the sources with it for viewers (print/program_document.h), if they are not longer
  // than bytecode::kMaxDocumentBytes. Engines never look at them.
  bool document = false;
  // Extensions of the standard that the sources may use.
  const source::Dialect* dialect = &source::standard_dialect();
  // The sources are only checked: they may be a library without a program, which has no container.
  bool library = false;
  // Programs that watch the others and run behind them. What is wrong with one is said at its places.
  std::span<const Watcher> watchers{};
};

struct CompileOutput {
  std::vector<std::byte> container;  // ready for the verifier (runtime/bytecode); empty of a library
  result::Diagnostics warnings;      // nothing of severity Error
};

// Fails with every diagnostic found (errors and warnings, in the order of the sources). A program needs one
// CONFIGURATION or, without one, exactly one PROGRAM, which then runs as an instance of its own name in a
// task of 10 ms (a project's own tasks and instances take the place of a CONFIGURATION).
[[nodiscard]] result::Result<CompileOutput> compile(const CompileInput& input);

}  // namespace stepwright::driver
