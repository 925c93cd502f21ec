#pragma once

// The line of an emulated controller: the pseudo terminal that the emulator has made, held open for as long
// as this object lives. An emulator takes a terminal that nobody has open for unplugged.

#include <chrono>
#include <filesystem>
#include <string>
#include <utility>

#include "runtime/ground/process/child_process.h"
#include "runtime/ground/result/result.h"

namespace stepwright::demo {

class EmulatorLine {
 public:
  EmulatorLine() = default;
  // Waits until the emulator has said in its log, behind `from` bytes, where its terminal is, and has `link`
  // lead there. Fails with M0008 if it ends or does not say so within `timeout`.
  [[nodiscard]] static result::Result<EmulatorLine> open(process::ChildProcess& emulator,
                                                         const std::filesystem::path& log, std::size_t from,
                                                         const std::filesystem::path& link,
                                                         std::chrono::milliseconds timeout);
  ~EmulatorLine();
  EmulatorLine(EmulatorLine&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  EmulatorLine& operator=(EmulatorLine&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }

 private:
  explicit EmulatorLine(int descriptor) : descriptor_(descriptor) {}
  int descriptor_ = -1;
};

}  // namespace stepwright::demo
