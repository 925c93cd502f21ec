#include "supervisor/translate/plan_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "runtime/ground/markup/xml_text.h"
#include "supervisor/translate/internal/causal_layout.h"

namespace stepwright::translate {
namespace {

using internal::CausalPlace;
using markup::xml_escaped;

constexpr double kLetter = 7.3;  // px, of a wide system font at 12 px
constexpr int kMargin = 20;
constexpr int kPlot = 690;
constexpr int kRow = 22;
constexpr int kTop = 78;
constexpr int kGap = 32;  // between two columns
constexpr int kLine = 44;
constexpr int kBoxHeight = 34;
constexpr int kBandGap = 34;
constexpr std::size_t kMostLetters = 64;     // of a label
constexpr std::size_t kMostBoxLetters = 34;  // of a line in a box
constexpr const char* kStyle =
    "<style>text{font:12px system-ui,sans-serif;fill:#222}.t{font-weight:600;font-size:14px}.page{fill:#fff}"
    ".g{stroke:#ddd}.e{text-anchor:end}.m{text-anchor:middle}.slack{fill:#dce2e9}.bar{fill:#2f6f9f}"
    ".critical{stroke:#14324a;stroke-width:2}.box{fill:#fff;stroke:#2f6f9f}.hot{stroke:#14324a;"
    "stroke-width:2.5}path{fill:none}.causal{stroke:#2f6f9f}.threat{stroke:#b4472f;stroke-dasharray:5 3}"
    ".resource{stroke:#8a6d1f;stroke-dasharray:2 3}.listed{stroke:#999}"
    "@media(prefers-color-scheme:dark){text{fill:#e4e8eb}.page{fill:#16191c}.g{stroke:#343b41}"
    ".slack{fill:#343b41}.bar{fill:#3f83c4}.critical{stroke:#cfe2f8}.box{fill:#1f2428;stroke:#4a94e8}"
    ".hot{stroke:#cfe2f8}.causal{stroke:#4a94e8}.threat{stroke:#f2776d}.resource{stroke:#e3a23f}}"
    "</style>\n";

std::string shortened(const std::string& text, std::size_t most) {
  return text.size() <= most ? text : text.substr(0, most - 1) + "…";
}

std::string arguments_of(const model::GroundAction& action) {
  std::string text;
  for (const std::string& argument : action.arguments) text += (text.empty() ? "" : " ") + argument;
  return text;
}

std::string label(std::size_t i, const std::string& text) {
  return std::to_string(i + 1) + " " + text;
}

int width_of(std::size_t letters) {
  return static_cast<int>(std::ceil(static_cast<double>(letters) * kLetter));
}

class Picture {
 public:
  Picture(const model::PlannedRun& run, const Schedule& schedule, const std::string& unit)
      : run_(run), schedule_(schedule), unit_(unit), rows_(static_cast<int>(run.actions.size())) {
    measure();
    const int columns = std::max(1, (width_ - 2 * kMargin + kGap) / (box_width_ + kGap));
    layout_ = internal::causal_layout(schedule, columns);
    graph_top_ = kTop + kRow * rows_ + 60;
    int top = graph_top_ + 40;
    for (const int lines : layout_.lines) {
      band_top_.push_back(top);
      top += lines * kLine + kBandGap;
    }
    height_ = top + 6;
  }

  std::string draw() {
    print(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
        "role=\"img\">\n{2}<rect class=\"page\" width=\"100%\" height=\"100%\"/>\n<text class=\"t\" "
        "x=\"{3}\" y=\"24\">Schedule: {4:.1f} {5}</text>\n",
        width_, height_, kStyle, kMargin, schedule_.makespan_s, xml_escaped(unit_));
    schedule_key();
    axis();
    for (int i = 0; i < rows_; ++i) bar(static_cast<std::size_t>(i));
    print("<text class=\"t\" x=\"{}\" y=\"{}\">Causal graph</text>\n", kMargin, graph_top_);
    graph_key();
    for (std::size_t i = 0; i < schedule_.links.size(); ++i) arrow(schedule_.links[i], static_cast<int>(i));
    for (int i = 0; i < rows_; ++i) box(static_cast<std::size_t>(i));
    return svg_ + "</svg>\n";
  }

 private:
  template <typename... Args>
  void print(const char* format, const Args&... args) {
    fmt::format_to(std::back_inserter(svg_), fmt::runtime(format), args...);
  }

  // Names decide how wide the labels and the boxes are.
  void measure() {
    std::size_t row = 0, inside = 12;
    for (std::size_t i = 0; i < run_.actions.size(); ++i) {
      const model::GroundAction& action = run_.actions[i].action;
      row = std::max(row, label(i, to_string(action)).size());
      inside = std::max({inside, label(i, action.name).size(), arguments_of(action).size()});
    }
    left_ = kMargin + width_of(std::min(row, kMostLetters)) + 8;
    box_width_ = width_of(std::min(inside, kMostBoxLetters)) + 16;
    width_ = left_ + kPlot + kMargin;
  }

  void schedule_key() {
    int x = kMargin;
    for (const auto& [kind, meaning] : {std::pair{"bar", "as early as it can run"},
                                        {"slack", "slack: it may end as late as this"},
                                        {"critical bar", "critical: what delays it delays the end"}}) {
      print(
          "<rect class=\"key {}\" x=\"{}\" y=\"35\" width=\"22\" height=\"12\"/><text x=\"{}\" "
          "y=\"46\">{}</text>\n",
          kind, x, x + 28, meaning);
      x += 28 + width_of(std::string(meaning).size()) + 12;
    }
  }

