#pragma once

// A controller that is reached over its registers only, as a runtime: whatever speaks to the service of a
// runtime on the host speaks to it (runtime/doc/gateway.md). What such a controller cannot do (an online
// change, a recording) is refused with R0147.
//
//   auto runtime = RemoteRuntime::create(config, std::move(line), driver, &plant);
//   if (!(*runtime)->wait_for_controller(5s)) ... (*runtime)->line_problem() ...
//   auto server = service::Server::create({socket, 1s}, **runtime);
//
// Threads: create, use and destroy it on one thread (the service's); it brings its own for the line. Driver
// and plant are called by that one, but for what PlantAccess lets any thread ask, and must outlive the
// runtime.

#include <chrono>
#include <memory>
#include <thread>

#include "runtime/host/runtime_port.h"
#include "runtime/remote/line_loop.h"

namespace stepwright::remote {

class RemoteRuntime final : public host::RuntimePort {
 public:
  // Fails with R0077 (system) or R0081 (a plant with too many values). Looks for the controller from now on,
  // whenever it is lost again.
  [[nodiscard]] static result::Result<std::unique_ptr<RemoteRuntime>> create(
      const RemoteConfig& config, std::unique_ptr<RegisterLine> line, image::IoDriver& driver,
      host::PlantAccess* plant);
  // Stops the controller, if it runs and can be reached.
  ~RemoteRuntime() override;

  // False if it has not been heard of within `timeout`.
  bool wait_for_controller(std::chrono::milliseconds timeout) const;
  bool contact() const { return queues_.figures().contact; }
  // Figures of the line, all of one instant.
  RemoteFigures figures() const { return queues_.figures(); }
  // Why there is no contact; empty if there is.
  std::string line_problem() const { return queues_.figures().line_problem; }

  [[nodiscard]] result::Result<void> load(std::uint64_t ticket, std::vector<std::byte> container,
                                          std::string digest) override;
  [[nodiscard]] result::Result<void> change(std::uint64_t ticket, std::vector<std::byte> container,
                                            std::string digest, host::DownloadMode mode) override;
  [[nodiscard]] bool submit(const host::Command& command) override;
  std::optional<host::Completion> take_completion() override { return queues_.take_completion(); }
  std::optional<host::StepEvent> take_event() override { return queues_.take_event(); }
  host::RuntimeStatus status() const override;
  std::span<const std::byte> program() const override;
  int descriptor() const override { return news().descriptor(); }
  void clear() override { news().clear(); }
  int snapshot_descriptor() const override { return snapshots_->descriptor(); }
  host::Forces forces() const override;
  std::vector<host::PlantFault> faults() const override;
  [[nodiscard]] result::Result<void> record(std::uint64_t ticket,
                                            const record::RecordingOptions& options) override;

 private:
  RemoteRuntime(const RemoteConfig& config, std::unique_ptr<RegisterLine> line,
                std::unique_ptr<host::SnapshotWriter> snapshots, const host::PlantAccess* plant);
  host::Notifier& news() const { return queues_.news(); }

  const RemoteConfig config_;
  std::unique_ptr<RegisterLine> line_;
  std::unique_ptr<host::SnapshotWriter> snapshots_;
  const host::PlantAccess* plant_;  // for what any thread may ask
  std::uint64_t incarnation_;
  mutable LineQueues queues_;
  std::unique_ptr<LineLoop> loop_;
  mutable std::shared_ptr<const RemoteProgram> shown_;  // what `program` gave out last
  std::thread thread_;
};

}  // namespace stepwright::remote
