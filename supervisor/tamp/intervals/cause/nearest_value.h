#pragma once

// The value of one number of a cell or sequence, nearest to the one that it has, with which the sequence has
// a solution. Bounds of reach are constant within their cells, so that only values count at which something
// comes into another cell: they are tried from the nearest on. From there on poses are asked of the arms
// themselves (reached.h), and a value is proved where they reach it. A function without state; any thread.

#include <cstddef>
#include <optional>
#include <span>

#include "supervisor/tamp/intervals/cause/cause.h"

namespace stepwright::tamp {

double value_of(const WorkCell& cell, std::span<const Action> sequence, Parameter parameter,
                std::size_t subject, std::size_t which);
void set_value(WorkCell& cell, std::vector<Action>& sequence, Parameter parameter, std::size_t subject,
               std::size_t which, double value);

struct NearestValue {
  double value = 0.0;
  bool proved = false;  // else it is a bound: no nearer value does, and from here on it is not known
};

// Rounded to 0.1 mm or 0.1 degrees away from the present value where that does, too. Nothing if there is
// none.
std::optional<NearestValue> nearest_value(const WorkCell& cell, std::span<const Action> sequence,
                                          Parameter parameter, std::size_t subject, std::size_t which,
                                          const CauseOptions& options);

}  // namespace stepwright::tamp
