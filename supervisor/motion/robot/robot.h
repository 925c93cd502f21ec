#pragma once

// A robot as a tree of links and joints, flat: what URDF says of bodies and motions, and nothing else.
//
// Values that do not change after reading; any thread may read them. Links and joints are in an order in
// which a parent comes before its children: links[0] is the root, and joint j moves link j + 1. `coordinates`
// are the numbers that a configuration consists of: one for each joint that moves by itself; a joint that
// mimics another one reads that one's.
//
//   const auto robot = read_urdf(text, "cell.urdf");
//   std::vector<double> q(robot->coordinates.size());          // a configuration, in rad and m
//   const int hand = robot->link("right_hand");

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/motion/spatial/transform.h"

namespace stepwright::motion {

enum class JointKind : std::uint8_t { Fixed, Revolute, Continuous, Prismatic };

struct Joint {
  std::string name;
  JointKind kind = JointKind::Fixed;
  int parent = 0;         // link; its child is the link after the joint's own number
  Transform origin;       // frame of the joint in its parent's, at value 0
  Vector3 axis{1, 0, 0};  // of length 1, in the joint's own frame
  int coordinate = -1;    // whose value moves the joint; -1: fixed
  // value = multiplier * coordinate + offset: 1 and 0 but for a joint that mimics another one.
  double multiplier = 1.0;
  double offset = 0.0;
};

enum class ShapeKind : std::uint8_t { Box, Cylinder, Sphere, Mesh };

// A body of a link, for collisions. Boxes and cylinders have their centre at the origin, cylinders lie along
// z.
struct Shape {
  ShapeKind kind = ShapeKind::Box;
  Transform origin;          // in the link's frame
  Vector3 size_m;            // box: its full sides
  double radius_m = 0.0;     // cylinder, sphere
  double length_m = 0.0;     // cylinder
  std::string mesh;          // as URDF names the file: "package://..." or relative to the URDF's folder
  Vector3 scale{1, 1, 1};    // mesh
  result::Location where{};  // of a mesh of a robot's link: in its file
};

struct Link {
  std::string name;
  std::vector<Shape> shapes;
};

// Limits are in rad or m; infinite for continuous joints, which have no lower and no upper end.
struct Coordinate {
  std::string name;  // of its joint
  int joint = 0;
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  double velocity_per_s = 0.0;
};

struct Robot {
  std::string name;
  std::vector<Link> links;
  std::vector<Joint> joints;
  std::vector<Coordinate> coordinates;

  // Their numbers; -1: there is none of that name.
  int link(std::string_view named) const;
  int joint(std::string_view named) const;
  int coordinate(std::string_view named) const;

  // The joint that moves a link; -1 for the root.
  static int joint_above(int link) { return link - 1; }
  static int link_below(int joint) { return joint + 1; }
  int parent_link(int link) const {
    return link == 0 ? -1 : joints[static_cast<std::size_t>(link - 1)].parent;
  }
  // Whether `link` hangs below `above`, or is it.
  bool hangs_below(int link, int above) const;
};

// No value of any coordinate lies outside of its limits by more than `slack`. Requires a value for each.
bool within_limits(const Robot& robot, const std::vector<double>& values, double slack = 0.0);

}  // namespace stepwright::motion
