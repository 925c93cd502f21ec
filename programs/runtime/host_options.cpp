#include "programs/runtime/host_options.h"

#include <cmath>
#include <utility>

#include "plant_models/bridge/io_address.h"

namespace stepwright::cell_runtime {
namespace {

using bridge::IoAddress;

// One rule for every byte that the address touches.
void add_rules(const IoAddress& address, config::SafeAction action, std::vector<scan::SafeOutput>& rules) {
  scan::SafeOutput rule;
  rule.mode = action == config::SafeAction::Hold  ? scan::SafeMode::Hold
              : action == config::SafeAction::One ? scan::SafeMode::Value
                                                  : scan::SafeMode::Zero;
  rule.value = 0xFF;
  if (address.width == bridge::IoWidth::Bit) {
    rule.byte = address.byte;
    rule.mask = static_cast<std::uint8_t>(1u << address.bit);
    rules.push_back(rule);
    return;
  }
  for (std::uint32_t i = 0; i < address.size_bits() / 8; ++i) {
    rule.byte = address.byte + i;
    rules.push_back(rule);
  }
}

result::Result<std::vector<scan::SafeOutput>> safe_outputs(const config::CellConfig& config) {
  std::vector<scan::SafeOutput> rules;
  result::Diagnostics problems;
  const auto report = [&](const result::Diagnostics& found) {
    problems.insert(problems.end(), found.begin(), found.end());
  };
  const result::Location where{config.file.string(), 0, 0};
  for (const config::SafeOutput& output : config.safe_outputs) {
    const auto address = bridge::parse_io_address(output.address, where);
    if (!address) {
      report(address.error());
    } else if (address->area != bridge::IoArea::Output ||
               address->first_bit() + address->size_bits() > config.image.output_bytes * 8) {
      const auto failed = result::fail(
          "C0303", where,
          "[safe_state.outputs] names " + output.address + ", which is not among the outputs of the cell",
          "the area has " + std::to_string(config.image.output_bytes) + " bytes, see [image] output_bytes");
      report(failed.value());
    } else {
      add_rules(*address, output.action, rules);
    }
  }
  if (!problems.empty()) return tl::unexpected(std::move(problems));
  return rules;
}

}  // namespace

result::Result<host::HostConfig> host_options(const config::CellConfig& config) {
  auto rules = safe_outputs(config);
  if (!rules) return result::forward(rules);
  host::HostConfig options;
  options.clock =
      config.clock.mode == config::ClockMode::Real ? host::ClockMode::Real : host::ClockMode::Simulated;
  options.engine = config.engine == config::EngineKind::Native ? host::EngineKind::Native
                   : config.engine == config::EngineKind::Vm   ? host::EngineKind::Vm
                                                               : host::EngineKind::Auto;
  options.speed = config.clock.speed;
  options.idle_interval_ns = config.clock.interval_us * 1'000;
  options.input_bytes = config.image.input_bytes;
  options.output_bytes = config.image.output_bytes;
  options.safe_outputs = std::move(*rules);
  options.on_lost_supervisor = config.on_lost_supervisor == config::LostSupervisorPolicy::Safe
                                   ? host::LostSupervisor::Safe
                                   : host::LostSupervisor::Continue;
  for (const config::ScheduledFault& fault : config.faults) {
    // A change of what is asked for is the supervisor's business.
    if (config::is_goal_change(fault)) continue;
    options.faults.push_back({std::llround(fault.at_s * 1e9), fault.name, fault.value});
  }
  options.change_trial_scans = config.change.trial_scans;
  options.retain = {config.retain.file, std::chrono::nanoseconds(config.retain.period).count(),
                    config.retain.policy == config::RetainPolicy::Initialise
                        ? record::RetainPolicy::Initialise
                    : config.retain.policy == config::RetainPolicy::Refuse ? record::RetainPolicy::Refuse
                                                                           : record::RetainPolicy::Carry};
  return options;
}

}  // namespace stepwright::cell_runtime
