#pragma once

// Algorithm 2 of F. Lagriffoul, L. Karlsson, A. Saffiotti 2012 (SearchAndFilter), and its baseline: the same
// depth-first search without the filter. Instances are tried in one of four orders. A configuration counts
// when it is checked (the paper: when the motion planner is asked).
//
// Functions without state; any thread.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "supervisor/tamp/intervals/search/sequence_search.h"

namespace stepwright::bench {

enum class Order : std::uint8_t { Row, Halton, CentreOut, Random };
inline constexpr Order kOrders[] = {Order::Row, Order::Halton, Order::CentreOut, Order::Random};
const char* name_of(Order order);

struct PaperAnswer {
  tamp::SearchOutcome outcome = tamp::SearchOutcome::Exhausted;
  std::size_t configurations = 0;
  std::size_t programs = 0;  // linear programs of SearchAndFilter
  bool refuted = false;      // by the first filter
};

struct PaperLimits {
  std::size_t most_configurations = 20'000;
  double most_s = 5.0;
};

PaperAnswer search_and_filter(const tamp::WorkCell& cell, std::span<const tamp::Action> sequence,
                              const tamp::Discretisation& how, const tamp::Checker& check, Order order,
                              double epsilon, const PaperLimits& limits = {});
PaperAnswer depth_first(const tamp::WorkCell& cell, std::span<const tamp::Action> sequence,
                        const tamp::Discretisation& how, const tamp::Checker& check, Order order,
                        const PaperLimits& limits = {});

}  // namespace stepwright::bench
