#include "supervisor/motion/timing/internal/bernstein.h"

#include <algorithm>

namespace stepwright::motion::internal {

Polynomial product(const Polynomial& a, const Polynomial& b) {
  Polynomial made;
  made.degree = std::min(a.degree + b.degree, kMostDegree);
  for (std::size_t i = 0; i <= a.degree; ++i)
    for (std::size_t k = 0; k <= b.degree && i + k <= kMostDegree; ++k) made.c[i + k] += a.c[i] * b.c[k];
  return made;
}

Polynomial derivative(const Polynomial& of) {
  Polynomial made;
  made.degree = of.degree > 0 ? of.degree - 1 : 0;
  for (std::size_t k = 1; k <= of.degree; ++k) made.c[k - 1] = static_cast<double>(k) * of.c[k];
  return made;
}

std::array<double, kMostDegree + 1> bernstein(const Polynomial& of, std::size_t degree) {
  // b_k = sum over i of binomial(k, i) / binomial(degree, i) c_i, by differences that are all sums: the
  // scaled coefficients c_i / binomial(degree, i) are added up as in Pascal's triangle.
  std::array<double, kMostDegree + 1> b{};
  double binomial = 1.0;
  for (std::size_t i = 0; i <= std::min(degree, of.degree); ++i) {
    b[i] = of.c[i] / binomial;
    binomial = binomial * static_cast<double>(degree - i) / static_cast<double>(i + 1);
  }
  for (std::size_t round = 1; round <= degree; ++round)
    for (std::size_t k = degree; k >= round; --k) b[k] += b[k - 1];
  return b;
}

}  // namespace stepwright::motion::internal
