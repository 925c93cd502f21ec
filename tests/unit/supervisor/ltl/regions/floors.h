#pragma once

// Floors of tests: rectangles on whole metres, so that what is true of them can be counted in squares.

#include <random>
#include <string>
#include <utility>
#include <vector>

#include "supervisor/ltl/regions/make_regions.h"

namespace stepwright::ltl::testing {

struct Rectangle {
  int left, low, right, high;

  bool has(int x, int y) const { return x >= left && x < right && y >= low && y < high; }
  bool overlaps(const Rectangle& other) const {
    return left < other.right && other.left < right && low < other.high && other.low < high;
  }
  Area area(std::string name) const {
    const double a = left, b = low, c = right, d = high;
    return {std::move(name), {{a, b}, {c, b}, {c, d}, {a, d}}, {"floor.json", 3, 5}};
  }
};

inline constexpr int kSize = 20;

// What a floor consists of, and the floor.
struct Squares {
  std::vector<Rectangle> obstacles;
  std::vector<Rectangle> propositions;

  Floor floor() const {
    Floor made;
    made.border = Rectangle{0, 0, kSize, kSize}.area("border");
    for (std::size_t k = 0; k < obstacles.size(); ++k)
      made.obstacles.push_back(obstacles[k].area("o" + std::to_string(k)));
    for (std::size_t k = 0; k < propositions.size(); ++k)
      made.propositions.push_back(propositions[k].area("p" + std::to_string(k)));
    return made;
  }
  bool is_free(int x, int y) const {
    for (const Rectangle& each : obstacles)
      if (each.has(x, y)) return false;
    return true;
  }
  Label label(int x, int y) const {
    Label found = 0;
    for (std::size_t k = 0; k < propositions.size(); ++k)
      if (propositions[k].has(x, y)) found |= Label{1} << k;
    return found;
  }
};

// Outlines touch, overlap and line up often on so few metres.
inline Squares random_squares(std::uint32_t seed) {
  std::mt19937 dice(seed);
  const auto rectangle = [&] {
    const int left = static_cast<int>(dice() % (kSize - 1)), low = static_cast<int>(dice() % (kSize - 1));
    const int wide = 1 + static_cast<int>(dice() % 5), high = 1 + static_cast<int>(dice() % 5);
    return Rectangle{left, low, std::min(left + wide, kSize), std::min(low + high, kSize)};
  };
  Squares made;
  const std::size_t obstacles = dice() % 12, propositions = dice() % 6;
  for (std::size_t k = 0; k < obstacles; ++k) made.obstacles.push_back(rectangle());
  for (std::size_t k = 0; k < propositions; ++k) {
    const Rectangle each = rectangle();
    bool meets = false;
    for (const Rectangle& obstacle : made.obstacles) meets |= each.overlaps(obstacle);
    if (!meets) made.propositions.push_back(each);
  }
  return made;
}

}  // namespace stepwright::ltl::testing
