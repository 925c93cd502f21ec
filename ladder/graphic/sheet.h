#pragma once

// A program as it is printed: one sheet for each POU, list of types and configuration, in the order of the
// files. Texts are those of the author. Values; use from any thread.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "ladder/graphic/project.h"
#include "ladder/graphic/tag_note.h"

namespace stepwright::graphic {

// Lines of ST with their numbers in the file, so that diagnostics and traps name them.
struct Listing {
  std::vector<std::string> lines;
  std::uint32_t first_line = 1;
};

struct Sheet {
  std::string kind;  // "PROGRAM", "FUNCTION_BLOCK", "FUNCTION", "TYPE", "CONFIGURATION", "VAR_GLOBAL"
  std::string name;  // empty for TYPE and VAR_GLOBAL
  std::string result_type{};  // of a FUNCTION
  std::string file{};
  std::string comment{};
  std::vector<Variable> variables{};
  std::map<std::string, TagNote> notes{};  // by the name of the variable, as it is written
  std::variant<Listing, LadderProgram, SfcChart> body{};
  // Of function blocks that were drawn: the networks as they stand in the file. `body` has the same as rungs.
  std::optional<Diagram> drawn{};
};

}  // namespace stepwright::graphic
