#pragma once

// A cell and a sequence of actions as a TOML file (supervisor/doc/intervals.md, The file). Lengths in metres,
// angles in degrees.
//
// A function without state; any thread. The file is not trusted; all that is wrong is said at once.
//
//   auto file = load_sequence("cell.toml");
//   if (!file) print(to_string(file.error()));
//   Network network(file->cell);

#include <filesystem>
#include <memory>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/tamp/intervals/sequence/work_cell.h"

namespace stepwright::tamp {

struct SequenceFile {
  std::vector<std::unique_ptr<const ReachTable>> reaches;  // of each arm; the cell refers to them
  std::vector<std::unique_ptr<const ExactReach>> exacts;   // likewise
  std::vector<Shoulder> shoulders;
  WorkCell cell;
  std::vector<Action> sequence;
};

// I0001 to I0006: the file itself (no TOML, unknown key, wrong type, out of range, missing, rejected);
// I0101 to I0103 of validate(); I0104: a name that is used twice; I0105: an arm
// of a URDF that no bounds are made of; A0101 to A0111: what is wrong with the URDF.
[[nodiscard]] result::Result<SequenceFile> load_sequence(const std::filesystem::path& file);

}  // namespace stepwright::tamp
