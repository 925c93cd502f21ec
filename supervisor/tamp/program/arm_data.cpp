#include "supervisor/tamp/program/arm_data.h"

#include <fmt/format.h>

#include <utility>

#include "supervisor/vehicle/data_tables.h"
#include "supervisor/vehicle/project_parts.h"

namespace stepwright::tamp::program {
namespace {

std::string list(std::span<const double> values) {
  std::string text;
  for (const double each : values) text += (text.empty() ? "" : ", ") + lreal_literal(each);
  return "[" + text + "]";
}

// Members that are zero are left out: that is what they are without a value.
class Members {
 public:
  void add(const char* name, double value) {
    if (value == 0.0) return;
    add_text(name, lreal_literal(value));
  }
  void add_text(const char* name, const std::string& value) {
    text_ += fmt::format("{}{} := {}", text_.empty() ? "" : ", ", name, value);
  }
  // `first` stands for a row of zeros only, which has to have a member.
  std::string take(const char* first) {
    if (text_.empty()) add_text(first, "0.0");
    return "(" + std::exchange(text_, {}) + ")";
  }

 private:
  std::string text_;
};

std::string joint_literal(const motion::Transform& joint) {
  Members members;
  members.add_text("R", list(joint.rotation.m));
  members.add("X", joint.position_m.x);
  members.add("Y", joint.position_m.y);
  members.add("Z", joint.position_m.z);
  return members.take("X");
}

std::string capsule_literal(const schedule::Capsule& capsule) {
  Members members;
  members.add_text("Joint", std::to_string(capsule.joint));
  members.add("X1", capsule.from.x);
  members.add("Y1", capsule.from.y);
  members.add("Z1", capsule.from.z);
  members.add("X2", capsule.to.x);
  members.add("Y2", capsule.to.y);
  members.add("Z2", capsule.to.z);
  members.add("Radius", capsule.radius_m);
  return members.take("X1");
}

std::string rows_literal(const motion::MotionTable& table) {
  std::string text;
  for (std::size_t k = 0; k < table.rows(); ++k) {
    Members members;
    members.add("T", table.begins_s[k]);
    members.add("R", table.rates[k]);
    static constexpr const char* kNames[] = {"C0", "C1", "C2", "C3", "C4", "C5"};
    for (std::size_t c = 0; c < 6; ++c) members.add(kNames[c], table.coefficients[6 * k + c]);
    text += (text.empty() ? "" : ",\n") + members.take("T");
  }
  return text;
}

std::string points_literal(const motion::MotionTable& table) {
  std::string text;
  const std::size_t n = table.joints;
  for (std::size_t k = 0; k < table.places.size(); ++k) {
    Members members;
    members.add("S", table.places[k]);
    members.add("H", table.half_widths[k]);
    members.add_text("Q", list(std::span(table.points).subspan(n * k, n)));
    if (k + 1 < table.places.size())
      members.add_text("U", list(std::span(table.directions).subspan(n * k, n)));
    text += (text.empty() ? "" : ",\n") + members.take("S");
  }
  return text;
}

}  // namespace

std::string lreal_literal(double value) {
  std::string text = fmt::format("{}", value == 0.0 ? 0.0 : value);
  if (text.find('.') != std::string::npos) return text;
  const std::size_t exponent = text.find('e');
  text.insert(exponent == std::string::npos ? text.size() : exponent, ".0");
  return text;
}

std::string arm_model_literal(const schedule::ArmCapsules& arm) {
  std::string joints, capsules;
  for (const motion::Transform& each : arm.joints)
    joints += (joints.empty() ? "" : ",\n") + joint_literal(each);
  for (const schedule::Capsule& each : arm.capsules)
    capsules += (capsules.empty() ? "" : ",\n") + capsule_literal(each);
  return fmt::format("(Joints := {}, Joint := [{}],\nCapsules := {}, Capsule := [{}])", arm.joints.size(),
                     joints, arm.capsules.size(), capsules);
}

std::string with_held_text(const std::string& model, std::size_t own, const schedule::Capsule& held) {
  const std::string place = fmt::format("{}.Capsule[{}].", model, own + 1);
  std::string text = fmt::format("{}Joint := {};\n", place, held.joint);
  for (const auto& [name, value] : {std::pair("X1", held.from.x),
                                    {"Y1", held.from.y},
                                    {"Z1", held.from.z},
                                    {"X2", held.to.x},
                                    {"Y2", held.to.y},
                                    {"Z2", held.to.z},
                                    {"Radius", held.radius_m}})
    text += fmt::format("{}{} := {};\n", place, name, lreal_literal(value));
  return text + without_held_text(model, own + 1);
}

std::string without_held_text(const std::string& model, std::size_t own) {
  return fmt::format("{}.Capsules := {};\n", model, own);
}

std::string group_literal(const GroupFigures& figures) {
  const std::vector<double> following(figures.lower.size(), figures.following_rad);
  Members members;
  members.add_text("Joints", std::to_string(figures.lower.size()));
  members.add_text("MinPosition", list(figures.lower));
  members.add_text("MaxPosition", list(figures.upper));
  members.add_text("MaxVelocity", list(figures.velocity));
  members.add_text("MaxAcceleration", list(figures.acceleration));
  members.add_text("MaxJerk", list(figures.jerk));
  members.add_text("MaxFollowingError", list(following));
  return members.take("Joints");
}

PathData path_data(const std::string& name, const motion::MotionTable& table, const std::string& comment) {
  PathData made;
  made.points = vehicle::data_table("way", name, "MC_WAY_POINT", table.places.size(), points_literal(table),
                                    "way-points: " + comment);
  made.rows = vehicle::data_table("rows", name, "MC_TIME_ROW", table.rows(), rows_literal(table),
                                  "when it is where: " + comment);
  const std::string figures =
      fmt::format("(Points := {}, Rows := {}, Duration := {}, RateSlope := {}, RateBend := {})",
                  table.places.size(), table.rows(), lreal_literal(table.begins_s.back()),
                  lreal_literal(table.override_rates.per_s), lreal_literal(table.override_rates.per_s2));
  made.path = vehicle::global_variable(
      fmt::format("path_{}_{}", name, vehicle::digest(figures + made.points.name + made.rows.name)),
      "MC_PATH", comment, {}, figures);
  return made;
}

}  // namespace stepwright::tamp::program
