#include "supervisor/fleet/mission/fleet_svg.h"

#include <algorithm>

#include "supervisor/fleet/mission/internal/floor_picture.h"
#include "supervisor/fleet/mission/internal/gantt_picture.h"

namespace stepwright::fleet {

namespace {

constexpr double kWidth = 1160.0;
constexpr double kMargin = 20.0;
constexpr double kHead = 74.0;
constexpr double kBetween = 54.0;
constexpr const char* kStyle =
    "<style>text{font:12px "
    "system-ui,sans-serif;fill:#222}.t{font-weight:600;font-size:15px}.m{text-anchor:middle}"
    ".page{fill:#fff}.floor{fill:#f7f8f9}.wall{fill:#6b737b}.g{stroke:#dde1e5}path{fill:none}"
    "path.wall{fill:#6b737b;stroke:#6b737b;stroke-width:.5}"
    "path.envelope{fill:var(--hue);fill-opacity:.12;stroke:var(--hue);stroke-opacity:.35;"
    "stroke-width:.6}path.section{fill:#c4321f;fill-opacity:.28}.way{stroke:var(--hue);stroke-width:1.8}"
    ".back{stroke-dasharray:5 "
    "3}.start{fill:var(--hue);stroke:#fff;stroke-width:1}.stop{fill:#fff;fill-opacity:.75;"
    "stroke:var(--hue);stroke-width:1.6}.name{font-weight:600;fill:var(--hue);paint-order:stroke;stroke:#fff;"
    "stroke-width:3px}.place{fill:#444;paint-order:stroke;stroke:#fff;stroke-width:3px}.bar{fill:var(--hue);"
    "fill-opacity:.45}.hot{fill-opacity:.95}.wait{fill:#c4321f}.legend{font-size:12px}"
    "@media(prefers-color-scheme:dark){text{fill:#e4e8eb}.page{fill:#16191c}.floor{fill:#20252a}"
    "path.wall{fill:#4d555d;stroke:#4d555d}.g{stroke:#343b41}.stop{fill:#16191c}.name,.place{stroke:#16191c}."
    "place{fill:#"
    "c6ccd1}"
    ".start{stroke:#16191c}path.section{fill:#ff6a50}.wait{fill:#ff6a50}}</style>\n";

using internal::SvgPage;

std::string title_of(const FleetPlan& plan) {
  const Schedule& made = plan.schedule;
  std::size_t polygons = 0;
  for (const VehicleMission& mission : plan.missions) polygons += mission.grown.envelope.polygons.size();
  if (made.earliest.empty())
    return fmt::format("{} vehicles, {} polygons, no schedule", plan.missions.size(), polygons);
  std::chrono::milliseconds end{0};
  for (const VehicleTimes& times : made.earliest) end = std::max(end, times.back().exit);
  return fmt::format("{} vehicles, {} polygons, {} precedences, done after {}", plan.missions.size(),
                     polygons, made.precedences.size(), internal::clock_time(end));
}

void draw_legend(SvgPage& page, double top) {
  double at = kMargin;
  const auto entry = [&](std::string_view mark, std::string_view words, double wide) {
    page.print(
        "<g transform=\"translate({:.1f} {:.1f})\" style=\"--hue:#2f6fb5\">{}<text class=\"legend\" x=\"30\" "
        "y=\"4\">{}</text></g>\n",
        at, top, mark, words);
    at += wide;
  };
  entry("<path class=\"start\" d=\"M2 -6H24V6H2Z\"/>", "start", 80);
  entry("<path class=\"stop\" d=\"M2 -6H24V6H2Z\"/>", "stop", 80);
  entry("<path class=\"way\" d=\"M0 0H26\"/>", "forward", 98);
  entry("<path class=\"way back\" d=\"M0 0H26\"/>", "in reverse", 112);
  entry("<path class=\"envelope\" d=\"M1 -7H25V7H1Z\"/>", "envelope", 104);
  entry("<path class=\"section\" d=\"M1 -7H25V7H1Z\"/>", "critical section", 140);
  entry("<rect class=\"bar\" x=\"1\" y=\"-6\" width=\"24\" height=\"10\"/>", "in a polygon", 122);
  entry("<rect class=\"bar hot\" x=\"1\" y=\"-6\" width=\"24\" height=\"10\"/>", "in one with a precedence",
        192);
  entry("<rect class=\"wait\" x=\"1\" y=\"-2\" width=\"24\" height=\"3\"/>", "waits for another", 120);
}

}  // namespace

std::string fleet_svg(const FleetPlan& plan, const OccupancyGrid* map) {
  const double inner = kWidth - 2 * kMargin;
  const internal::FloorPicture floor(plan, map, inner, kMargin, kHead);
  const bool timed = !plan.schedule.earliest.empty();
  const double below = kHead + floor.height() + kBetween;
  const internal::GanttPicture gantt(plan, inner - 14.0, kMargin, below);
  const double height = timed ? below + gantt.height() + kMargin : kHead + floor.height() + kMargin;
  SvgPage page;
  page.print(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
      "{1:.0f}\" "
      "role=\"img\">\n{2}<rect class=\"page\" width=\"100%\" height=\"100%\"/>\n<text class=\"t\" "
      "x=\"{3:.0f}\" "
      "y=\"28\">{4}</text>\n",
      kWidth, height, kStyle, kMargin, title_of(plan));
  draw_legend(page, 54.0);
  if (!plan.missions.empty()) floor.draw(page);
  if (timed) {
    page.print(
        "<text class=\"t\" x=\"{:.0f}\" y=\"{:.1f}\">Who is in which polygon when, as early as can "
        "be</text>\n",
        kMargin, below - 14.0);
    gantt.draw(page);
  }
  page.print("</svg>\n");
  return page.take();
}

}  // namespace stepwright::fleet
