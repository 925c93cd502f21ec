#pragma once

// A runtime with its service on a thread of its own, in a folder of the test's own.

#include <gtest/gtest.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include "runtime/host/host_runtime.h"
#include "runtime/image/no_io.h"
#include "runtime/service/connection.h"
#include "runtime/service/server.h"
#include "tests/support/patience.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::service {

using support::kPatience;

using support::TemporaryFolder;

class ServiceHarness {
 public:
  // `server_config` without its socket and time of the supervisor; without a driver there is no I/O.
  explicit ServiceHarness(const host::HostConfig& config = {},
                          std::chrono::milliseconds supervisor_lost_after = std::chrono::seconds(60),
                          ServerConfig server_config = {}, image::IoDriver* driver = nullptr)
      : stop_(eventfd(0, 0)) {
    runtime_ = std::move(*host::HostRuntime::create(config, driver == nullptr ? driver_ : *driver, nullptr));
    server_config.socket = socket();
    server_config.supervisor_lost_after = supervisor_lost_after;
    auto server = Server::create(server_config, *runtime_);
    EXPECT_TRUE(server) << (server ? "" : result::to_string(server.error()));
    server_ = std::move(*server);
    thread_ = std::thread([this] { server_->run(stop_); });
  }
  ~ServiceHarness() { end(); }

  std::filesystem::path socket() const { return folder_.path() / "runtime.sock"; }

  void end() {
    if (!thread_.joinable()) return;
    const std::uint64_t one = 1;
    EXPECT_EQ(::write(stop_, &one, sizeof one), static_cast<ssize_t>(sizeof one));
    thread_.join();
    server_.reset();
    ::close(stop_);
  }

  std::unique_ptr<Connection> connect(Role role = Role::Controller, std::uint64_t first_event = 0) const {
    auto connection = Connection::open(socket(), {role, "test", first_event});
    EXPECT_TRUE(connection) << (connection ? "" : result::to_string(connection.error()));
    return connection ? std::move(*connection) : nullptr;
  }

 private:
  TemporaryFolder folder_;
  image::NoIo driver_;
  int stop_;
  std::unique_ptr<host::HostRuntime> runtime_;
  std::unique_ptr<Server> server_;
  std::thread thread_;
};

// The next message of a kind, others skipped.
template <typename T>
std::optional<T> next(Connection& connection, std::chrono::milliseconds timeout = kPatience) {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  while (std::chrono::steady_clock::now() < deadline && !connection.closed()) {
    auto message = connection.receive(timeout);
    if (!message) continue;
    if (auto* wanted = std::get_if<T>(&*message)) return std::move(*wanted);
  }
  return std::nullopt;
}

// The next status for which `condition` holds.
template <typename Condition>
std::optional<host::RuntimeStatus> status_when(Connection& connection, Condition condition) {
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (std::chrono::steady_clock::now() < deadline) {
    auto status = next<host::RuntimeStatus>(connection);
    if (!status) return std::nullopt;
    if (condition(*status)) return status;
  }
  return std::nullopt;
}

}  // namespace stepwright::service
