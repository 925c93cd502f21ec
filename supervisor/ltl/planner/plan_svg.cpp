#include "supervisor/ltl/planner/plan_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <span>

#include "runtime/ground/markup/xml_text.h"
#include "supervisor/geometry/box.h"
#include "supervisor/ltl/planner/plan_way.h"

namespace stepwright::ltl {

namespace {

using geometry::Point;

constexpr double kLongest = 1000.0, kMargin = 24.0, kHead = 40.0;
constexpr double kSweepEvery_s = 0.2;

constexpr const char* kStyle =
    "<style>text{font:12px "
    "system-ui,sans-serif;fill:#222}.head{font-weight:600;font-size:14px}.page{fill:#fff}"
    ".floor{fill:#f7f8f9;stroke:#6b737b}.wall{fill:#6b737b}.place{fill:#2f6fb5;fill-opacity:.18;stroke:#"
    "2f6fb5}"
    ".name{text-anchor:middle;paint-order:stroke;stroke:#fff;stroke-width:3px}"
    ".swept{fill:#d98b1f;fill-opacity:.12}.way{fill:none;stroke:#b3362b;stroke-width:1.6}"
    ".back{stroke-dasharray:5 "
    "3}.start{fill:none;stroke:#2c8a3f;stroke-width:1.6}.end{fill:none;stroke:#b3362b;"
    "stroke-width:1.6}"
    "@media(prefers-color-scheme:dark){text{fill:#e4e8eb}.page{fill:#16191c}.floor{fill:#20252a;stroke:#99a}"
    ".wall{fill:#4d555d}.name{stroke:#16191c}.way,.end{stroke:#ff6a50}.start{stroke:#6fd08a}}</style>\n";

class Picture {
 public:
  Picture(const Problem& problem, const TrainPlan& plan)
      : problem_(problem),
        plan_(plan),
        way_(way_of(problem.train, plan, kSweepEvery_s)),
        box_(geometry::bounds_of(problem.floor.border.ring)) {
    scale_ = kLongest / std::max({box_.high.x_m - box_.low.x_m, box_.high.y_m - box_.low.y_m, 1e-6});
  }

  std::string write() {
    const double wide = (box_.high.x_m - box_.low.x_m) * scale_ + 2 * kMargin;
    const double tall = (box_.high.y_m - box_.low.y_m) * scale_ + 2 * kMargin + kHead;
    print(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 "
        "{0:.0f} "
        "{1:.0f}\">\n{2}<rect class=\"page\" width=\"100%\" height=\"100%\"/>\n",
        wide, tall, kStyle);
    print("<text class=\"head\" x=\"{}\" y=\"{}\">{}</text>\n", kMargin, kMargin,
          markup::xml_escaped(title()));
    polygon("floor", problem_.floor.border.ring, {});
    for (const Area& each : problem_.floor.propositions) polygon("place", each.ring, each.name);
    sweep();
    for (const Area& each : problem_.floor.obstacles) polygon("wall", each.ring, each.name);
    for (const Area& each : problem_.floor.blocked) polygon("wall", each.ring, each.name);
    for (const Area& each : problem_.floor.propositions) name(each);
    draw_way();
    links("end", way_.back().state);
    links("start", way_.front().state);
    return text_ + "</svg>\n";
  }

 private:
  template <typename... Parts>
  void print(fmt::format_string<Parts...> form, Parts&&... parts) {
    fmt::format_to(std::back_inserter(text_), form, std::forward<Parts>(parts)...);
  }

  std::string title() const {
    std::string task = problem_.task.substr(0, 120);
    if (task.size() < problem_.task.size()) task += "...";
    return fmt::format("{}: {:.1f} m in {:.1f} s, {} trailers", task, plan_.length_m, plan_.duration_s(),
                       problem_.train.trailers);
  }

  // y points up on floors and down in pictures.
  std::string at(Point point) const {
    return fmt::format("{:.1f} {:.1f}", kMargin + (point.x_m - box_.low.x_m) * scale_,
                       kMargin + kHead + (box_.high.y_m - point.y_m) * scale_);
  }

  std::string outline(std::span<const Point> ring) const {
    std::string path;
    for (const Point& each : ring) path += (path.empty() ? "M" : "L") + at(each);
    return path + "Z";
  }

  void polygon(const char* kind, std::span<const Point> ring, const std::string& title) {
    print("<path class=\"{}\" d=\"{}\">", kind, outline(ring));
    if (!title.empty()) print("<title>{}</title>", markup::xml_escaped(title));
    text_ += "</path>\n";
  }

  void name(const Area& area) {
    const geometry::Box box = geometry::bounds_of(area.ring);
    const std::string place = at({0.5 * (box.low.x_m + box.high.x_m), 0.5 * (box.low.y_m + box.high.y_m)});
    print("<text class=\"name\" transform=\"translate({})\" dy=\"4\">{}</text>\n", place,
          markup::xml_escaped(area.name));
  }

  std::string link_outline(const LinkBox& box) const {
    const TrainModel& train = problem_.train;
    const double ahead = 0.5 * train.length_m, aside = 0.5 * train.width_m;
    const auto corner = [&](double along, double across) {
      return Point{box.middle.x_m + along * box.ahead.x_m - across * box.ahead.y_m,
                   box.middle.y_m + along * box.ahead.y_m + across * box.ahead.x_m};
    };
    const Point ring[] = {corner(ahead, aside), corner(-ahead, aside), corner(-ahead, -aside),
                          corner(ahead, -aside)};
    return outline(ring);
  }

  void links(const char* kind, const TrainState& state) {
    const LinkBoxes boxes = link_boxes(problem_.train, state);
    for (std::size_t k = 0; k < problem_.train.links(); ++k)
      print("<path class=\"{}\" d=\"{}\"/>\n", kind, link_outline(boxes[k]));
  }

  void sweep() {
    for (const WayState& each : way_) {
      const LinkBoxes boxes = link_boxes(problem_.train, each.state);
      std::string path;
      for (std::size_t k = 0; k < problem_.train.links(); ++k) path += link_outline(boxes[k]);
      print("<path class=\"swept\" d=\"{}\"/>\n", path);
    }
  }

  // Forwards in one line, in reverse in a dashed one.
  void draw_way() {
    for (std::size_t first = 0; first + 1 < way_.size();) {
      const bool back = in_reverse(first);
      std::size_t last = first + 1;
      while (last + 1 < way_.size() && in_reverse(last) == back) ++last;
      std::string path;
      for (std::size_t k = first; k <= last; ++k)
        path += (path.empty() ? "M" : "L") + at({way_[k].state[kTrainX], way_[k].state[kTrainY]});
      print("<path class=\"way{}\" d=\"{}\"/>\n", back ? " back" : "", path);
      first = last;
    }
  }

  bool in_reverse(std::size_t k) const {
    return way_[k].state[kTrainSpeed] + way_[k + 1].state[kTrainSpeed] < 0.0;
  }

  const Problem& problem_;
  const TrainPlan& plan_;
  std::vector<WayState> way_;
  geometry::Box box_;
  double scale_ = 1.0;
  std::string text_;
};

}  // namespace

std::string plan_svg(const Problem& problem, const TrainPlan& plan) {
  return Picture(problem, plan).write();
}

}  // namespace stepwright::ltl
