#pragma once

// Description of a robot in SRDF, beside its bodies: groups of joints, named states, end effectors, and the
// pairs of links that need no check. Numbers are those of the robot that it was read for. Values; any thread
// may read.
//
//   const Group* arm = semantics->group("right_arm");
//   for (int coordinate : arm->coordinates) ...

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stepwright::motion {

struct Group {
  std::string name;
  std::vector<int> links;  // each list in ascending order, each number once
  std::vector<int> joints;
  std::vector<int> coordinates;  // of the joints that move
  // The ends of its chain, if it is one chain and nothing else; -1 otherwise.
  int base_link = -1;
  int tip_link = -1;
};

struct NamedState {
  std::string name;
  std::string group;
  std::vector<std::pair<int, double>> values;  // coordinate and value, in the order of the file
};

struct EndEffector {
  std::string name;
  std::string group;
  int parent_link = 0;       // of the arm, that the hand is mounted on
  std::string parent_group;  // may be empty
};

struct Semantics {
  std::vector<Group> groups;
  std::vector<NamedState> states;
  std::vector<EndEffector> end_effectors;
  std::vector<std::pair<int, int>> disabled;  // pairs of links, the lower number first, in ascending order

  const Group* group(std::string_view named) const {
    const auto found =
        std::find_if(groups.begin(), groups.end(), [&](const Group& each) { return each.name == named; });
    return found == groups.end() ? nullptr : &*found;
  }
  const NamedState* state(std::string_view of_group, std::string_view named) const {
    const auto found = std::find_if(states.begin(), states.end(), [&](const NamedState& each) {
      return each.name == named && each.group == of_group;
    });
    return found == states.end() ? nullptr : &*found;
  }
  bool is_disabled(int a, int b) const {
    return std::binary_search(disabled.begin(), disabled.end(), std::pair(std::min(a, b), std::max(a, b)));
  }
};

}  // namespace stepwright::motion
