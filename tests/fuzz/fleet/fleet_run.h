#pragma once

// One input through the readers of a fleet: a problem with its map, or a problem of the scheduler; small ones
// that are read are scheduled, and what comes out is judged.
//
// The input is a problem, and maybe a line ";;map", a map.yaml, a line ";;image" and an image. The files lie
// in a folder of the run's own.

#include <filesystem>
#include <string>
#include <string_view>

namespace stepwright::fuzz::fleet {

struct Run {
  bool read = false;    // as a problem, or as one of the scheduler
  bool mapped = false;  // the map was read
  std::string finding;  // what is wrong with us; empty = nothing
};

class Runner {
 public:
  // A new folder below the one for temporary files, removed in the end.
  Runner();
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;
  ~Runner();

  Run run(std::string_view input) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace stepwright::fuzz::fleet
