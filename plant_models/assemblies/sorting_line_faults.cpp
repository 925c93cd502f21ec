#include <utility>

#include "plant_models/assemblies/sorting_line.h"

namespace stepwright::assemblies {
namespace {

constexpr std::string_view kLinePlant = "the sorting line";

}  // namespace

result::Result<void> SortingLine::inject_fault(std::string_view name, double value) {
  auto fault = find_fault(kLinePlant, ports_.faults, name);
  if (!fault) return result::forward(fault);
  if (auto good = check_fault(ports_.faults[*fault], ports_.fault_ranges[*fault], value); !good) return good;
  apply_fault(*fault, value, true);
  return {};
}

result::Result<void> SortingLine::clear_fault(std::string_view name) {
  auto fault = find_fault(kLinePlant, ports_.faults, name);
  if (!fault) return result::forward(fault);
  apply_fault(*fault, 0.0, false);
  return {};
}

void SortingLine::apply_fault(std::size_t fault, double value, bool active) {
  const auto target = ports_.fault_targets[fault];
  const std::size_t i = target.index;
  const bool on = active && value != 0.0;
  switch (target.kind) {
    case LineFault::Obstacle:
      world_.set_present(belts_[i].obstacle, on);
      return;
    case LineFault::StuckPusher:
      pushers_[i].stuck = on;
      return;
    case LineFault::StuckEye:
      eyes_[i].shows = active ? static_cast<std::int8_t>(value) : std::int8_t{-1};
      return;
    case LineFault::Slip:
      belts_[i].slip = active ? value : 1.0;
      return;
    case LineFault::TakenAway: {
      const auto box = static_cast<std::size_t>(value) - 1;
      if (active && boxes_[box].state == BoxState::OnTheLine) take_away(boxes_[box], BoxState::TakenAway);
      return;
    }
    case LineFault::Exchange: {
      // What has arrived already stays.
      const auto place = static_cast<std::size_t>(value) - 1;
      if (active && place >= next_ && place + 1 < list_.size()) std::swap(list_[place], list_[place + 1]);
      return;
    }
    case LineFault::EmergencyStop:
      emergency_stop_ = on;
      return;
    case LineFault::Reset:
      reset_ = on;
      return;
  }
}

}  // namespace stepwright::assemblies
