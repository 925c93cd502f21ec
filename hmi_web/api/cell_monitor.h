#pragma once

// Interface of the routes to what is drawn of a program while it runs (hmi_web/doc/program.md).
//
//   Answer answer = monitor.live({{"sheet", "2"}, {"instance", "Main"}, {"blocks", "0-3"}});
//
// Threads: from any; memory only.

#include <map>
#include <string>

#include "hmi_web/api/route.h"

namespace stepwright::api {

class CellMonitor {
 public:
  using Parameters = std::map<std::string, std::string, std::less<>>;

  virtual ~CellMonitor() = default;

  // What a sheet's blocks show in the newest scan. Refuses with H0066 while no program is known.
  virtual Answer live(const Parameters& given) const = 0;
  // Where the parts of a chart stand. Refuses with H0130 if the program has no such chart.
  virtual Answer chart(const Parameters& given) const = 0;
};

}  // namespace stepwright::api
