#pragma once

// A cell of a test's own: a folder, a configuration, a Fast DDS domain, and the real programs.

#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>

#include "cell/config/cell_config.h"
#include "runtime/dds/runtime_client.h"
#include "runtime/service/connection.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_process.h"

namespace stepwright::cells {

using support::kPatience;
using support::TestProcess;

class TestCell {
 public:
  // `more` is TOML text after the tables [cell] and [dds].
  explicit TestCell(std::uint32_t domain_id, const std::string& more = "") : domain_id_(domain_id) {
    std::ofstream(config()) << "[cell]\nname = \"" << name()
                            << "\"\nstate_dir = \"state\"\n[dds]\ndomain_id = " << domain_id << "\n"
                            << more;
  }
  ~TestCell() {
    std::error_code ignored;
    config::CellConfig ended;
    ended.state_dir = folder_ / "state";
    std::filesystem::remove(ended.plant_memory_path(), ignored);  // of a runtime that was killed
  }
  TestCell(const TestCell&) = delete;
  TestCell& operator=(const TestCell&) = delete;

  // No other process has it: whatever else runs in the domain is not heard.
  static std::string name() { return "linktest-" + std::to_string(::getpid()); }
  const std::filesystem::path& folder() const { return folder_.path(); }
  std::filesystem::path config() const { return folder_ / "cell.toml"; }
  std::filesystem::path socket() const { return folder_ / "state" / "runtime.sock"; }

  TestProcess start(const std::string& command) {
    const std::string log = command + std::to_string(++started_) + ".log";
    return TestProcess({STEPWRIGHT_BIN_DIR "/stepwright", command, "--config", config().string()},
                       folder_ / log);
  }
  // Started, and serving its socket.
  TestProcess start_runtime() {
    TestProcess runtime = start("runtime");
    EXPECT_TRUE(runtime.wait_for("listens on")) << runtime.output();
    return runtime;
  }

  // A client that has found the runtime.
  std::unique_ptr<dds::RuntimeClient> connect(dds::ClientRole role = dds::ClientRole::Supervisor) const {
    auto client = dds::RuntimeClient::connect({domain_id_, "test", name()}, role);
    EXPECT_TRUE(client) << (client ? "" : result::to_string(client.error()));
    if (!client) return nullptr;
    EXPECT_TRUE((*client)->wait_for_runtime(kPatience));
    return std::move(*client);
  }
  // Past the link, straight to the service.
  std::unique_ptr<service::Connection> attach(service::Role role, std::uint64_t first_event = 0) const {
    auto connection = service::Connection::open(socket(), {role, "test", first_event});
    EXPECT_TRUE(connection) << (connection ? "" : result::to_string(connection.error()));
    return connection ? std::move(*connection) : nullptr;
  }

 private:
  const support::TemporaryFolder folder_;
  std::uint32_t domain_id_;
  int started_ = 0;
};

// A client that works; otherwise the diagnostics fail the test.
template <typename T>
bool ok(const result::Result<T>& result) {
  if (!result) ADD_FAILURE() << result::to_string(result.error());
  return result.has_value();
}

// Waits for a condition that another process will bring about.
template <typename Condition>
bool eventually(Condition condition) {
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (std::chrono::steady_clock::now() < deadline) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

}  // namespace stepwright::cells
