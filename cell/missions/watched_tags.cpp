#include "cell/missions/watched_tags.h"

#include "cell/monitors/cell_monitors.h"

namespace stepwright::missions {

std::vector<run::WatchedTag> watched_tags(const config::CellConfig& config) {
  std::vector<run::WatchedTag> tags;
  const auto monitors = cell_monitors::cell_monitors(config);
  if (!monitors) return tags;
  for (const cell_monitors::CellMonitor& each : *monitors)
    if (each.event)
      tags.push_back(
          {cell_monitors::failed_tag(each.name), "monitor '" + each.name + "' failed: " + each.words});
  return tags;
}

}  // namespace stepwright::missions
