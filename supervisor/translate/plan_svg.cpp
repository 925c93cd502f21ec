#include "supervisor/translate/plan_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "ladder/graphic/svg_writer.h"

namespace stepwright::translate {
namespace {

using graphic::xml_escaped;

constexpr int kLeft = 250;
constexpr int kPlot = 690;
constexpr int kRow = 22;
constexpr int kTop = 44;
constexpr int kColumn = 190;
constexpr int kBoxWidth = 160;
constexpr int kLine = 44;
constexpr const char* kStyle =
    "<style>text{font:12px system-ui,sans-serif;fill:#222}.t{font-weight:600;font-size:14px}.g{stroke:#ddd}"
    ".e{text-anchor:end}.m{text-anchor:middle}.slack{fill:#e3e7ec}.bar{fill:#2f6f9f}.critical{stroke:#14324a;"
    "stroke-width:2}.box{fill:#fff;stroke:#2f6f9f}.hot{stroke:#14324a;stroke-width:2.5}path{fill:none}"
    ".causal{stroke:#2f6f9f}.threat{stroke:#b4472f;stroke-dasharray:5 3}.resource{stroke:#8a6d1f;"
    "stroke-dasharray:2 3}.listed{stroke:#999}</style>\n";

class Picture {
 public:
  Picture(const model::PlannedRun& run, const Schedule& schedule, const std::string& unit)
      : run_(run), schedule_(schedule), unit_(unit), rows_(static_cast<int>(run.actions.size())) {
    place();
  }

  std::string draw() {
    const int graph_top = kTop + kRow * rows_ + 60;
    const int width = std::max(kLeft + kPlot + 20, 40 + kColumn * columns_);
    const int height = graph_top + 30 + kLine * lines_ + 40;
    print(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" role=\"img\">\n{}"
        "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n<text class=\"t\" x=\"16\" y=\"24\">Schedule: "
        "{:.1f} "
        "{} (pale: slack, framed: critical)</text>\n",
        width, height, kStyle, schedule_.makespan_s, xml_escaped(unit_));
    axis();
    for (int i = 0; i < rows_; ++i) bar(static_cast<std::size_t>(i));
    print(
        "<text class=\"t\" x=\"16\" y=\"{}\">Causal graph (blue: needs, red: would undo, brown: shares an "
        "output)"
        "</text>\n",
        graph_top);
    for (const ScheduleLink& link : schedule_.links) arrow(link, graph_top + 20);
    for (int i = 0; i < rows_; ++i) box(static_cast<std::size_t>(i), graph_top + 20);
    return svg_ + "</svg>\n";
  }

 private:
  template <typename... Args>
  void print(const char* format, const Args&... args) {
    fmt::format_to(std::back_inserter(svg_), fmt::runtime(format), args...);
  }

  // Column: the longest way from an action without predecessor; line: the first free one of the column.
  void place() {
    column_.assign(run_.actions.size(), 0);
    line_.assign(run_.actions.size(), 0);
    std::vector<int> used;
    for (std::size_t i = 0; i < run_.actions.size(); ++i) {
      for (const ScheduleLink& link : schedule_.links) {
        if (link.after == i) column_[i] = std::max(column_[i], column_[link.before] + 1);
      }
      const auto column = static_cast<std::size_t>(column_[i]);
      if (used.size() <= column) used.resize(column + 1, 0);
      line_[i] = used[column]++;
      lines_ = std::max(lines_, used[column]);
    }
    columns_ = static_cast<int>(used.size());
  }

  double x_of(double time) const { return kLeft + time / std::max(schedule_.makespan_s, 1e-9) * kPlot; }

  void axis() {
    const double rough = std::max(schedule_.makespan_s, 1e-9) / 8;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    double step = 10 * power;
    for (const double factor : {5.0, 2.0, 1.0}) {
      if (factor * power >= rough) step = factor * power;
    }
    const int bottom = kTop + kRow * rows_;
    for (double time = 0.0; time <= schedule_.makespan_s * 1.0001; time += step) {
      print(
          "<line class=\"g\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/><text class=\"m\" "
          "x=\"{0:.1f}\" "
          "y=\"{3}\">{4:g} {5}</text>\n",
          x_of(time), kTop - 6, bottom, bottom + 16, time, xml_escaped(unit_));
    }
  }

  void bar(std::size_t i) {
    const ScheduledAction& times = schedule_.actions[i];
    const int y = kTop + kRow * static_cast<int>(i);
    print("<text class=\"e\" x=\"{}\" y=\"{}\">{} {}</text>\n", kLeft - 8, y + 14, i + 1,
          xml_escaped(to_string(run_.actions[i].action)));
    print("<rect class=\"slack\" x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" height=\"14\"/>\n",
          x_of(times.start_s), y + 3, std::max(0.0, x_of(times.latest_finish_s) - x_of(times.start_s)));
    print(
        "<rect class=\"bar{}\" x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" height=\"14\"><title>{:.1f} to {:.1f} "
        "{}, slack "
        "{:.1f}</title></rect>\n",
        times.critical() ? " critical" : "", x_of(times.start_s), y + 3,
        std::max(1.0, x_of(times.finish_s) - x_of(times.start_s)), times.start_s, times.finish_s,
        xml_escaped(unit_), times.slack_s());
  }

  int box_x(std::size_t i) const { return 20 + kColumn * column_[i]; }
  int box_y(std::size_t i, int top) const { return top + kLine * line_[i]; }

  void box(std::size_t i, int top) {
    const model::GroundAction& action = run_.actions[i].action;
    std::string arguments;
    for (const std::string& argument : action.arguments)
      arguments += (arguments.empty() ? "" : " ") + argument;
    print("<rect class=\"box{}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"34\" rx=\"4\"/>",
          schedule_.actions[i].critical() ? " hot" : "", box_x(i), box_y(i, top), kBoxWidth);
    print(
        "<text class=\"m\" x=\"{0}\" y=\"{1}\">{2} {3}</text><text class=\"m\" x=\"{0}\" "
        "y=\"{4}\">{5}</text>\n",
        box_x(i) + kBoxWidth / 2, box_y(i, top) + 14, i + 1, xml_escaped(action.name), box_y(i, top) + 29,
        xml_escaped(arguments));
  }

  void arrow(const ScheduleLink& link, int top) {
    const int x1 = box_x(link.before) + kBoxWidth;
    const int y1 = box_y(link.before, top) + 17;
    const int x2 = box_x(link.after);
    const int y2 = box_y(link.after, top) + 17;
    std::string what = std::string(to_string(link.kind)) + ":";
    for (const std::string& atom : link.what) what += " " + atom;
    print(
        "<path class=\"{0}\" d=\"M{1} {2} C{3} {2} {4} {5} {6} {5} m-6 -4 l6 4 l-6 "
        "4\"><title>{7}</title></path>\n",
        to_string(link.kind), x1, y1, x1 + 24, x2 - 24, y2, x2, xml_escaped(what));
  }

  const model::PlannedRun& run_;
  const Schedule& schedule_;
  const std::string& unit_;
  int rows_;
  int columns_ = 0;
  int lines_ = 0;
  std::vector<int> column_;
  std::vector<int> line_;
  std::string svg_;
};

}  // namespace

std::string plan_svg(const model::PlannedRun& run, const Schedule& schedule, const std::string& unit) {
  return Picture(run, schedule, unit).draw();
}

}  // namespace stepwright::translate
