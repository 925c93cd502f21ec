#pragma once

// What the routes ask of the program that runs: its sources, for those that look.
//
//   Answer answer = program.sources();                     // hmi_web/doc/program.md
//
// Threads: from any; memory only.

#include "hmi_web/api/route.h"

namespace stepwright::api {

class CellProgram {
 public:
  virtual ~CellProgram() = default;

  // With an ETag: the same program has the same answer. Refuses with H0066 while no program is known.
  virtual Answer sources() const = 0;
};

}  // namespace stepwright::api
