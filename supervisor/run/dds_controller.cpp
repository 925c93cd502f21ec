#include "supervisor/run/dds_controller.h"

#include <utility>

namespace stepwright::run {

DdsController::DdsController(std::unique_ptr<dds::RuntimeClient> client) : client_(std::move(client)) {}

result::Result<std::unique_ptr<DdsController>> DdsController::connect(const dds::ParticipantConfig& config) {
  auto client = dds::RuntimeClient::connect(config, dds::ClientRole::Supervisor);
  if (!client) return result::forward(client);
  return std::unique_ptr<DdsController>(new DdsController(std::move(*client)));
}

bool DdsController::wait_for_runtime(std::chrono::milliseconds timeout) {
  return client_->wait_for_runtime(timeout);
}
bool DdsController::alive() const {
  return client_->runtime_alive();
}

result::Result<std::string> DdsController::download(std::span<const std::byte> container) {
  return client_->download(container);
}

result::Result<std::string> DdsController::change(std::span<const std::byte> container) {
  auto changed = client_->download(container, dds::DownloadMode::ChangeRestartCharts);
  if (!changed) return result::forward(changed);
  return std::move(changed->digest);
}

result::Result<void> DdsController::start(bool barrier) {
  return client_->start({.barrier = barrier});
}
result::Result<void> DdsController::stop(const std::string& reason) {
  return client_->stop(reason);
}

result::Result<void> DdsController::acknowledge(std::uint64_t event_sequence) {
  return client_->acknowledge(event_sequence);
}

result::Result<std::vector<std::byte>> DdsController::program() {
  return client_->program();
}

std::optional<host::StepEvent> DdsController::wait_event(std::chrono::milliseconds timeout) {
  return client_->wait_event(timeout);
}

std::optional<host::RuntimeStatus> DdsController::status() const {
  return client_->status();
}
std::optional<host::Snapshot> DdsController::snapshot() const {
  return client_->snapshot();
}

}  // namespace stepwright::run
