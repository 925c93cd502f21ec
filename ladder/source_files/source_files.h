#pragma once

// The source files of a command line: read, and their diagnostics shown. Not thread-safe; one per process.
//
//   result::Diagnostics problems;
//   const SourceFiles files = load(paths, problems);
//   if (!problems.empty()) ...
//   const auto output = driver::compile(files.input());
//   print(output->warnings, files.files);

#include <deque>
#include <span>
#include <string>
#include <vector>

#include "ladder/driver/compile.h"
#include "ladder/source/render.h"
#include "ladder/source_files/source_options.h"

namespace stepwright::sources {

struct SourceFiles {
  std::vector<source::NamedText> files;   // as they were written, for the lines of diagnostics
  std::vector<source::NamedText> texts;   // the ST files among them
  std::deque<graphic::Project> projects;  // the PLCopen files
  SourceOptions options;

  // One more: ST, or PLCopen if its name ends in .xml, of which E08xx is appended.
  void add(const std::string& name, std::string text, result::Diagnostics& diagnostics);
  // Input of the compiler; valid as long as this object.
  driver::CompileInput input() const;
};

// Reads .st (and everything else that is not .xml) as ST, .xml as PLCopen. Appends what is wrong with all of
// them to `diagnostics`: E0001 for a file that cannot be read, E08xx for an XML file, and for a configuration
// that is chosen where there is no such file.
SourceFiles load(const std::vector<std::string>& paths, result::Diagnostics& diagnostics,
                 const SourceOptions& options = {});

// How diagnostics look on a descriptor: in colour and as wide as it is if it is a terminal.
source::RenderStyle style_of(int descriptor);

// Writes diagnostics to stderr, with their lines, and a last line that counts them. In colour if stderr is a
// terminal and NO_COLOR is not set.
void print(const result::Diagnostics& diagnostics, std::span<const source::NamedText> files);

}  // namespace stepwright::sources
