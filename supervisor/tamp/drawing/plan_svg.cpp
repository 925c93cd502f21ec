#include "supervisor/tamp/drawing/plan_svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <vector>

#include "runtime/ground/markup/xml_text.h"

namespace stepwright::tamp::drawing {

namespace {

constexpr double kPixelsPerMetre = 500.0;
constexpr double kMargin_m = 0.1;
constexpr std::array kColours{"#2f6fb3", "#b3622f", "#3c8f4e", "#7b4fa0"};

template <typename... Arguments>
std::string printed(const char* format, Arguments... arguments) {
  std::array<char, 512> text{};
  std::snprintf(text.data(), text.size(), format, arguments...);
  return text.data();
}

// The robot looks upwards: x up, y to the left.
class Picture {
 public:
  explicit Picture(const scene::RobotCell& cell) {
    for (const scene::Furniture& each : cell.furniture) hold(each.pose, radius_around(each.form));
    for (const scene::Surface& each : cell.surfaces)
      hold(each.middle, 0.5 * std::hypot(each.size_x_m, each.size_y_m));
    for (const scene::Thing& each : cell.things) hold(each.start, radius_around(each.form));
    hold({}, 0.1);
  }

  double across(double y_m) const { return kPixelsPerMetre * (high_y_ + kMargin_m - y_m); }
  double down(double x_m) const { return kPixelsPerMetre * (high_x_ + kMargin_m - x_m); }

  void add(const scene::Form& form, const scene::Pose& pose, const std::string& style,
           const std::string& name) {
    if (form.round) {
      out_ += printed("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" %s/>\n", across(pose.y_m), down(pose.x_m),
                      kPixelsPerMetre * form.radius_m, style.c_str());
    } else {
      const double wide = kPixelsPerMetre * form.size_y_m, tall = kPixelsPerMetre * form.size_x_m;
      out_ += printed(
          "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" transform=\"rotate(%.2f %.1f %.1f)\" "
          "%s/>\n",
          across(pose.y_m) - 0.5 * wide, down(pose.x_m) - 0.5 * tall, wide, tall,
          -pose.angle_rad * 180.0 / std::numbers::pi, across(pose.y_m), down(pose.x_m), style.c_str());
    }
    if (!name.empty())
      out_ += printed("<text x=\"%.1f\" y=\"%.1f\">", across(pose.y_m) + 4.0, down(pose.x_m) - 4.0) +
              markup::xml_escaped(name) + "</text>\n";
  }

  void add_way(const scene::ArmModel& arm, const motion::JointPath& path, const char* colour) {
    out_ += "<polyline fill=\"none\" stroke=\"" + std::string(colour) + "\" points=\"";
    constexpr int kBetween = 8;
    for (std::size_t k = 1; k < path.size(); ++k)
      for (int part = k == 1 ? 0 : 1; part <= kBetween; ++part) {
        motion::Configuration q = path[k - 1];
        for (std::size_t j = 0; j < q.size(); ++j) q[j] += (path[k][j] - q[j]) * part / kBetween;
        const motion::Vector3 at = (arm.base * arm.chain.forward(q)).position_m;
        out_ += printed("%.1f,%.1f ", across(at.y), down(at.x));
      }
    out_ += "\"/>\n";
  }

  std::string text() const {
    const double wide = across(low_y_ - kMargin_m), tall = down(low_x_ - kMargin_m);
    return printed(
               "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" "
               "font-family=\"sans-serif\" font-size=\"11\">\n",
               wide, tall) +
           out_ + "</svg>\n";
  }

 private:
  void hold(const scene::Pose& pose, double around_m) {
    low_x_ = std::min(low_x_, pose.x_m - around_m);
    high_x_ = std::max(high_x_, pose.x_m + around_m);
    low_y_ = std::min(low_y_, pose.y_m - around_m);
    high_y_ = std::max(high_y_, pose.y_m + around_m);
  }

  double low_x_ = 0.0, high_x_ = 0.0, low_y_ = 0.0, high_y_ = 0.0;
  std::string out_;
};

}  // namespace

std::string plan_svg(const scene::RobotCell& cell, const scene::TampPlan& plan) {
  Picture picture(cell);
  for (const scene::Furniture& each : cell.furniture)
    picture.add(each.form, each.pose, "fill=\"#ece7df\" stroke=\"#9a938a\"", "");
  for (const scene::Surface& each : cell.surfaces)
    picture.add({false, 0.0, each.size_x_m, each.size_y_m, 0.0}, each.middle,
                "fill=\"none\" stroke=\"#7a7a7a\" stroke-dasharray=\"2 3\"", each.name);
  std::vector<std::optional<scene::Pose>> ends(cell.things.size());
  for (const scene::PlannedAction& each : plan.actions) {
    if (each.what.kind == scene::ActionKind::Place)
      ends[static_cast<std::size_t>(each.what.thing)] = each.pose;
    const auto arm = static_cast<std::size_t>(each.what.arm);
    for (const scene::Motion& motion : each.motions)
      if (motion.phase == scene::Phase::Transfer)
        picture.add_way(cell.arms[arm], motion.path, kColours[arm % kColours.size()]);
  }
  for (std::size_t k = 0; k < cell.things.size(); ++k) {
    const scene::Thing& thing = cell.things[k];
    picture.add(thing.form, thing.start, "fill=\"none\" stroke=\"#444\" stroke-dasharray=\"4 2\"",
                thing.name);
    if (ends[k]) picture.add(thing.form, *ends[k], "fill=\"#f3c969\" stroke=\"#444\"", thing.name);
  }
  return picture.text();
}

}  // namespace stepwright::tamp::drawing
