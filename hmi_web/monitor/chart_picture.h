#pragma once

// The picture of running charts for a page: where steps, transitions, jumps and lines stand, in pixels. The
// layout is that of every drawing of a chart (ladder/graphic/sfc_layout.h), with boxes of one size.
//
//   json picture = chart_picture(program, "Main", {.exits = false, .shown = {7}});
//
// Pure; any thread.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string_view>

#include "hmi_web/protocol/program.h"

namespace stepwright::monitor {

// Generated charts have a step beside almost every action in which the chart ends when something goes wrong.
struct ExitChoice {
  bool exits = false;             // with them
  std::set<std::uint32_t> shown;  // without them, these are there all the same: steps of the chart
};

// Of the chart with that name, or of all charts together if it is empty; null if there is none. Numbers count
// in the chart.
nlohmann::json chart_picture(const protocol::Program& program, std::string_view chart,
                             const ExitChoice& choice);

}  // namespace stepwright::monitor
