#include "runtime/remote/plant_feed.h"

#include "runtime/host/named_values.h"

namespace stepwright::remote {

PlantFeed::PlantFeed(const host::HostConfig& config, image::IoDriver& driver, host::PlantAccess* plant)
    : io_(driver, config.input_bytes, config.output_bytes),
      plant_(plant),
      safe_memory_(config.output_bytes),
      safe_(config.safety.safe_state.matrix(), safe_memory_),
      faults_(config.faults),
      truths_(plant == nullptr ? 0 : plant->value_names().size()) {}

void PlantFeed::fit(std::size_t input_bytes, std::size_t output_bytes, std::int64_t time_ns) {
  inputs_.assign(input_bytes, std::byte{0});
  outputs_.assign(output_bytes, std::byte{0});
  safe_.driven(io_.outputs());
  safe_.enter(scan::SafeCause::Stop, time_ns);
}

bool PlantFeed::read(std::int64_t time_ns) {
  stood_still_ = stood_still_ || io_.lapsed();
  return io_.read_inputs(time_ns, inputs_) == image::IoStatus::Good && !io_.lapsed();
}

bool PlantFeed::write(std::int64_t time_ns) {
  stood_still_ = io_.lapsed();
  if (stood_still_) {
    make_safe(time_ns);
    return false;
  }
  if (!safe_.settled()) safe_.apply_behind(outputs_.size(), time_ns);
  io_.rest_outputs(safe_.outputs().subspan(outputs_.size()));
  safe_.driven(outputs_);
  return io_.write_outputs(time_ns, outputs_) == image::IoStatus::Good;
}

void PlantFeed::make_safe(std::int64_t time_ns) {
  safe_.enter(stood_still_ ? scan::SafeCause::Killed : scan::SafeCause::IoLost, time_ns);
  keep_safe(time_ns);
}

void PlantFeed::keep_safe(std::int64_t time_ns) {
  if (io_.takes_over()) {
    safe_.driven(io_.outputs());
    safe_.enter(safe_.cause(), time_ns);
  }
  safe_.apply(time_ns, outputs_);
  io_.safe(static_cast<std::uint8_t>(safe_.cause()), safe_.settled());
  // A plant that does not answer either is not news now.
  static_cast<void>(io_.write_outputs(time_ns, safe_.outputs()));
}

std::span<const double> PlantFeed::truths() {
  if (plant_ != nullptr) plant_->read_values(truths_);
  return truths_;
}

std::vector<host::NamedValue> PlantFeed::named_truths() {
  const auto names = plant_ == nullptr ? std::span<const std::string>{} : plant_->value_names();
  return host::named_values(names, truths());
}

}  // namespace stepwright::remote
