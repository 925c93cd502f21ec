#pragma once

// The registers in which the controller says what it is and does: status, outputs, window.

#include <cstdint>
#include <span>

#include "firmware/app/controller.h"

namespace stepwright::app {

// Which memory the window shows, and from which byte.
struct Selection {
  modbus::control::Memory what = modbus::control::Memory::Image;
  std::uint32_t offset = 0;
};

// Each fills a whole block; the words come as zeros.
void fill_status(Controller& controller, std::span<std::uint16_t, modbus::control::status::kCount> words);
void fill_outputs(Controller& controller, std::span<std::uint16_t, modbus::control::kMaxRead> words);
void fill_window(Controller& controller, const Selection& selection,
                 std::span<std::uint16_t, modbus::control::window::kCount> words);

}  // namespace stepwright::app