  // Only of the kinds of links that there are.
  void graph_key() {
    static constexpr std::array<std::pair<LinkKind, const char*>, 4> kMeanings = {
        {{LinkKind::Causal, "needs its effect"},
         {LinkKind::Threat, "would undo what it needs"},
         {LinkKind::Resource, "shares an output"},
         {LinkKind::Listed, "comes later in the list"}}};
    int x = kMargin;
    for (const auto& [kind, meaning] : kMeanings) {
      const bool used =
          std::any_of(schedule_.links.begin(), schedule_.links.end(),
                      [wanted = kind](const ScheduleLink& link) { return link.kind == wanted; });
      if (!used) continue;
      print(
          "<line class=\"key {0}\" x1=\"{1}\" x2=\"{2}\" y1=\"{3}\" y2=\"{3}\"/><text x=\"{4}\" "
          "y=\"{5}\">{6}</text>\n",
          to_string(kind), x, x + 26, graph_top_ + 18, x + 32, graph_top_ + 22, meaning);
      x += 32 + width_of(std::string(meaning).size()) + 12;
    }
  }

  double x_of(double time) const { return left_ + time / std::max(schedule_.makespan_s, 1e-9) * kPlot; }

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
          "x=\"{0:.1f}\" y=\"{3}\">{5:g} {6}</text><text class=\"m\" x=\"{0:.1f}\" y=\"{4}\">{5:g} "
          "{6}</text>\n",
          x_of(time), kTop - 4, bottom, kTop - 10, bottom + 16, time, xml_escaped(unit_));
    }
  }

  void bar(std::size_t i) {
    const ScheduledAction& times = schedule_.actions[i];
    const int y = kTop + kRow * static_cast<int>(i);
    print("<text class=\"e\" x=\"{}\" y=\"{}\">{}</text>\n", left_ - 8, y + 14,
          xml_escaped(shortened(label(i, to_string(run_.actions[i].action)), kMostLetters)));
    print("<rect class=\"slack\" x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" height=\"14\"/>\n",
          x_of(times.start_s), y + 3, std::max(0.0, x_of(times.latest_finish_s) - x_of(times.start_s)));
    print(
        "<rect class=\"bar{}\" x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" height=\"14\"><title>{}: {:.1f} to "
        "{:.1f} {}, slack {:.1f}</title></rect>\n",
        times.critical() ? " critical" : "", x_of(times.start_s), y + 3,
        std::max(1.0, x_of(times.finish_s) - x_of(times.start_s)),
        xml_escaped(to_string(run_.actions[i].action)), times.start_s, times.finish_s, xml_escaped(unit_),
        times.slack_s());
  }

  int box_x(std::size_t i) const { return kMargin + (box_width_ + kGap) * layout_.places[i].column; }
  int box_y(std::size_t i) const {
    const CausalPlace& place = layout_.places[i];
    return band_top_[static_cast<std::size_t>(place.band)] + kLine * place.line;
  }

  void box(std::size_t i) {
    const model::GroundAction& action = run_.actions[i].action;
    print(
        "<rect class=\"box{}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" "
        "rx=\"4\"><title>{}</title></rect>",
        schedule_.actions[i].critical() ? " hot" : "", box_x(i), box_y(i), box_width_, kBoxHeight,
        xml_escaped(to_string(action)));
    print(
        "<text class=\"m\" x=\"{0}\" y=\"{1}\">{2}</text><text class=\"m\" x=\"{0}\" "
        "y=\"{3}\">{4}</text>\n",
        box_x(i) + box_width_ / 2, box_y(i) + 14,
        xml_escaped(shortened(label(i, action.name), kMostBoxLetters)), box_y(i) + 29,
        xml_escaped(shortened(arguments_of(action), kMostBoxLetters)));
  }

  // To a later band the arrow goes through the gap above that band, so that it crosses no box.
  std::string way(const ScheduleLink& link, int index) const {
    const int x1 = box_x(link.before) + box_width_;
    const int y1 = box_y(link.before) + kBoxHeight / 2;
    const int x2 = box_x(link.after);
    const int y2 = box_y(link.after) + kBoxHeight / 2;
    const int band = layout_.places[link.after].band;
    if (layout_.places[link.before].band == band) {
      return fmt::format("M{0} {1} C{2} {1} {3} {4} {5} {4}", x1, y1, x1 + 20, x2 - 20, y2, x2);
    }
    const int lane = index % 5 * 3;  // some apart, so that they can be told from each other
    return fmt::format("M{} {} h{} V{} H{} V{} H{}", x1, y1, 6 + lane,
                       band_top_[static_cast<std::size_t>(band)] - 8 - lane, x2 - 8 - lane / 2, y2, x2);
  }

  void arrow(const ScheduleLink& link, int index) {
    std::string what = std::string(to_string(link.kind)) + ":";
    for (const std::string& atom : link.what) what += " " + atom;
    print("<path class=\"{}\" d=\"{} m-6 -4 l6 4 l-6 4\"><title>{}</title></path>\n", to_string(link.kind),
          way(link, index), xml_escaped(what));
  }

  const model::PlannedRun& run_;
  const Schedule& schedule_;
  const std::string& unit_;
  int rows_;
  int left_ = 0;
  int box_width_ = 0;
  int width_ = 0;
  int height_ = 0;
  int graph_top_ = 0;
  internal::CausalLayout layout_;
  std::vector<int> band_top_;
  std::string svg_;
};

}  // namespace

std::string plan_svg(const model::PlannedRun& run, const Schedule& schedule, const std::string& unit) {
  return Picture(run, schedule, unit).draw();
}

}  // namespace stepwright::translate
