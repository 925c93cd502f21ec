#pragma once

// Picture of a cell of arms for the page (supervisor/doc/pictures.md, arms): bodies in space, the joints that
// move them, what hands hold when, and the ways of the tools. What moves is not in it: it names the variables
// of the program that tell it.
//
//   ArmsPicture picture{.id = "cell", .program = digest};
//   picture.frames.push_back({.name = "base"});              // the root; then each frame behind its parent
//   pictures.own.push_back(page_picture(picture));
//
// Plain values; metres, radians, z up.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "supervisor/run/picture.h"

namespace stepwright::tamp::pictures {

using PicturePoint = std::array<double, 3>;

// A rigid motion of space: a rotation, row by row, then a shift.
struct PicturePlace {
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
  PicturePoint at_m{};
};

// A solid. Boxes, cylinders and balls have their middle at the place; cylinders lie along z.
struct PictureSolid {
  enum class Kind : std::uint8_t { Box, Cylinder, Ball, Mesh };
  Kind kind = Kind::Box;
  PicturePlace place{};                                   // in the frame that it belongs to
  PicturePoint size_m{};                                  // box: full sides
  double radius_m = 0.0;                                  // cylinder, ball
  double length_m = 0.0;                                  // cylinder
  std::vector<PicturePoint> points{};                     // mesh
  std::vector<std::array<std::uint32_t, 3>> triangles{};  // anticlockwise as seen from outside
};

// factor * variable + offset; while the variable is not known, `rest` stands for it.
struct PictureValue {
  std::string variable{};  // empty: the offset is the value
  double factor = 1.0;
  double offset = 0.0;
  double rest = 0.0;
};

struct ArmsPicture {
  enum class Motion : std::uint8_t { Fixed, Turns, Slides };
  // A frame behind its parent: place, then a turn about the axis or a shift along it.
  struct Frame {
    std::string name{};
    int parent = -1;  // an earlier frame; -1: the cell's own
    int arm = -1;     // whose body it is; -1: none's
    PicturePlace place{};
    Motion motion = Motion::Fixed;
    PicturePoint axis{0, 0, 1};
    PictureValue value{};  // rad or m
    std::vector<PictureSolid> solids{};
  };
  // What stands for good.
  struct Body {
    std::string name{};
    std::vector<PictureSolid> solids{};
  };
  // A rectangle that things are put on.
  struct Surface {
    std::string name{};
    PicturePlace place{};  // of its middle
    double size_x_m = 0.0, size_y_m = 0.0;
  };
  // Where a thing is once the arm's progress has come to `from`: the last one of its stages that has begun.
  struct Stage {
    int arm = -1;  // -1: from the beginning
    double from = 0.0;
    int frame = -1;  // that carries it; -1: it stands in the cell
    PicturePlace place{};
  };
  struct Thing {
    std::string name{};
    std::vector<PictureSolid> solids{};
    std::vector<Stage> stages{};  // in the order in which they begin; the first one is the beginning
  };
  // Before the arm is farther than `at` in its step (0 to 1), the other one must have come to `progress`.
  struct Wait {
    double at = 0.0;
    int other = 0;
    double progress = 0.0;
  };
  struct Step {
    std::string kind{};   // a word: fingers, approach, linear, grip, lift, transfer, lower, release
    std::string thing{};  // with which; may be empty
    std::vector<Wait> waits{};
  };
  struct WayPoint {
    PicturePoint at_m{};
    double progress = 0.0;
  };
  // A body that the distance is measured with; both ends in the frame.
  struct Capsule {
    int frame = 0;
    PicturePoint from_m{}, to_m{};
    double radius_m = 0.0;
  };
  // The same of a thing, while the arm's progress is at least `from` and below `until`.
  struct Held {
    Capsule body{};
    double from = 0.0, until = 0.0;
  };
  struct Joint {
    std::string name{};
    int frame = 0;  // that it moves; the frame has its variable
  };
  struct Arm {
    std::string name{};
    std::vector<Joint> joints{};  // from the base to the hand
    int tool = 0;                 // frame
    PictureValue opening{};       // m, between the fingers
    std::vector<Capsule> capsules{};
    std::vector<Held> held{};
    std::vector<Step> steps{};    // of the schedule: progress n.x is in steps[n]
    std::vector<WayPoint> way{};  // of the tool, as planned
    // Variables; empty: there is none.
    std::string progress{};
    std::string waiting{};   // BOOL: it stands or slows down for another one
    std::string grasped{};   // BOOL: something of the width that is meant is held
    std::string standing{};  // BOOL: it does not move
    std::string error{};
  };
  // What a camera reports in one slot; variables. Kind 0: nothing.
  struct Seen {
    std::string kind{};
    PictureValue x{}, y{}, z{}, yaw{};  // m, rad
  };
  struct Kind {
    int kind = 0;
    std::string name{};
  };

  std::string id{};
  std::string program{};  // digest of the program that does this; empty: nothing is planned
  std::vector<Body> bodies{};
  std::vector<Surface> surfaces{};
  std::vector<Frame> frames{};  // parents before their children
  std::vector<Arm> arms{};
  std::vector<Thing> things{};
  std::vector<Seen> seen{};
  std::vector<Kind> kinds{};  // of things, as the camera numbers them
  // Variables of the cell.
  std::string distance{};         // LREAL, m, of the arms
  double least_distance_m = 0.0;  // that stops them
  std::string cause{};            // INT: index of the list
  std::vector<std::string> causes{};
  std::string cause_arm{};  // INT: number of an arm, from 1
};

// The same for the page. A large one is worth looking at without its ways, and without its bodies.
run::OwnPicture page_picture(const ArmsPicture& picture);

}  // namespace stepwright::tamp::pictures
