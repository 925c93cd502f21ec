#pragma once

// Model of a scheduling problem for the search: constraints that always hold, and sections, each of which
// adds one or the other set of constraints. It knows neither vehicles nor polygons. Values; any thread.

#include <cstdint>
#include <span>
#include <vector>

#include "supervisor/fleet/network/constraint.h"

namespace stepwright::fleet::internal {

// One of the two orders of a section: side 0 says that its first vehicle comes first.
struct Literal {
  std::uint32_t value = 0;

  static Literal of(std::size_t section, int side) {
    return {static_cast<std::uint32_t>(2 * section + static_cast<std::size_t>(side))};
  }
  std::uint32_t section() const { return value / 2; }
  int side() const { return static_cast<int>(value & 1U); }
  Literal operator~() const { return {value ^ 1U}; }
  friend bool operator==(Literal, Literal) = default;
};

struct SearchModel {
  std::size_t timepoints = 1;
  std::vector<Constraint> base;  // labels below first_literal_label
  // Constraints of all literals in their order; each has the label of its literal.
  std::vector<Constraint> edges;
  std::vector<std::uint32_t> edge_begin = {0};
  std::uint32_t first_literal_label = 0;
  // When each of the two enters the section.
  struct Entries {
    Timepoint side[2];
  };
  std::vector<Entries> entries;

  std::size_t sections() const { return entries.size(); }
  std::span<const Constraint> edges_of(Literal l) const {
    return std::span(edges).subspan(edge_begin[l.value], edge_begin[l.value + 1] - edge_begin[l.value]);
  }
  std::uint32_t label_of(Literal l) const { return first_literal_label + l.value; }
  bool is_literal(std::uint32_t label) const { return label >= first_literal_label; }
  Literal literal_of(std::uint32_t label) const { return {label - first_literal_label}; }
};

// Measure to be minimised, a function of the ends of vehicles.
enum class Measure : std::uint8_t { None, Makespan, TotalTardiness };

struct SearchObjective {
  Measure measure = Measure::None;
  struct End {
    Timepoint timepoint;
    std::int32_t due_ms = 0;  // counted only as tardiness
  };
  std::vector<End> ends;
};

}  // namespace stepwright::fleet::internal
