#pragma once

// Planning problems as files of MoveIt (scene0001.yaml beside request0001.yaml), planned one after the other,
// and every path rechecked as a whole by FCL with the robot's own bodies.

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace stepwright::bench {

struct ProblemFolders {
  std::filesystem::path urdf, srdf;
  std::filesystem::path problems;                             // looked through with all folders below
  std::vector<std::pair<std::string, std::string>> packages;  // beginnings of mesh names, and their folders
  double protrusion_m = 0.015;
  std::size_t most_spheres = 256;
};

struct ProblemFigures {
  std::size_t problems = 0, solved = 0;
  std::size_t ends_collide_exactly = 0;     // start or goal collide by FCL: no problem that can be solved
  std::size_t ends_collide_by_spheres = 0;  // and not by FCL: spheres stand out
  std::size_t exhausted = 0;
  std::size_t spheres = 0;
  double median_ms = 0.0, p95_ms = 0.0;  // of the processor: planning and shortening of those solved
  std::size_t refused_once = 0;          // the first path was refused by FCL, and others were planned
  double certain_median_ms = 0.0, certain_p95_ms = 0.0;  // the same with the recheck and what came after it
  std::size_t recheck_refuses = 0;                       // of the paths returned, asked again
};

// Throws std::runtime_error where a file is wrong.
ProblemFigures plan_problems(const ProblemFolders& folders);

}  // namespace stepwright::bench
