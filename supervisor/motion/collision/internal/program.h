#pragma once

// A robot and its world as flat figures, in single precision: what a check of many configurations runs
// through. Internal to this folder. Made once; does not change; any thread.

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace stepwright::motion::internal {

// A joint that moves, and with it body number k + 1 (step k). Body 0 is what stands still.
struct BodyStep {
  std::size_t parent = 0;  // body
  std::size_t column = 0;  // of the configuration
  bool slides = false;
  float multiplier = 1.0F, offset = 0.0F;
  std::array<float, 3> origin{};                             // in the parent's frame
  std::array<float, 9> still{}, with_cosine{}, with_sine{};  // of its rotation; sliding: only `still`
  std::array<float, 3> along{};                              // sliding: in the parent's frame
};

// In the frame of its body; the radius holds what single precision rounds.
struct Ball {
  std::array<float, 3> centre{};
  float radius = 0.0F;
};

// Some of the spheres of one link that are neighbours.
struct BallGroup {
  std::size_t body = 0;
  Ball bound;
  std::size_t first = 0, end = 0;  // in Program::balls
};

// The spheres of one link.
struct Part {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  std::size_t body = 0;
  std::size_t link = kNone;  // of the robot; a mesh of the world has none
  Ball bound;
  std::size_t first = 0, end = 0;              // in Program::balls
  std::size_t first_group = 0, end_group = 0;  // in Program::groups
  std::vector<std::uint32_t> obstacles;        // that it can come near to at all, in Program::solids
};

struct Solid {
  enum class Kind : std::uint8_t { Box, Cylinder, Sphere };
  Kind kind = Kind::Box;
  std::array<float, 3> centre{};
  std::array<float, 9> rows{};  // of the rotation into its own frame
  std::array<float, 3> half{};  // box: half sides; cylinder: radius, half length; sphere: radius
};

struct Program {
  std::size_t columns = 0;
  std::vector<BodyStep> steps;
  std::vector<Ball> balls;
  std::vector<BallGroup> groups;
  std::vector<Part> parts;  // those that move first, the farthest from the root first of all
  std::size_t moving_parts = 0;
  std::size_t moving_balls = 0, moving_groups = 0;  // those of the parts that move: the first ones
  std::vector<Solid> solids;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;  // of parts to check with each other
};

// Cephes' parts of pi / 2 for the reduction of angles, and Taylor's sums, good to 3e-7 for angles up to 1000
// rad.
inline constexpr float kTwoOverPi = 0.636619772F;
inline constexpr std::array kHalfPi{1.5703125F, 4.837512969970703125e-4F, 7.54978995489188e-8F};
inline constexpr std::array kSine{-1.0F / 6.0F, 1.0F / 120.0F, -1.0F / 5040.0F, 1.0F / 362880.0F};
inline constexpr std::array kCosine{-0.5F, 1.0F / 24.0F, -1.0F / 720.0F, 1.0F / 40320.0F};

// Both write 1 or 0 for each configuration, row after row of `columns` numbers. `any` ends at the first batch
// with a collision; what is then not looked at stays 0. They compute the same numbers in the same order, so
// they agree exactly, on every instruction set.
void check_scalar(const Program& program, const double* rows, std::size_t count, bool any,
                  std::uint8_t* collides);
void check_simd(const Program& program, const double* rows, std::size_t count, bool any,
                std::uint8_t* collides);

// How many configurations check_simd looks at together on this machine.
std::size_t simd_lanes();
// The instruction sets that this build and this machine have, and one of them to be used from now on (tests;
// not while another thread checks); 0: the best one.
std::vector<std::int64_t> simd_targets();
void choose_simd_target(std::int64_t target);
const char* simd_target_name(std::int64_t target);

}  // namespace stepwright::motion::internal
