#pragma once

// A runtime behind a real service that has a program, says that it runs, and never answers a write: what a
// runtime in trouble looks like from the Modbus server.

#include <sys/eventfd.h>

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "runtime/host/notifier.h"
#include "runtime/host/runtime_port.h"
#include "runtime/host/snapshot_memory.h"
#include "tests/unit/runtime/service/service_harness.h"

namespace stepwright::modbus::server {

class DeafPort final : public host::RuntimePort {
 public:
  DeafPort(std::vector<std::byte> container, std::string digest)
      : container_(std::move(container)),
        digest_(std::move(digest)),
        snapshots_(std::move(*host::SnapshotWriter::create({}))) {}

  result::Result<void> load(std::uint64_t, std::vector<std::byte>, std::string) override { return {}; }
  result::Result<void> change(std::uint64_t, std::vector<std::byte>, std::string,
                              host::DownloadMode) override {
    return {};
  }
  bool submit(const host::Command&) override { return true; }
  result::Result<void> write(std::uint64_t, host::BlockWrite) override {
    ++writes;
    return {};
  }
  std::optional<host::Completion> take_completion() override { return std::nullopt; }
  std::optional<host::StepEvent> take_event() override { return std::nullopt; }
  host::RuntimeStatus status() const override {
    host::RuntimeStatus status;
    status.incarnation = 1;
    status.state = host::RuntimeState::Running;
    status.program_digest = digest_;
    return status;
  }
  std::span<const std::byte> program() const override {
    ++fetched;
    return container_;
  }
  int descriptor() const override { return notifier_.descriptor(); }
  void clear() override { notifier_.clear(); }
  int snapshot_descriptor() const override { return snapshots_->descriptor(); }

  std::atomic<int> writes{0};
  mutable std::atomic<int> fetched{0};  // how often its program was looked at

 private:
  std::vector<std::byte> container_;
  std::string digest_;
  std::unique_ptr<host::SnapshotWriter> snapshots_;
  host::Notifier notifier_;
};

class DeafRuntime {
 public:
  DeafRuntime(std::vector<std::byte> container, std::string digest)
      : port(std::move(container), std::move(digest)), stop_(eventfd(0, 0)) {
    server_ = std::move(*service::Server::create({socket(), std::chrono::seconds(60)}, port));
    thread_ = std::thread([this] { server_->run(stop_); });
  }
  ~DeafRuntime() {
    const std::uint64_t one = 1;
    EXPECT_EQ(::write(stop_, &one, sizeof one), static_cast<ssize_t>(sizeof one));
    thread_.join();
    server_.reset();
    ::close(stop_);
  }
  std::filesystem::path socket() const { return folder_.path() / "runtime.sock"; }

  DeafPort port;

 private:
  service::TemporaryFolder folder_;
  int stop_;
  std::unique_ptr<service::Server> server_;
  std::thread thread_;
};

}  // namespace stepwright::modbus::server
