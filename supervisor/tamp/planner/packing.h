#pragma once

// Places for several round things on one rectangle at once, as far from each other as they can be, instead of
// one after the other. Corners first: every place touches sides of the rectangle or the circles of things
// that have one. And a bound: a rectangle cut into k parts, each narrower than two things need between their
// middles, takes no more than k.
//
// Pure functions; any thread. Metres, in the rectangle's own frame, from its middle.
//
//   const auto places = spread({.size_x_m = 0.16, .size_y_m = 0.16, .radii_m = {0.035, 0.035}});

#include <cstddef>
#include <optional>
#include <vector>

namespace stepwright::tamp::planner {

struct PlanePoint {
  double x_m = 0.0, y_m = 0.0;
};

struct PackProblem {
  double size_x_m = 0.0, size_y_m = 0.0;
  std::vector<double> radii_m;       // of what is to be placed
  std::vector<PlanePoint> standing;  // what stands there already, and stays
  std::vector<double> standing_radii_m;
  double apart_m = 0.0;  // between any two at least
};

// In the order of the radii; nothing: none was found.
std::optional<std::vector<PlanePoint>> pack(const PackProblem& problem, std::size_t most_nodes = 20'000);

// As `pack`, with as much between any two as was found, up to `most_m`. One thing alone is put in the middle,
// things of one size in rows where these do.
std::optional<std::vector<PlanePoint>> spread(PackProblem problem, double most_m = 0.04);

// No more things of this radius than that have room; proved. At least 1 where one fits.
std::size_t most_that_fit(double size_x_m, double size_y_m, double radius_m, double apart_m);

// Whether that many are more than that, in less time.
bool too_many(std::size_t count, double size_x_m, double size_y_m, double radius_m, double apart_m);

}  // namespace stepwright::tamp::planner
