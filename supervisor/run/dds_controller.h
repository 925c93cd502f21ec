#pragma once

// The controller over Fast DDS, for the supervisor process.

#include <memory>

#include "runtime/dds/runtime_client.h"
#include "supervisor/run/controller.h"

namespace stepwright::run {

class DdsController final : public Controller {
 public:
  // Joins the domain as the supervisor of one runtime; does not wait for it.
  [[nodiscard]] static result::Result<std::unique_ptr<DdsController>> connect(
      const dds::ParticipantConfig& config);

  // Fails with D0009 if another supervisor has the runtime.
  [[nodiscard]] result::Result<void> claim() { return client_->claim(); }
  bool wait_for_runtime(std::chrono::milliseconds timeout) override;
  bool alive() const override;
  result::Result<std::string> download(std::span<const std::byte> container) override;
  result::Result<std::string> change(std::span<const std::byte> container) override;
  result::Result<void> start(bool barrier) override;
  result::Result<void> stop(const std::string& reason) override;
  result::Result<void> acknowledge(std::uint64_t event_sequence) override;
  result::Result<std::vector<std::byte>> program() override;
  std::optional<host::StepEvent> wait_event(std::chrono::milliseconds timeout) override;
  std::optional<host::RuntimeStatus> status() const override;
  std::optional<host::Snapshot> snapshot() const override;

 private:
  explicit DdsController(std::unique_ptr<dds::RuntimeClient> client);
  std::unique_ptr<dds::RuntimeClient> client_;
};

}  // namespace stepwright::run
