#pragma once

// Memory that the process holds. Budgets count everything that a call adds to it: ground tasks, heuristics
// and indices as well as the tables of the searches.
//
// Callable from any thread; a few microseconds.

#include <cstddef>

namespace stepwright::pddl {

// Bytes that are resident now; 0 if the system does not say.
std::size_t resident_bytes();

}  // namespace stepwright::pddl
