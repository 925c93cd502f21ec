#pragma once

// A cell on shared-memory I/O whose plant is the test: its configuration, its processes, its program.

#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "runtime/io_memory/plant_side.h"
#include "runtime/service/connection.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_process.h"
#include "tests/support/test_program.h"

namespace stepwright::cells {

using support::kPatience;
using support::TestProcess;

// MAIN every 10 ms: %QB0 = 0x0F, %QB1 = 0x22, %QW1 = 3000; loops for ever while %IB0 is not 0, then divides
// by 1 - %IB1.
inline std::vector<std::byte> guarded_program() {
  using bytecode::AddressMode;
  using bytecode::MemType;
  writer::ContainerModel model = support::one_program(4, [](writer::FunctionBuilder& f) {
    f.const_i32(0x0F);
    f.store(MemType::U8, AddressMode::Abs, 8);
    f.const_i32(0x22);
    f.store(MemType::U8, AddressMode::Abs, 9);
    f.const_i32(3'000);
    f.store(MemType::I16, AddressMode::Abs, 10);
    const auto again = f.new_label();
    f.bind(again);
    f.load(MemType::U8, AddressMode::Abs, 0);
    f.const_i32(0);
    f.emit(bytecode::Opcode::NeI32);
    f.jump_if_true(again);
    f.const_i32(1);
    f.const_i32(1);
    f.load(MemType::U8, AddressMode::Abs, 1);
    f.emit(bytecode::Opcode::SubI32);
    f.emit(bytecode::Opcode::DivI32);
    f.store(MemType::I32, AddressMode::This, 0);
  });
  model.sizes = {8, 8, 0, 4};
  model.tasks[0].calls[0].instance = 16;
  return *writer::write_container(model);
}

// %QB0 in its safe state, by cause; the first is what the program writes.
enum : int { kRuns = 0x0F, kStop = 1, kTrap, kWatchdog, kLostIo, kLostSupervisor, kKilled };

class GuardedCell {
 public:
  explicit GuardedCell(const std::string& more = "") {
    name_ = folder_.path().filename();
    std::ofstream(config()) << "[cell]\nname = \"" << name_ << "\"\nstate_dir = \"state\"\n"
                            << "[clock]\nmode = \"real\"\n[image]\ninput_bytes = 8\noutput_bytes = 8\n"
                            << "[io]\nkind = \"shared_memory\"\n"
                            << "[safe_state]\non_lost_supervisor = \"safe\"\nsupervisor_lost_after_ms = 200\n"
                            << "[safe_state.outputs]\n\"%QB1\" = \"hold\"\n"
                            << "\"%QW1\" = { ramp_to = -10, per_second = 10_000 }\n"
                            << "[safe_state.stop]\n\"%QB0\" = { value = 1 }\n"
                            << "[safe_state.trap]\n\"%QB0\" = { value = 2 }\n"
                            << "[safe_state.watchdog]\n\"%QB0\" = { value = 3 }\n"
                            << "[safe_state.lost_io]\n\"%QB0\" = { value = 4 }\n"
                            << "[safe_state.lost_supervisor]\n\"%QB0\" = { value = 5 }\n"
                            << "[safe_state.killed]\n\"%QB0\" = { value = 6 }\n"
                            << "[tasks.TASK]\nwatchdog_us = 20_000\nwatchdog_sensitivity = 2\n"
                            << more;
    auto opened = io_memory::PlantSide::open(name_, 8, 8);
    EXPECT_TRUE(opened) << (opened ? "" : result::to_string(opened.error()));
    plant = std::move(*opened);
    plant->write_inputs(inputs_);
  }
  ~GuardedCell() {
    std::error_code ignored;
    std::filesystem::remove(io_memory::area_path(name_), ignored);
  }
  GuardedCell(const GuardedCell&) = delete;
  GuardedCell& operator=(const GuardedCell&) = delete;

  std::filesystem::path config() const { return folder_ / "cell.toml"; }
  const std::string& name() const { return name_; }
  std::filesystem::path guard_log() const { return folder_ / "state" / "guard.log"; }

  TestProcess start(const std::string& command) {
    return TestProcess({STEPWRIGHT_BIN_DIR "/stepwright", command, "--config", config().string()},
                       folder_ / (command + std::to_string(++started_) + ".log"));
  }
  std::filesystem::path folder() const { return folder_.path(); }
  TestProcess start_guard() {
    TestProcess guard = start("guard");
    EXPECT_TRUE(guard.wait_for("watches /dev/shm")) << guard.output();
    return guard;
  }
  // A runtime whose program runs and drives.
  TestProcess start_runtime() {
    TestProcess runtime = start("runtime");
    EXPECT_TRUE(runtime.wait_for("listens on")) << runtime.output();
    if (!attach()) return runtime;
    EXPECT_TRUE(client->download(guarded_program(), kPatience));
    EXPECT_TRUE(client->call(service::Start{}, kPatience));
    EXPECT_TRUE(wait([&] { return output(0) == kRuns; })) << runtime.output();
    return runtime;
  }
  // `client` is of the runtime that is there now.
  bool attach() {
    auto opened =
        service::Connection::open(folder_ / "state" / "runtime.sock", {service::Role::Controller, "test", 0});
    EXPECT_TRUE(opened) << (opened ? "" : result::to_string(opened.error()));
    if (opened) client = std::move(*opened);
    return opened.has_value();
  }
  // A status with this detail has come, or is among those that came meanwhile.
  bool status_says(const std::string& text) {
    for (int i = 0; i < 50; ++i) {
      const auto message = client->receive(std::chrono::milliseconds(100));
      if (!message) return false;
      const auto* const status = std::get_if<host::RuntimeStatus>(&*message);
      if (status != nullptr && status->detail.find(text) != std::string::npos) return true;
    }
    return false;
  }

  void set_input(std::size_t at, int value) {
    inputs_[at] = static_cast<std::byte>(value);
    plant->write_inputs(inputs_);
  }
  // -1 before anybody drove.
  int output(std::size_t at) {
    std::array<std::byte, 8> outputs{};
    const auto read = plant->read_outputs(outputs);
    if (!read) return -1;
    stamp = *read;
    return std::to_integer<int>(outputs[at]);
  }
  int word() {
    std::array<std::byte, 8> outputs{};
    static_cast<void>(plant->read_outputs(outputs));
    std::int16_t value = 0;
    std::memcpy(&value, outputs.data() + 2, sizeof value);
    return value;
  }
  static bool wait(const std::function<bool()>& condition, std::chrono::microseconds pause = pause_) {
    const auto deadline = std::chrono::steady_clock::now() + kPatience;
    while (!condition()) {
      if (std::chrono::steady_clock::now() > deadline) return false;
      std::this_thread::sleep_for(pause);
    }
    return true;
  }
  bool guarded() const {
    auto area = io_memory::IoArea::open(name_, 8, 8);
    return area && (*area)->locked_elsewhere(io_memory::AreaLock::Guard);
  }

  std::unique_ptr<io_memory::PlantSide> plant;
  std::unique_ptr<service::Connection> client;
  io_memory::OutputStamp stamp;  // of the newest outputs that were looked at

 private:
  static constexpr std::chrono::microseconds pause_{200};

  const support::TemporaryFolder folder_;
  std::string name_;
  std::vector<std::byte> inputs_ = std::vector<std::byte>(8);
  int started_ = 0;
};

}  // namespace stepwright::cells
