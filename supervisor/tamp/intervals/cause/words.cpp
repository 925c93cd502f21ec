#include "supervisor/tamp/intervals/cause/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "supervisor/tamp/intervals/cause/nearest_value.h"

namespace stepwright::tamp {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

double degrees(double rad) {
  return rad * kDegrees;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k)
    text += (k == 0 ? "" : k + 1 == words.size() ? " and " : ", ") + words[k];
  return text;
}

void add_once(std::vector<std::string>& words, const std::string& word) {
  if (std::ranges::find(words, word) == words.end()) words.push_back(word);
}

// "tray1 is 35.0 mm too high"; "at least", where it may be more.
std::string complaint(const WorkCell& cell, std::span<const Action> sequence, const Suggestion& each) {
  const double change = each.to - each.from;
  const std::string least = each.proved ? "" : "at least ";
  const auto millimetres = [&](double m) { return fmt::format("{}{:.1f} mm", least, 1e3 * std::abs(m)); };
  const auto moved = [&](const std::string& what, char axis) {
    return fmt::format("{} is {} too far towards {}{}", what, millimetres(change), change > 0.0 ? '-' : '+',
                       axis);
  };
  const auto high = [&](const std::string& what) {
    return fmt::format("{} is {} too {}", what, millimetres(change), change > 0.0 ? "low" : "high");
  };
  const auto turned = [&](const std::string& what) {
    return fmt::format("{} of {:.1f} deg is {}{:.1f} deg too far {}", what, degrees(each.from), least,
                       degrees(std::abs(change)), change > 0.0 ? "clockwise" : "anticlockwise");
  };
  switch (each.parameter) {
    case Parameter::RegionX:
      return moved(cell.regions[each.subject].name, 'x');
    case Parameter::RegionY:
      return moved(cell.regions[each.subject].name, 'y');
    case Parameter::RegionHeight:
      return high(cell.regions[each.subject].name);
    case Parameter::StartX:
      return moved(cell.objects[each.subject].name, 'x');
    case Parameter::StartY:
      return moved(cell.objects[each.subject].name, 'y');
    case Parameter::StartHeight:
      return high(cell.objects[each.subject].name);
    case Parameter::StartAngle:
      return turned("the first angle of " + cell.objects[each.subject].name);
    case Parameter::FinalAngle:
      return turned("the final angle of " + cell.objects[sequence[each.subject].object].name);
    case Parameter::Distance:
      return fmt::format(
          "the distance between {} and {} is {} too large", cell.objects[sequence[each.subject].object].name,
          cell.objects[sequence[each.subject].beyond[each.which].object].name, millimetres(change));
  }
  return {};
}

// Arms whose reach is in the set: "the right arm".
std::string arms_of(const WorkCell& cell, const Cause& cause) {
  std::vector<std::string> arms;
  for (const Constraint& each : cause.constraints)
    if (each.kind == ConstraintKind::Reach) add_once(arms, "the " + cell.arms[each.arm].name + " arm");
  return joined(arms);
}

// What else is in the set: "this final angle", "the area of tray2".
std::vector<std::string> circumstances(const WorkCell& cell, const Cause& cause, const Suggestion* subject) {
  const auto about = [&](Parameter parameter) {
    return subject != nullptr && subject->parameter == parameter;
  };
  std::vector<std::string> words;
  for (const Constraint& each : cause.constraints) {
    const std::string& object = cell.objects[each.object].name;
    const bool own_region =
        (about(Parameter::RegionX) || about(Parameter::RegionY) || about(Parameter::RegionHeight)) &&
        each.region == subject->subject;
    switch (each.kind) {
      case ConstraintKind::FinalAngle:
        if (!about(Parameter::FinalAngle)) add_once(words, "this final angle of " + object);
        break;
      case ConstraintKind::StartAngle:
        if (!about(Parameter::StartAngle)) add_once(words, "this first angle of " + object);
        break;
      case ConstraintKind::StartPosition:
        if (!about(Parameter::StartX) && !about(Parameter::StartY))
          add_once(words, object + " where it stands");
        break;
      case ConstraintKind::RegionArea:
        if (!own_region) add_once(words, cell.regions[*each.region].name + " where it is");
        break;
      case ConstraintKind::RegionHeight:
        if (!own_region) add_once(words, cell.regions[*each.region].name + " at its height");
        break;
      case ConstraintKind::GraspAngles:
        add_once(words, "the angles of this grasp");
        break;
      case ConstraintKind::Beyond:
        if (!about(Parameter::Distance)) add_once(words, "the distance between objects");
        break;
      case ConstraintKind::Stack:
        add_once(words, object + " on its stack");
        break;
      default:
        break;
    }
  }
  return words;
}

}  // namespace

