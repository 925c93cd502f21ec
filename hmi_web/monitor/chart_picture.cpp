#include "hmi_web/monitor/chart_picture.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "ladder/graphic/sfc_layout.h"
#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::monitor {
namespace {

using nlohmann::json;
using Indices = std::vector<std::uint32_t>;

// Every step is as wide as the names that its box shows, and two lines high.
constexpr graphic::SfcMetrics kMetrics{.margin = 14,
                                       .character = 7,
                                       .small_character = 0,
                                       .line = 16,
                                       .step_padding = 10,
                                       .step_padding_y = 5,
                                       .min_step_width = 190,
                                       .bar = 12,
                                       .text_gap = 5,
                                       .node_gap = 22,
                                       .channel_padding = 11,
                                       .track = 9,
                                       .overhang = 14,
                                       .arrow = 14,
                                       .condition_width = 1'000};
constexpr std::size_t kMostCharacters = 22;  // of a name or a condition

std::string cut(const std::string& text) {
  if (graphic::length_of(text) <= kMostCharacters) return text;
  std::size_t end = 0;
  for (std::size_t characters = 0; end < text.size(); ++end) {
    const bool begins = (static_cast<unsigned char>(text[end]) & 0xC0U) != 0x80U;
    if (begins && characters++ == kMostCharacters - 1) break;
  }
  return text.substr(0, end) + "\xE2\x80\xA6";  // an ellipsis
}

struct Chart {
  std::vector<protocol::ProgramStep> steps;
  std::vector<protocol::ProgramTransition> transitions;
};

// The steps that exist, counted from `first`.
Indices shifted(const Indices& steps, std::uint32_t first, std::size_t count) {
  Indices result;
  for (const std::uint32_t step : steps)
    if (step >= first && step - first < count) result.push_back(step - first);
  return result;
}

std::optional<Chart> find(const protocol::Program& program, std::string_view name) {
  if (name.empty()) return Chart{program.steps, program.transitions};
  std::uint32_t step = 0;
  std::uint32_t transition = 0;
  for (const protocol::ProgramChart& each : program.charts) {
    if (naming::same_name(each.name, name)) {
      Chart chart;
      const auto steps = program.steps.begin() + step;
      const auto transitions = program.transitions.begin() + transition;
      chart.steps.assign(steps, steps + each.steps);
      for (auto at = transitions; at != transitions + each.transitions; ++at) {
        chart.transitions.push_back(*at);
        chart.transitions.back().sources = shifted(at->sources, step, each.steps);
        chart.transitions.back().targets = shifted(at->targets, step, each.steps);
      }
      return chart;
    }
    step += each.steps;
    transition += each.transitions;
  }
  return std::nullopt;
}

// Steps that nothing leads out of and that only alternative branches lead into.
std::set<std::uint32_t> exits_of(const Chart& chart) {
  std::vector<int> ways(chart.steps.size(), 0);
  for (const auto& transition : chart.transitions)
    for (const std::uint32_t step : transition.sources) ++ways[step];
  std::set<std::uint32_t> exits;
  for (std::uint32_t i = 0; i < chart.steps.size(); ++i)
    if (ways[i] == 0 && !chart.steps[i].initial) exits.insert(i);
  for (const auto& transition : chart.transitions) {
    const bool alternative =
        std::ranges::any_of(transition.sources, [&](auto step) { return ways[step] > 1; });
    if (alternative) continue;
    for (const std::uint32_t step : transition.targets) exits.erase(step);
  }
  return exits;
}

// What is drawn, and where it stands in the whole chart.
struct Drawn {
  graphic::SfcChart chart;
  Indices steps;
  Indices transitions;
};

Drawn without(const Chart& chart, const std::set<std::uint32_t>& hidden) {
  Drawn drawn;
  std::vector<std::optional<graphic::StepId>> ids(chart.steps.size());
  for (std::uint32_t i = 0; i < chart.steps.size(); ++i) {
    if (hidden.contains(i)) continue;
    ids[i] = graphic::StepId(static_cast<std::uint32_t>(drawn.steps.size()));
    drawn.steps.push_back(i);
    // A comment stands for the second line of the box.
    drawn.chart.steps.push_back({cut(chart.steps[i].name), chart.steps[i].initial, {}, " ", {}, {}});
  }
  const auto kept = [&](const Indices& steps) {
    std::vector<graphic::StepId> list;
    for (const std::uint32_t step : steps)
      if (ids[step]) list.push_back(*ids[step]);
    return list;
  };
  for (std::uint32_t i = 0; i < chart.transitions.size(); ++i) {
    const protocol::ProgramTransition& each = chart.transitions[i];
    graphic::Transition transition;
    transition.name = each.name;
    transition.sources = kept(each.sources);
    transition.targets = kept(each.targets);
    if (transition.sources.empty() || (transition.targets.empty() && !each.targets.empty())) continue;
    transition.condition.kind = graphic::ConditionKind::Expression;
    transition.condition.name = cut(each.condition);
    drawn.chart.transitions.push_back(std::move(transition));
    drawn.transitions.push_back(i);
  }
  return drawn;
}

}  // namespace

json chart_picture(const protocol::Program& program, std::string_view name, const ExitChoice& choice) {
  const auto chart = find(program, name);
  if (!chart) return nullptr;
  const std::set<std::uint32_t> exits = exits_of(*chart);
  std::set<std::uint32_t> hidden;
  if (!choice.exits) std::ranges::set_difference(exits, choice.shown, std::inserter(hidden, hidden.end()));
  const Drawn drawn = without(*chart, hidden);
  graphic::SfcLayout layout;
  if (!drawn.chart.steps.empty()) layout = graphic::lay_out(drawn.chart, kMetrics);
  json picture = {{"width", layout.width}, {"height", layout.height}, {"exits", exits}};
  json& steps = picture["steps"] = json::array();
  for (const graphic::PlacedStep& each : layout.steps)
    steps.push_back({{"index", drawn.steps[each.step.value]},
                     {"x", each.x},
                     {"y", each.y},
                     {"width", each.width},
                     {"height", each.height},
                     {"entry", each.jumps.empty() ? json(nullptr) : json(each.top + kMetrics.line / 2)}});
  json& transitions = picture["transitions"] = json::array();
  for (const graphic::PlacedTransition& each : layout.transitions)
    transitions.push_back({{"index", drawn.transitions[each.transition]},
                           {"x", each.axis},
                           {"y", each.y},
                           {"label", drawn.chart.transitions[each.transition].condition.name}});
  json& jumps = picture["jumps"] = json::array();
  for (const graphic::PlacedJump& each : layout.jumps)
    jumps.push_back({{"step", drawn.steps[each.target.value]}, {"x", each.axis}, {"y", each.y}});
  json& lines = picture["lines"] = json::array();
  json& doubles = picture["doubles"] = json::array();
  for (const graphic::PlacedLine& each : layout.lines)
    (each.doubled ? doubles : lines).push_back({each.x1, each.y1, each.x2, each.y2});
  return picture;
}

}  // namespace stepwright::monitor
