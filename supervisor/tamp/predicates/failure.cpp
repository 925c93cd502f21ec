#include "supervisor/tamp/predicates/failure.h"

#include <cstddef>
#include <vector>

namespace stepwright::tamp::predicates {

namespace {

std::vector<std::string> in_the_way(const scene::RobotCell& cell, const Failure& failure) {
  std::vector<std::string> names;
  const auto add = [&](const auto& all, std::uint64_t bits) {
    for (std::size_t k = 0; k < all.size(); ++k)
      if ((bits >> k & 1U) != 0) names.push_back(all[k].name);
  };
  add(cell.furniture, failure.furniture);
  add(cell.things, failure.things);
  return names;
}

// "a, b and c".
std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k)
    text += (k == 0 ? "" : k + 1 == names.size() ? " and " : ", ") + names[k];
  return text;
}

}  // namespace

void Failure::add(const Failure& next) {
  const bool alike = next.kind == kind;
  *this = {next.kind, next.things | (alike ? things : 0), next.furniture | (alike ? furniture : 0)};
}

std::string text_of(const scene::RobotCell& cell, const Failure& failure) {
  const std::vector<std::string> names = in_the_way(cell, failure);
  switch (failure.kind) {
    case FailureKind::NoRoom:
      if (names.empty()) return "no room";
      return "no room: " + listed(names) + (names.size() == 1 ? " is" : " are") + " in the way";
    case FailureKind::HandMeets:
      return "the hand meets " + (names.empty() ? "something" : listed(names));
    case FailureKind::OutOfReach:
      return "out of reach";
    case FailureKind::ArmMeets:
      return "the arm meets something";
    case FailureKind::NoPath:
      return "no path was found";
    default:
      return "impossible";
  }
}

}  // namespace stepwright::tamp::predicates
