#pragma once

// Interface of the routes to the sources of the program that runs.
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
