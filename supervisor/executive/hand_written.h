#pragma once

// Programs that people wrote and that run beside the planned chart: a safety program in Ladder that has the
// last word over the outputs. They come as PLCopen XML, are compiled with every program that the executive
// makes, and run in its task behind the chart, in the order in which they are named. What the chart has
// written to an output is a command to them.
//
// Immutable after loading; use from any thread.
//
//   auto programs = HandWritten::load({"safety.xml"});
//   auto joined = programs->joined(translation.project);
//   driver::compile({.texts = {}, .projects = joined->projects()});

#include <filesystem>
#include <vector>

#include "ladder/graphic/project.h"
#include "ladder/source/dialect.h"
#include "runtime/ground/result/result.h"

namespace stepwright::executive {

// The generated project with the instances of the hand-written programs, and those beside it.
struct JoinedPrograms {
  graphic::Project generated;
  std::vector<graphic::Project> written;  // without tasks, instances and globals that `generated` has too

  std::vector<const graphic::Project*> projects() const;
};

class HandWritten {
 public:
  // None.
  HandWritten() = default;
  // Fails with E0001 (no such file), what read_plcopen says, and X0007 for a file without a program.
  [[nodiscard]] static result::Result<HandWritten> load(
      const std::vector<std::filesystem::path>& files,
      const source::Dialect& dialect = source::standard_dialect());

  // Programs that a file's configuration names keep the names of their instances, others have their own. Tags
  // of the binding and globals of a file with one name are one variable. Fails with X0006 where they differ
  // in type or address, and where an instance has the name of another.
  [[nodiscard]] result::Result<JoinedPrograms> joined(const graphic::Project& generated) const;

 private:
  std::vector<graphic::Project> projects_;
};

}  // namespace stepwright::executive
