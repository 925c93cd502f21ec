#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "ladder/graphic/svg_writer.h"
#include "supervisor/executive/report.h"

namespace stepwright::executive {
namespace {

using graphic::xml_escaped;

constexpr int kLeft = 230;
constexpr int kWidth = 960;
constexpr int kPlotWidth = kWidth - kLeft - 20;
constexpr int kTop = 44;
constexpr const char* kStyle =
    "<style>text{font:12px system-ui,sans-serif;fill:#222}.t{font-weight:600;font-size:14px}.g{stroke:#ddd}"
    ".p{fill:#b8bec6}.a{fill:#2f6f9f}.f{fill:#b4472f}.lp{fill:none;stroke:#8a9099;stroke-width:2}"
    ".la{fill:none;stroke:#2f6f9f;stroke-width:2}.m{text-anchor:middle}.e{text-anchor:end}</style>\n";

std::string opening(int height, const std::string& title) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" role=\"img\">\n{}"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n<text class=\"t\" x=\"16\" y=\"24\">{}</text>\n",
      kWidth, height, kStyle, xml_escaped(title));
}

// 1, 2 or 5 times a power of ten, so that about eight fit.
double tick_step(double span) {
  const double rough = std::max(span, 1e-9) / 8;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough) return factor * power;
  }
  return 10.0 * power;
}

void add_time_axis(std::string& svg, double span, int bottom) {
  for (double t = 0.0; t <= span * 1.0001; t += tick_step(span)) {
    const double x = kLeft + t / span * kPlotWidth;
    fmt::format_to(std::back_inserter(svg),
                   "<line class=\"g\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/>"
                   "<text class=\"m\" x=\"{0:.1f}\" y=\"{3}\">{4:g} s</text>\n",
                   x, kTop - 6, bottom, bottom + 16, t);
  }
}

void add_bar(std::string& svg, const char* style, double from, double to, double span, int y,
             const std::string& hint) {
  fmt::format_to(
      std::back_inserter(svg),
      "<rect class=\"{}\" x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" height=\"8\"><title>{}</title></rect>\n",
      style, kLeft + from / span * kPlotWidth, y, std::max(1.0, (to - from) / span * kPlotWidth),
      xml_escaped(hint));
}

}  // namespace

std::string gantt_svg(const RunRecord& record) {
  if (record.episodes.empty()) return opening(60, "no plan") + "</svg>\n";
  const Episode& episode = record.episodes.back();
  double span = episode.planned_makespan_s;
  for (const ActionRecord& action : episode.actions) {
    span = std::max({span, action.planned_finish_s, action.finished_s.value_or(0.0) - episode.started_s});
  }
  span = std::max(span, 1e-3);
  const int bottom = kTop + 24 * static_cast<int>(episode.actions.size());
  std::string svg = opening(bottom + 28, "Plan and execution (grey: planned, blue: actual)");
  add_time_axis(svg, span, bottom);
  for (std::size_t i = 0; i < episode.actions.size(); ++i) {
    const ActionRecord& action = episode.actions[i];
    const int y = kTop + 24 * static_cast<int>(i);
    fmt::format_to(std::back_inserter(svg), "<text class=\"e\" x=\"{}\" y=\"{}\">{}</text>\n", kLeft - 8,
                   y + 13, xml_escaped(action.text));
    add_bar(svg, "p", action.planned_start_s, action.planned_finish_s, span, y + 1, "planned");
    if (!action.started_s) continue;
    const double end = action.finished_s.value_or(record.finished_s);
    add_bar(svg, action.state == ActionState::Failed ? "f" : "a", *action.started_s - episode.started_s,
            end - episode.started_s, span, y + 10, to_string(action.state));
  }
  return svg + "</svg>\n";
}

std::string cost_svg(const RunRecord& record) {
  if (record.episodes.empty()) return opening(60, "no plan") + "</svg>\n";
  const std::vector<ActionRecord>& actions = record.episodes.back().actions;
  double planned = 0.0, actual = 0.0, top = 1e-9;
  std::vector<std::pair<double, double>> sums;  // planned, actual
  for (const ActionRecord& action : actions) {
    planned += action.planned_cost;
    actual += action.actual_cost.value_or(0.0);
    sums.emplace_back(planned, actual);
    top = std::max({top, planned, actual});
  }
  constexpr int kHeight = 260;
  constexpr int kBottom = kTop + kHeight;
  std::string svg = opening(kBottom + 36, "Cost summed over the steps (grey: planned, blue: actual)");
  const auto out = std::back_inserter(svg);
  const auto x_of = [&](std::size_t i) {
    return 60 + static_cast<double>(i + 1) / static_cast<double>(sums.size() + 1) * (kWidth - 80);
  };
  const auto y_of = [&](double cost) { return kBottom - cost / top * (kHeight - 10); };
  for (double cost = 0.0; cost <= top * 1.0001; cost += tick_step(top)) {
    fmt::format_to(out,
                   "<line class=\"g\" x1=\"60\" x2=\"{0}\" y1=\"{1:.1f}\" y2=\"{1:.1f}\"/>"
                   "<text class=\"e\" x=\"54\" y=\"{2:.1f}\">{3:g}</text>\n",
                   kWidth - 20, y_of(cost), y_of(cost) + 4, cost);
  }
  std::string planned_points, actual_points;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    fmt::format_to(std::back_inserter(planned_points), "{:.1f},{:.1f} ", x_of(i), y_of(sums[i].first));
    if (actions[i].actual_cost) {
      fmt::format_to(std::back_inserter(actual_points), "{:.1f},{:.1f} ", x_of(i), y_of(sums[i].second));
    }
    fmt::format_to(out, "<text class=\"m\" x=\"{:.1f}\" y=\"{}\">{}</text>\n", x_of(i), kBottom + 18, i + 1);
  }
  fmt::format_to(out, "<polyline class=\"lp\" points=\"{}\"/>\n<polyline class=\"la\" points=\"{}\"/>\n",
                 planned_points, actual_points);
  return svg + "</svg>\n";
}

}  // namespace stepwright::executive