std::string text_of(const WorkCell& cell, std::span<const Action> sequence, const Constraint& constraint) {
  const std::string& object = cell.objects[constraint.object].name;
  const Action& action = sequence[constraint.action];
  const ObjectPose& start = cell.objects[constraint.object].start;
  const std::string number = std::to_string(constraint.action + 1);
  switch (constraint.kind) {
    case ConstraintKind::StartPosition:
      return fmt::format("{} stands at x {:.4f} m, y {:.4f} m", object, start.x_m, start.y_m);
    case ConstraintKind::StartHeight:
      return fmt::format("{} stands at a height of {:.4f} m", object, start.z_m);
    case ConstraintKind::StartAngle:
      return fmt::format("{} has an angle of {:.1f} deg at first", object, degrees(start.angle_rad));
    case ConstraintKind::GraspAngles:
      return fmt::format("action {}: the grasp {} allows some angles of the hand only", number,
                         cell.grasps[action.grasp].name);
    case ConstraintKind::Reach:
      return fmt::format("action {}: the reach of the {} arm ({})", number, cell.arms[constraint.arm].name,
                         text_of(cell, action));
    case ConstraintKind::Transfer:
      return fmt::format("action {}: {} turns as the hand of the {} arm does", number, object,
                         cell.arms[constraint.arm].name);
    case ConstraintKind::RegionArea: {
      const Region& region = cell.regions[*constraint.region];
      return fmt::format("{}: {} lies on {} (x {:.4f} m, y {:.4f} m, {:.4f} m x {:.4f} m)",
                         "action " + number, object, region.name, region.x_m, region.y_m, region.size_x_m,
                         region.size_y_m);
    }
    case ConstraintKind::RegionHeight:
      return fmt::format("action {}: the height of {} ({:.4f} m)", number,
                         cell.regions[*constraint.region].name, cell.regions[*constraint.region].z_m);
    case ConstraintKind::Stack:
      return fmt::format("action {}: {} stands on {}", number, object, cell.objects[constraint.which].name);
    case ConstraintKind::FinalAngle:
      return fmt::format("action {}: the final angle of {} ({:.1f} deg)", number, object,
                         degrees(action.final_angle_rad.value_or(0.0)));
    case ConstraintKind::Beyond:
      return fmt::format("action {}: {} lies {:.4f} m beyond {}", number, object,
                         action.beyond[constraint.which].distance_m,
                         cell.objects[action.beyond[constraint.which].object].name);
  }
  return {};
}

std::string text_of(const WorkCell& cell, std::span<const Action> sequence, const Suggestion& each) {
  const auto object = [&] { return cell.objects[each.subject].name; };
  const auto moved = [&](const std::string& what, char axis) {
    return fmt::format("{} at {} {:.4f} m", what, axis, each.to);
  };
  switch (each.parameter) {
    case Parameter::RegionX:
      return moved(cell.regions[each.subject].name, 'x');
    case Parameter::RegionY:
      return moved(cell.regions[each.subject].name, 'y');
    case Parameter::RegionHeight:
      return fmt::format("{} at a height of {:.4f} m", cell.regions[each.subject].name, each.to);
    case Parameter::StartX:
      return moved(object(), 'x');
    case Parameter::StartY:
      return moved(object(), 'y');
    case Parameter::StartHeight:
      return fmt::format("{} at a height of {:.4f} m", object(), each.to);
    case Parameter::StartAngle:
      return fmt::format("{} at {:.1f} deg at first", object(), degrees(each.to));
    case Parameter::FinalAngle:
      return fmt::format("{} at {:.1f} deg at the end", cell.objects[sequence[each.subject].object].name,
                         degrees(each.to));
    case Parameter::Distance:
      return fmt::format("a distance of {:.4f} m", each.to);
  }
  return {};
}

std::string sentence_of(const WorkCell& cell, std::span<const Action> sequence, const Cause& cause) {
  const Suggestion* first = cause.suggestions.empty() ? nullptr : &cause.suggestions.front();
  const std::string arms = arms_of(cell, cause);
  const std::vector<std::string> others = circumstances(cell, cause, first);
  std::string sentence = first != nullptr ? complaint(cell, sequence, *first) : "no single number helps";
  if (!arms.empty()) sentence += " for " + arms;
  if (!others.empty()) sentence += " with " + joined(others);
  if (first != nullptr)
    sentence += first->proved ? "; " + first->text + " would do" : "; not before " + first->text;
  return sentence;
}

}  // namespace stepwright::tamp
