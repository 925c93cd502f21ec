#include "plant_models/assemblies/tugger.h"
#include "runtime/ground/result/counted.h"

#include <cmath>
#include <string>

namespace stepwright::assemblies {
namespace {

constexpr std::string_view kTuggerPlant = "the tugger train";
constexpr double kAtRest_m_s = 0.005;

}  // namespace

std::string Tugger::violation() const {
  if (contacts_ == 0) return {};
  return "the train ran into something " + result::counted(contacts_, "time", "times");
}

result::Result<void> Tugger::inject_fault(std::string_view name, double value) {
  auto fault = find_fault(kTuggerPlant, ports_.faults, name);
  if (!fault) return result::forward(fault);
  if (auto good = check_fault(ports_.faults[*fault], ports_.fault_ranges[*fault], value); !good) return good;
  const auto target = ports_.fault_targets[*fault];
  if (target.kind == TuggerFault::CoupleTrailers) {
    if (auto good = check_coupling(value); !good) return good;
  }
  apply_fault(target.kind, target.index, value, true);
  return {};
}

result::Result<void> Tugger::clear_fault(std::string_view name) {
  auto fault = find_fault(kTuggerPlant, ports_.faults, name);
  if (!fault) return result::forward(fault);
  apply_fault(ports_.fault_targets[*fault].kind, ports_.fault_targets[*fault].index, 0.0, false);
  return {};
}

void Tugger::apply_fault(TuggerFault kind, std::size_t index, double value, bool active) {
  const bool on = active && value != 0.0;
  BicycleModes modes = train_->modes();
  switch (kind) {
    case TuggerFault::Dead:
      dead_ = on;
      return;
    case TuggerFault::Weak:
      modes.drive_strength = active ? value : 1.0;
      return train_->set_modes(modes);
    case TuggerFault::Slip:
      modes.extra_slip = active ? value : 0.0;
      return train_->set_modes(modes);
    case TuggerFault::StuckSteering:
      modes.steering_stuck = on;
      return train_->set_modes(modes);
    case TuggerFault::FrozenPose:
      frozen_ = on ? std::optional(frozen_.value_or(train_->tractor())) : std::nullopt;
      return;
    case TuggerFault::Drift:
      drift_cm_s_ = active ? value : 0.0;
      drift_since_s_ = time_s();
      return;
    case TuggerFault::Block:
      floor_.set_blocked(index, on);
      changed_ = true;
      return;
    case TuggerFault::EmergencyStop:
      emergency_stop_ = on;
      return;
    // Their end changes nothing: who left trailers has to couple them.
    case TuggerFault::LeaveTrailers:
      if (active) leave_trailers(static_cast<std::size_t>(value));
      return;
    case TuggerFault::CoupleTrailers:
      if (active) couple_trailers(static_cast<std::size_t>(value));
      return;
  }
}

void Tugger::leave_trailers(std::size_t stay) {
  if (stay >= train_->coupled()) return;
  for (std::size_t link = stay + 1; link <= train_->coupled(); ++link)
    floor_.leave(link, train_->boxes()[link]);
  train_->couple(stay);
  changed_ = true;
}

result::Result<void> Tugger::check_coupling(double value) const {
  const auto refuse = [&](const std::string& why, const std::string& hint) {
    return result::fail("C0312", {}, "trailers cannot be coupled: " + why, hint);
  };
  const auto wanted = static_cast<std::size_t>(value);
  const std::size_t coupled = train_->coupled();
  if (wanted < coupled) {
    return refuse(std::to_string(coupled) + " are coupled, which is more than " + std::to_string(wanted),
                  "leave_trailers uncouples them");
  }
  if (std::abs(train_->speed_m_s()) > kAtRest_m_s) return refuse("the train moves", "stop it first");
  PlacedBox next = train_->boxes().back();
  for (std::size_t link = coupled + 1; link <= wanted; ++link) {
    next.middle = next.middle - parameters_.links.spacing_m * next.ahead;
    bool is_free = floor_.is_free(next, wanted + 1);
    for (std::size_t other = 0; other < coupled; ++other)
      is_free = is_free && !meets(next, train_->boxes()[other]);
    if (!is_free)
      return refuse("something stands where trailer " + std::to_string(link) + " would", "drive on first");
  }
  return {};
}

void Tugger::couple_trailers(std::size_t trailers) {
  for (std::size_t link = train_->coupled() + 1; link <= trailers; ++link) floor_.leave(link, std::nullopt);
  train_->couple(trailers);
  changed_ = true;
}

}  // namespace stepwright::assemblies
