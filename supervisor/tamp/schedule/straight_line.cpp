#include "supervisor/tamp/schedule/straight_line.h"

#include <algorithm>

namespace stepwright::tamp::schedule {

double off_line_m(const motion::Chain& chain, const motion::Configuration& from,
                  const motion::Configuration& to) {
  const motion::Vector3 begin = chain.forward(from).position_m;
  const motion::Vector3 way = chain.forward(to).position_m - begin;
  const double square = dot(way, way);
  double most = 0.0;
  constexpr int kLooks = 8;
  motion::Configuration at = from;
  for (int k = 1; k < kLooks; ++k) {
    for (std::size_t j = 0; j < at.size(); ++j) at[j] = from[j] + (to[j] - from[j]) * k / kLooks;
    const motion::Vector3 off = chain.forward(at).position_m - begin;
    const double share = square > 0.0 ? std::clamp(dot(off, way) / square, 0.0, 1.0) : 0.0;
    most = std::max(most, length(off - share * way));
  }
  return most;
}

motion::JointPath straightened(const motion::Chain& chain, const motion::JointPath& path, double most_m) {
  motion::JointPath made = {path.front()};
  std::size_t at = 0;
  while (at + 1 < path.size()) {
    std::size_t next = path.size() - 1;
    while (next > at + 1 && off_line_m(chain, path[at], path[next]) > most_m) --next;
    made.push_back(path[next]);
    at = next;
  }
  return made;
}

}  // namespace stepwright::tamp::schedule
