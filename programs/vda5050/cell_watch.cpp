#include "programs/vda5050/cell_watch.h"

#include <utility>

#include "cell/config/dds_options.h"
#include "runtime/ground/log/refused_samples.h"
#include "runtime/service/digest.h"

namespace stepwright::vda5050_link {

namespace {

constexpr std::chrono::seconds kFetchPause{1};

std::string why_not_running(const std::optional<dds::RuntimeStatus>& status) {
  if (!status) return {};
  switch (status->state) {
    case dds::RuntimeState::Running:
      return {};
    case dds::RuntimeState::Empty:
      return "the controller has no program";
    case dds::RuntimeState::Stopped:
      return "the program of the controller is stopped: " + status->detail;
    case dds::RuntimeState::Fault:
      return "the controller has a fault: " + status->detail;
  }
  return {};
}

}  // namespace

result::Result<std::unique_ptr<CellWatch>> CellWatch::connect(const config::CellConfig& config,
                                                              log::Logger& log) {
  dds::ParticipantConfig participant = config::participant_of(config.dds, "vda5050");
  participant.on_trouble = log::refused_samples(log);
  auto runtime = dds::RuntimeClient::connect(participant, dds::ClientRole::Viewer);
  if (!runtime) return result::forward(runtime);
  auto plans = dds::PlanSubscriber::create(participant);
  if (!plans) return result::forward(plans);
  return std::unique_ptr<CellWatch>(new CellWatch(std::move(*runtime), std::move(*plans), log));
}

CellView CellWatch::observe() {
  CellView view;
  view.runtime_alive = runtime_->runtime_alive();
  view.controller = why_not_running(runtime_->status());
  if (auto newer = plans_->wait_newer(std::chrono::milliseconds(0))) document_ = *std::move(newer);
  view.document = document_;
  auto snapshot = runtime_->snapshot();
  if (!snapshot || snapshot->program_digest.empty()) return view;
  if (view.runtime_alive) fetch_program(snapshot->program_digest);
  if (digest_ != snapshot->program_digest) return view;
  view.program = program_;
  view.program_digest = digest_;
  view.image = std::move(snapshot->image);
  return view;
}

void CellWatch::fetch_program(const std::string& digest) {
  const auto now = std::chrono::steady_clock::now();
  if (digest_ == digest || now < next_fetch_) return;
  next_fetch_ = now + kFetchPause;
  const auto container = runtime_->program();
  if (!container) return;  // asked again
  next_fetch_ = now;
  // Another program may have come since the image was taken; its own images follow.
  if (service::to_hex(service::sha256(*container)) != digest) return;
  auto program = reader::ProgramInfo::read(*container);
  if (!program) {
    next_fetch_ = now + kFetchPause;
    log_.warning("program", result::to_string(program.error()), {{"digest", digest}});
    return;
  }
  program_ = std::make_shared<const reader::ProgramInfo>(*std::move(program));
  digest_ = digest;
}

}  // namespace stepwright::vda5050_link
