#pragma once

// Shorter paths: random places of a path are joined by straight motions where these are free.
//
//   const JointPath shorter = shorten(*checker, path, {.seed = 1});
//
// A function without state; any thread; the same for a seed on every machine. Never longer than it was, the
// same ends; every motion of it is free at places `step` apart, if those of the path given were.

#include <cstdint>

#include "supervisor/motion/path/free_space.h"
#include "supervisor/motion/path/path.h"

namespace stepwright::motion {

struct ShortenOptions {
  std::uint64_t seed = 1;
  double step = 0.02;  // between places that are checked, in each coordinate
  std::size_t tries = 200;
  std::size_t most_in_vain = 60;  // one after the other, then it ends
};

JointPath shorten(const FreeSpace& free, JointPath path, const ShortenOptions& options = {});
JointPath shorten(const CollisionChecker& checker, JointPath path, const ShortenOptions& options = {});

}  // namespace stepwright::motion
