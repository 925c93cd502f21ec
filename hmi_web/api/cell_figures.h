#pragma once

// Interface of the routes to the figures of the runtimes that a server follows: how punctual, how healthy.
//
//   Answer answer = figures.scan();                     // hmi_web/doc/protocol.md, "Scan"
//
// Threads: from any; nothing blocks.

#include "hmi_web/api/route.h"

namespace stepwright::api {

class CellFigures {
 public:
  virtual ~CellFigures() = default;

  virtual Answer scan() const = 0;
};

}  // namespace stepwright::api
