#pragma once

// Links and joints as a file has them, in any order, brought into the order of a tree. Internal to this
// folder.

#include <string>
#include <vector>

#include "supervisor/motion/robot/internal/xml_document.h"
#include "supervisor/motion/robot/robot.h"

namespace stepwright::motion::internal {

struct ReadLink {
  pugi::xml_node node;
  Link link;
};

struct ReadJoint {
  pugi::xml_node node;
  Joint joint;
  Coordinate limits;
  int parent = -1;  // numbers of read links
  int child = -1;
  std::string mimics;  // name of a joint; empty: moves by itself
};

// Complains and gives what there is where the links are no tree.
Robot make_tree(std::vector<ReadLink> links, std::vector<ReadJoint> joints, Reader& reader);

}  // namespace stepwright::motion::internal
