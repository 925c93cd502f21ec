#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "runtime/ground/markup/xml_text.h"
#include "supervisor/run/report.h"

namespace stepwright::run {
namespace {

using markup::xml_escaped;

constexpr int kLeft = 230;
constexpr int kWidth = 960;
constexpr int kPlotWidth = kWidth - kLeft - 20;
constexpr int kTop = 44;
constexpr const char* kStyle =
    "<style>text{font:12px system-ui,sans-serif;fill:#222}.t{font-weight:600;font-size:14px}.g{stroke:#ddd}"
    ".p{fill:#b8bec6}.a{fill:#2f6f9f}.f{fill:#b4472f}.lp{fill:none;stroke:#8a9099;stroke-width:2}"
    ".la{fill:none;stroke:#2f6f9f;stroke-width:2}.r{stroke:#b4472f;stroke-dasharray:4 "
    "3}.m{text-anchor:middle}.e{text-anchor:end}</style>\n";

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

// One action of one plan; what a replaced plan never began is left out.
struct Row {
  const ActionRecord* action;
  double origin_s;  // of its plan's times, from the start of the run
  double ended_s;   // when its plan ended or was replaced
};

double end_of(const Row& row) {
  return row.action->finished_s.value_or(row.ended_s);
}

std::vector<Row> rows_of(const RunRecord& record) {
  std::vector<Row> rows;
  // What failed last has no plan after it, but mostly a replan that found none.
  const double stopped_s = record.replans.empty() ? 0.0 : record.replans.back().time_s;
  for (std::size_t i = 0; i < record.episodes.size(); ++i) {
    const Episode& episode = record.episodes[i];
    const bool last = i + 1 == record.episodes.size();
    const double ended_s = last ? std::max(record.finished_s, stopped_s) : record.episodes[i + 1].started_s;
    for (const ActionRecord& action : episode.actions) {
      if (!last && !action.started_s) continue;
      rows.push_back({&action, episode.started_s - record.started_s, ended_s});
    }
  }
  return rows;
}

std::string describe(const Incident& incident) {
  return fmt::format("{}: {} -> {} in {:.1f} ms, {} of {} actions kept", to_string(incident.kind),
                     fmt::join(incident.evidence, "; "), to_string(incident.response), incident.decision_ms,
                     incident.kept, incident.remaining);
}

}  // namespace

std::string gantt_svg(const RunRecord& record) {
  const std::vector<Row> rows = rows_of(record);
  if (rows.empty()) return opening(60, "no plan") + "</svg>\n";
  double span = 1e-3;
  for (const Row& row : rows) {
    span = std::max({span, row.origin_s + row.action->planned_finish_s,
                     row.action->started_s ? end_of(row) - record.started_s : 0.0});
  }
  const int bottom = kTop + 24 * static_cast<int>(rows.size());
  std::string svg =
      opening(bottom + 28,
              "Plan and execution (grey: planned, blue: actual, red: failed; dashed: replan, dot: incident)");
  add_time_axis(svg, span, bottom);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const ActionRecord& action = *rows[i].action;
    const int y = kTop + 24 * static_cast<int>(i);
    fmt::format_to(std::back_inserter(svg), "<text class=\"e\" x=\"{}\" y=\"{}\">{}</text>\n", kLeft - 8,
                   y + 13, xml_escaped(action.text));
    add_bar(svg, "p", rows[i].origin_s + action.planned_start_s, rows[i].origin_s + action.planned_finish_s,
            span, y + 1, "planned");
    if (!action.started_s) continue;
    add_bar(svg, action.state == ActionState::Failed ? "f" : "a", *action.started_s - record.started_s,
            end_of(rows[i]) - record.started_s, span, y + 10, to_string(action.state));
  }
  for (const Replan& replan : record.replans) {
    fmt::format_to(
        std::back_inserter(svg),
        "<line class=\"r\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"><title>{3}</title></line>\n",
        kLeft + std::clamp((replan.time_s - record.started_s) / span, 0.0, 1.0) * kPlotWidth, kTop - 6,
        bottom, xml_escaped(replan.cause));
  }
  for (const Incident& incident : record.incidents) {
    fmt::format_to(std::back_inserter(svg),
                   "<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{}\" r=\"4\"><title>{}</title></circle>\n",
                   incident.response == Response::SafeStop ? "f" : "a",
                   kLeft + std::clamp((incident.time_s - record.started_s) / span, 0.0, 1.0) * kPlotWidth,
                   kTop - 8, xml_escaped(describe(incident)));
  }
  return svg + "</svg>\n";
}

std::string cost_svg(const RunRecord& record) {
  const std::vector<Row> rows = rows_of(record);
  if (rows.empty()) return opening(60, "no plan") + "</svg>\n";
  double planned = 0.0, actual = 0.0, top = 1e-9;
  std::vector<std::pair<double, double>> sums;  // planned, actual
  for (const Row& row : rows) {
    if (!row.action->started_s) continue;  // of a plan that was replaced
    planned += row.action->planned_cost;
    actual += row.action->actual_cost.value_or(0.0);
    sums.emplace_back(planned, actual);
    top = std::max({top, planned, actual});
  }
  constexpr int kHeight = 260;
  constexpr int kBottom = kTop + kHeight;
  std::string svg =
      opening(kBottom + 36, "Cost summed over the steps that were begun (grey: planned, blue: actual)");
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
    fmt::format_to(std::back_inserter(actual_points), "{:.1f},{:.1f} ", x_of(i), y_of(sums[i].second));
    fmt::format_to(out, "<text class=\"m\" x=\"{:.1f}\" y=\"{}\">{}</text>\n", x_of(i), kBottom + 18, i + 1);
  }
  fmt::format_to(out, "<polyline class=\"lp\" points=\"{}\"/>\n<polyline class=\"la\" points=\"{}\"/>\n",
                 planned_points, actual_points);
  return svg + "</svg>\n";
}

}  // namespace stepwright::run
