#pragma once

// Sizes of the automata of the paper's tasks for 3 to 8 places, beside what is known of them: phi1 n + 1,
// phi2 as printed 1 + n + n (n - 1) / 2 + 1, phi3 2^n; phi2 in order 32, 196, 1722 for 3, 4, 5 (MONA; the
// unit test of the automata asks it). States from which the task can be done, at most one place at a time.
//
// A pure function. Example:
//   const AutomataSizes sizes = automata_sizes();

#include <cstddef>

namespace stepwright::bench {

struct AutomataSizes {
  std::size_t compared = 0;
  std::size_t mismatches = 0;
};

AutomataSizes automata_sizes();

}  // namespace stepwright::bench
