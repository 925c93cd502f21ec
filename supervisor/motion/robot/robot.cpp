#include "supervisor/motion/robot/robot.h"

#include <algorithm>

namespace stepwright::motion {

namespace {

template <typename Named>
int number_of(const std::vector<Named>& all, std::string_view name) {
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Named& each) { return each.name == name; });
  return found == all.end() ? -1 : static_cast<int>(found - all.begin());
}

}  // namespace

int Robot::link(std::string_view named) const {
  return number_of(links, named);
}

int Robot::joint(std::string_view named) const {
  return number_of(joints, named);
}

int Robot::coordinate(std::string_view named) const {
  return number_of(coordinates, named);
}

bool Robot::hangs_below(int link, int above) const {
  while (link > above) link = parent_link(link);  // parents have lower numbers
  return link == above;
}

bool within_limits(const Robot& robot, const std::vector<double>& values, double slack) {
  for (std::size_t k = 0; k < robot.coordinates.size(); ++k)
    if (!(values[k] >= robot.coordinates[k].lower - slack && values[k] <= robot.coordinates[k].upper + slack))
      return false;
  return true;
}

}  // namespace stepwright::motion
