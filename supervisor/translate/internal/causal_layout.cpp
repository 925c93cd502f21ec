#include "supervisor/translate/internal/causal_layout.h"

#include <algorithm>

namespace stepwright::translate::internal {

CausalLayout causal_layout(const Schedule& schedule, int columns) {
  const std::size_t count = schedule.actions.size();
  // The longest way from an action without predecessor; all links to an action come before those from it.
  std::vector<int> depth(count, 0);
  for (const ScheduleLink& link : schedule.links) {
    depth[link.after] = std::max(depth[link.after], depth[link.before] + 1);
  }
  CausalLayout layout;
  std::vector<int> used(count, 0);  // lines, by depth
  for (std::size_t i = 0; i < count; ++i) {
    const int band = depth[i] / columns;
    const int line = used[static_cast<std::size_t>(depth[i])]++;
    if (layout.lines.size() <= static_cast<std::size_t>(band)) {
      layout.lines.resize(static_cast<std::size_t>(band) + 1, 0);
    }
    int& lines = layout.lines[static_cast<std::size_t>(band)];
    lines = std::max(lines, line + 1);
    layout.places.push_back({band, depth[i] % columns, line});
  }
  return layout;
}

}  // namespace stepwright::translate::internal
