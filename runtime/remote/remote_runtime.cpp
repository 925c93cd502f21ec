#include "runtime/remote/remote_runtime.h"

#include <random>
#include <system_error>
#include <utility>

#include "runtime/host/busy.h"

namespace stepwright::remote {
namespace {

constexpr std::chrono::milliseconds kLook{2};

std::uint64_t random_incarnation() {
  std::random_device source;
  const std::uint64_t high = source();
  return (high << 32 | source()) | 1u;
}

}  // namespace

RemoteRuntime::RemoteRuntime(const RemoteConfig& config, std::unique_ptr<RegisterLine> line,
                             std::unique_ptr<host::SnapshotWriter> snapshots, const host::PlantAccess* plant)
    : config_(config),
      line_(std::move(line)),
      snapshots_(std::move(snapshots)),
      plant_(plant),
      incarnation_(random_incarnation()) {}

result::Result<std::unique_ptr<RemoteRuntime>> RemoteRuntime::create(const RemoteConfig& config,
                                                                     std::unique_ptr<RegisterLine> line,
                                                                     image::IoDriver& driver,
                                                                     host::PlantAccess* plant) {
  const auto names = plant == nullptr ? std::span<const std::string>{} : plant->value_names();
  auto snapshots = host::SnapshotWriter::create(names);
  if (!snapshots) return result::forward(snapshots);
  std::unique_ptr<RemoteRuntime> self(
      new RemoteRuntime(config, std::move(line), std::move(*snapshots), plant));
  if (!self->queues_.ok()) return result::fail("R0077", {}, "the system gives no more descriptors");
  self->loop_ = std::make_unique<LineLoop>(self->config_, *self->line_, driver, plant, *self->snapshots_,
                                           self->queues_);
  try {
    self->thread_ = std::thread([loop = self->loop_.get()] { loop->run(); });
  } catch (const std::system_error& error) {
    return result::fail("R0077", {}, std::string("the system gives no thread: ") + error.what(),
                        "the limit of processes (ulimit -u) may be reached");
  }
  return self;
}

RemoteRuntime::~RemoteRuntime() {
  if (!thread_.joinable()) return;
  loop_->quit();
  thread_.join();
}

bool RemoteRuntime::wait_for_controller(std::chrono::milliseconds timeout) const {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  while (!contact()) {
    if (std::chrono::steady_clock::now() >= deadline) return false;
    std::this_thread::sleep_for(kLook);
  }
  return true;
}

result::Result<void> RemoteRuntime::load(std::uint64_t ticket, std::vector<std::byte> container,
                                         std::string digest) {
  auto program = RemoteProgram::create(std::move(container), std::move(digest));
  if (!program) return result::forward(program);
  RemoteCommand asked;
  asked.command.kind = host::CommandKind::Load;
  asked.command.ticket = ticket;
  asked.program = std::move(*program);
  if (!queues_.submit(std::move(asked))) return host::busy();
  return {};
}

result::Result<void> RemoteRuntime::change(std::uint64_t, std::vector<std::byte>, std::string,
                                           host::DownloadMode) {
  return result::fail("R0147", {line_->name(), 0, 0},
                      "a controller that is reached over Modbus only has no online change",
                      "download with --replace, then start");
}

result::Result<void> RemoteRuntime::record(std::uint64_t, const record::RecordingOptions& options) {
  return result::fail("R0147", {options.file.string(), 0, 0},
                      "what a controller behind Modbus does cannot be recorded: its scans are not seen here",
                      "record the same program on `stepwright runtime`");
}

bool RemoteRuntime::submit(const host::Command& command) {
  return queues_.submit({command, nullptr});
}

host::RuntimeStatus RemoteRuntime::status() const {
  host::RuntimeStatus status = queues_.figures().status;
  status.incarnation = incarnation_;
  return status;
}

host::Forces RemoteRuntime::forces() const {
  RemoteFigures figures = queues_.figures();
  return {std::move(figures.status.program_digest), std::move(figures.forces)};
}

std::vector<host::PlantFault> RemoteRuntime::faults() const {
  return plant_ == nullptr ? std::vector<host::PlantFault>() : plant_->faults();
}

std::span<const std::byte> RemoteRuntime::program() const {
  shown_ = queues_.figures().program;
  return shown_ == nullptr ? std::span<const std::byte>{} : shown_->bytes();
}

}  // namespace stepwright::remote
