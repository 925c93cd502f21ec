#pragma once

// The referee: z3 decides every instance from its envelopes alone, by integer difference logic with one
// disjunction for each pair of overlapping polygons. It shares with the scheduler only the test whether two
// polygons overlap.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tests/bench/fleet/instance.h"

namespace stepwright::bench::fleet {

enum class Ruling : std::uint8_t { Schedule, None, Unknown };

// One problem in SMT-LIB 2, from `reset` to `check-sat`.
std::string smt_text(const Instance& instance, stepwright::fleet::Mode mode);

// In one run of z3 over a file in `folder`; nothing if z3 did not answer for each.
std::optional<std::vector<Ruling>> decide(std::span<const std::string> problems, const std::string& folder,
                                          int seconds_each);

}  // namespace stepwright::bench::fleet
