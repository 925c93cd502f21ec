#include "supervisor/fleet/mission/internal/gantt_picture.h"

#include <algorithm>
#include <array>
#include <set>

#include "runtime/ground/markup/xml_text.h"
#include "supervisor/fleet/mission/explain_schedule.h"

namespace stepwright::fleet::internal {

namespace {

using std::chrono::milliseconds;

constexpr double kRow = 30.0;
constexpr double kBar = 10.0;  // two of them in a row, as neighbours overlap
constexpr double kLetter = 7.2;
constexpr std::size_t kMostLetters = 22;

std::string shortened(const std::string& name) {
  if (name.size() <= kMostLetters) return name;
  std::size_t end = kMostLetters - 1;
  while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80U) --end;  // within a letter
  return name.substr(0, end) + "…";
}

}  // namespace

GanttPicture::GanttPicture(const FleetPlan& plan, double width, double left, double top)
    : plan_(plan), left_(left), top_(top), bars_(left), width_(width) {
  std::size_t letters = 0;
  for (const VehicleMission& mission : plan.missions) {
    letters = std::max(letters, std::min(mission.vehicle.size(), kMostLetters));
  }
  bars_ = left + 14.0 + kLetter * static_cast<double>(letters);
  width_ = width - (bars_ - left);
  for (const VehicleTimes& times : plan.schedule.earliest) span_ = std::max(span_, times.back().exit);
}

double GanttPicture::height() const {
  return kRow * static_cast<double>(plan_.missions.size()) + 34.0;
}

double GanttPicture::x(milliseconds time) const {
  return bars_ + width_ * static_cast<double>(time.count()) / static_cast<double>(span_.count());
}

void GanttPicture::draw_axis(SvgPage& page) const {
  constexpr std::array<int, 12> kSteps_s = {1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 1800, 3600};
  milliseconds step{7'200'000};
  for (const int s : kSteps_s) {
    if (span_ / milliseconds(1000 * s) <= 14) {
      step = milliseconds(1000 * s);
      break;
    }
  }
  const double bottom = top_ + kRow * static_cast<double>(plan_.missions.size());
  for (milliseconds t{0}; t <= span_; t += step) {
    page.print(
        "<path class=\"g\" d=\"M{0:.1f} {1:.1f}V{2:.1f}\"/><text class=\"m\" x=\"{0:.1f}\" "
        "y=\"{3:.1f}\">{4}:{5:02}</text>\n",
        x(t), top_, bottom, bottom + 18.0, t.count() / 60000, t.count() / 1000 % 60);
  }
}

void GanttPicture::draw_row(SvgPage& page, std::size_t v) const {
  const double row = top_ + kRow * static_cast<double>(v) + 4.0;
  const VehicleMission& mission = plan_.missions[v];
  std::set<std::uint32_t> ordered;
  for (const Precedence& order : plan_.schedule.precedences) {
    if (order.first.vehicle == v) ordered.insert(order.first.polygon);
    if (order.second.vehicle == v) ordered.insert(order.second.polygon);
  }
  page.print(
      "<text class=\"name\" style=\"--hue:{}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n<g style=\"--hue:{}\">",
      hue(v), left_, row + 15.0, markup::xml_escaped(shortened(mission.vehicle)), hue(v));
  const VehicleTimes& times = plan_.schedule.earliest[v];
  for (std::uint32_t k = 0; k < times.size(); ++k) {
    const double begin = x(times[k].entry);
    const double wide = std::max(x(times[k].exit) - begin, 1.5);
    page.print(
        "<rect class=\"bar{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"><title>{} "
        "polygon {}: {} to {}</title></rect>",
        ordered.contains(k) ? " hot" : "", begin, row + (k % 2 == 0 ? 0.0 : kBar + 1.0), wide, kBar,
        markup::xml_escaped(mission.vehicle), k, clock_time(times[k].entry), clock_time(times[k].exit));
  }
  page.print("</g>\n");
}

void GanttPicture::draw_waits(SvgPage& page) const {
  for (const Wait& wait : waits_of(plan_)) {
    const double row = top_ + kRow * static_cast<double>(wait.waiting) + 4.0;
    page.print(
        "<rect class=\"wait\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"3\"><title>{} waits for "
        "{}</title></rect>\n",
        x(wait.from), row + 2.0 * kBar + 2.0, x(wait.until) - x(wait.from),
        markup::xml_escaped(plan_.missions[wait.waiting].vehicle),
        markup::xml_escaped(plan_.missions[wait.first].vehicle));
  }
}

void GanttPicture::draw(SvgPage& page) const {
  draw_axis(page);
  for (std::size_t v = 0; v < plan_.missions.size(); ++v) draw_row(page, v);
  draw_waits(page);
}

}  // namespace stepwright::fleet::internal
