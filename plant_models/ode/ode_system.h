#pragma once

// A system of ordinary differential equations y' = f(t, y) that is smooth until a root function changes
// its sign. The solver calls it from inside step(): no heap, no exception.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace stepwright::ode {

class OdeSystem {
 public:
  virtual ~OdeSystem() = default;

  virtual std::size_t state_size() const = 0;
  virtual std::size_t root_count() const = 0;

  // Writes f(t, y). Called for states that are never reached, too: it must give finite numbers there and
  // must not change its own modes.
  virtual void derivative(double t, std::span<const double> y, std::span<double> dydt) const = 0;

  // For each derivative the states that it depends on, in ascending order; none at all: they are not known.
  // At set-up.
  virtual std::vector<std::vector<std::uint32_t>> dependencies() const { return {}; }

  // Writes root_count() continuous functions; a step ends where one of them changes its sign.
  virtual void roots(double t, std::span<const double> y, std::span<double> g) const = 0;
};

}  // namespace stepwright::ode
