#pragma once

// Polynomials on 0 to 1 and certain bounds of them: the coefficients in Bernstein's basis, whose hull
// contains all values. Values; any thread.

#include <array>
#include <cstddef>

namespace stepwright::motion::internal {

inline constexpr std::size_t kMostDegree = 20;  // the quartic of a blend of a quintic in time

struct Polynomial {
  std::array<double, kMostDegree + 1> c{};  // of 1, x, x^2, ...
  std::size_t degree = 0;
};

Polynomial product(const Polynomial& a, const Polynomial& b);
Polynomial derivative(const Polynomial& of);

// Coefficients in Bernstein's basis of a degree that is not below the polynomial's own; the others are 0.
std::array<double, kMostDegree + 1> bernstein(const Polynomial& of, std::size_t degree);

}  // namespace stepwright::motion::internal
