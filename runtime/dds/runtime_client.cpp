#include "runtime/dds/runtime_client.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <utility>

#include "runtime/dds/internal/client_session.h"
#include "runtime/dds/internal/random_client.h"
#include "runtime/host/limits.h"
#include "runtime/service/digest.h"
#include "runtime/service/monitor_answers.h"

namespace stepwright::dds {
namespace {

result::Result<void> done(result::Result<service::Reply> reply) {
  if (!reply) return result::forward(reply);
  return {};
}

// As another supervisor is told who has the runtime.
std::string described(const std::string& process) {
  std::array<char, 65> host{};
  if (gethostname(host.data(), host.size() - 1) != 0) host[0] = '?';
  return "process " + std::to_string(getpid()) + " ('" + process + "') on " + host.data();
}

// Those with bounds of which the runtime says no more than that they are broken.
result::Result<void> within_bounds(const service::RequestBody& body) {
  const auto* write = std::get_if<service::WriteBlock>(&body);
  if (write != nullptr && (write->block.parts.empty() || write->block.parts.size() > host::kMaxBlockWrites)) {
    return result::fail("D0004", {},
                        "a write of " + std::to_string(write->block.parts.size()) + " parts is refused",
                        "1 to " + std::to_string(host::kMaxBlockWrites) + " are possible");
  }
  const auto* fault = std::get_if<service::InjectFault>(&body);
  if (fault != nullptr && fault->name.size() > host::kMaxNameBytes)
    return result::fail("D0004", {}, "the name of the fault is too long");
  return {};
}

}  // namespace

struct RuntimeClient::State {
  internal::ClientSession session;
};

RuntimeClient::RuntimeClient(std::unique_ptr<State> state) : state_(std::move(state)) {}
RuntimeClient::~RuntimeClient() = default;

result::Result<std::unique_ptr<RuntimeClient>> RuntimeClient::connect(const ParticipantConfig& config,
                                                                      ClientRole role) {
  auto participant = internal::Participant::create(config);
  if (!participant) return result::forward(participant);
  std::unique_ptr<State> state(new State{internal::ClientSession(
      std::move(*participant), role, internal::random_client(), config.place, described(config.name))});
  if (!state->session.ok()) {
    return result::fail("D0005", {}, "Fast DDS cannot create the endpoints of '" + config.name + "'");
  }
  return std::unique_ptr<RuntimeClient>(new RuntimeClient(std::move(state)));
}

bool RuntimeClient::wait_for_runtime(std::chrono::milliseconds timeout) {
  return state_->session.wait_for_runtime(timeout);
}

bool RuntimeClient::runtime_alive() const {
  return state_->session.runtime_alive();
}

result::Result<std::string> RuntimeClient::download(std::span<const std::byte> container) {
  auto reply = download(container, DownloadMode::Replace);
  if (!reply) return result::forward(reply);
  return std::move(reply->digest);
}

result::Result<Download> RuntimeClient::download(std::span<const std::byte> container, DownloadMode mode) {
  if (container.empty() || container.size() > host::kMaxContainerBytes) {
    return result::fail("D0004", {},
                        "a container of " + std::to_string(container.size()) + " bytes is refused",
                        "1 to " + std::to_string(host::kMaxContainerBytes) + " bytes are possible");
  }
  const service::Sha256 digest = service::sha256(container);
  auto begun = ask(service::DownloadBegin{container.size(), digest});
  if (!begun) return result::forward(begun);
  for (std::size_t offset = 0; offset < container.size(); offset += host::kMaxChunkBytes) {
    const auto part = container.subspan(offset, std::min(host::kMaxChunkBytes, container.size() - offset));
    auto sent = ask(service::DownloadChunk{offset, {part.begin(), part.end()}});
    if (!sent) return result::forward(sent);
  }
  auto reply = ask(service::DownloadCommit{container.size(), digest, mode});
  if (!reply) return result::forward(reply);
  return Download{std::move(reply->digest), reply->change, std::move(reply->problems)};
}

result::Result<service::Reply> RuntimeClient::ask(service::RequestBody body) {
  if (auto fits = within_bounds(body); !fits) return result::forward(fits);
  return state_->session.ask(std::move(body));
}

result::Result<void> RuntimeClient::claim() {
  return done(ask(service::ReadForces{}));
}

result::Result<void> RuntimeClient::start(const StartOptions& options) {
  return done(ask(service::Start{options.barrier, options.cold}));
}

result::Result<void> RuntimeClient::stop(const std::string& reason) {
  return done(ask(service::Stop{reason.substr(0, host::kMaxReasonBytes)}));
}

result::Result<void> RuntimeClient::acknowledge(std::uint64_t event_sequence) {
  return done(ask(service::Acknowledge{event_sequence}));
}

result::Result<Forces> RuntimeClient::forces() {
  auto reply = ask(service::ReadForces{});
  if (!reply) return result::forward(reply);
  auto places = service::decode_forces(reply->data);
  if (!places) return result::forward(places);
  return Forces{std::move(reply->digest), std::move(*places)};
}

result::Result<std::vector<host::PlantFault>> RuntimeClient::faults() {
  std::vector<host::PlantFault> faults;
  for (;;) {
    auto reply = ask(service::ReadFaults{faults.size()});
    if (!reply) return result::forward(reply);
    auto part = service::decode_faults(reply->data);
    if (!part) return result::forward(part);
    faults.insert(faults.end(), part->begin(), part->end());
    if (part->empty() || faults.size() >= reply->total_bytes) return faults;
  }
}

result::Result<std::vector<std::byte>> RuntimeClient::program() {
  std::vector<std::byte> container;
  std::string digest;
  do {
    auto part = ask(service::ReadProgram{container.size()});
    if (!part) return result::forward(part);
    // Another program came in the middle: read that one from its beginning.
    if (!container.empty() && part->digest != digest) {
      container.clear();
      continue;
    }
    if (part->data.empty() || part->total_bytes > host::kMaxContainerBytes) break;
    digest = part->digest;
    container.insert(container.end(), part->data.begin(), part->data.end());
    if (container.size() >= part->total_bytes) break;
  } while (true);
  if (service::to_hex(service::sha256(container)) != digest) {
    return result::fail(service::kProgramDamaged, {}, "the runtime's program arrived damaged");
  }
  return container;
}

std::optional<StepEvent> RuntimeClient::wait_event(std::chrono::milliseconds timeout) {
  return state_->session.wait_event(timeout);
}

std::optional<RuntimeStatus> RuntimeClient::status() const {
  return state_->session.status();
}

std::optional<Snapshot> RuntimeClient::snapshot() const {
  return state_->session.snapshot();
}

bool RuntimeClient::wait_snapshot(std::chrono::milliseconds timeout) {
  return state_->session.wait_snapshot(timeout);
}

std::optional<RuntimeHealth> RuntimeClient::health() const {
  return state_->session.health();
}

std::vector<TopicTraffic> RuntimeClient::traffic() const {
  return state_->session.traffic();
}

TopicTraffic RuntimeClient::snapshot_traffic() const {
  return state_->session.snapshot_traffic();
}

}  // namespace stepwright::dds
