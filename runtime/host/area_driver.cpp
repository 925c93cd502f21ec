#include "runtime/host/area_driver.h"

#include <algorithm>
#include <cassert>

namespace stepwright::host {

image::IoStatus AreaDriver::read_inputs(std::int64_t now_ns, std::span<std::byte> inputs) {
  assert(inputs.size() <= inputs_.size());
  const image::IoStatus status = driver_.read_inputs(now_ns, inputs_);
  std::copy_n(inputs_.begin(), inputs.size(), inputs.begin());
  read_good_ = status == image::IoStatus::Good;
  write_good_ = true;
  return status;
}

image::IoStatus AreaDriver::write_outputs(std::int64_t now_ns, std::span<const std::byte> outputs) {
  assert(outputs.size() <= outputs_.size());
  std::ranges::copy(outputs, outputs_.begin());
  written_ = true;
  const image::IoStatus status = driver_.write_outputs(now_ns, outputs_);
  write_good_ = write_good_ && status == image::IoStatus::Good;
  return status;
}

bool AreaDriver::takes_over() {
  const bool taken = driver_.takes_over();
  written_ = written_ && !taken;
  return taken;
}

void AreaDriver::rest_outputs(std::span<const std::byte> rest) {
  assert(rest.size() <= outputs_.size());
  std::ranges::copy(rest, outputs_.end() - static_cast<std::ptrdiff_t>(rest.size()));
}

std::span<const std::byte> AreaDriver::outputs() {
  if (!written_ && !driver_.left_outputs(outputs_)) std::ranges::fill(outputs_, std::byte{0});
  return outputs_;
}

}  // namespace stepwright::host
