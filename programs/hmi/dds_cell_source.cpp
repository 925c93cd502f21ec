#include "programs/hmi/dds_cell_source.h"

#include <utility>

#include "cell/config/dds_options.h"
#include "cell/hmi/sensor_tare.h"
#include "cell/hmi/unread_inputs.h"
#include "runtime/bytecode/reader/document_text.h"
#include "runtime/ground/log/refused_samples.h"
#include "runtime/service/digest.h"

namespace stepwright::hmi {
namespace {

constexpr std::chrono::seconds kFetchPause{1};

server::ImageSnapshot snapshot_of(dds::Snapshot snapshot) {
  server::ImageSnapshot result{
      snapshot.scan, static_cast<double>(snapshot.time_ns) * 1e-9, std::move(snapshot.image), {}};
  for (auto& value : snapshot.plant) result.plant.emplace_back(std::move(value.name), value.value);
  return result;
}

}  // namespace

result::Result<std::unique_ptr<DdsCellSource>> DdsCellSource::connect(const config::CellConfig& config,
                                                                      log::Logger& log) {
  dds::ParticipantConfig participant = config::participant_of(config.dds, "hmi");
  participant.on_trouble = log::refused_samples(log);
  auto runtime = dds::RuntimeClient::connect(participant, dds::ClientRole::Viewer);
  if (!runtime) return result::forward(runtime);
  auto plans = dds::PlanSubscriber::create(participant);
  if (!plans) return result::forward(plans);
  return std::unique_ptr<DdsCellSource>(
      new DdsCellSource(std::move(*runtime), std::move(*plans), config, log));
}

server::Observation DdsCellSource::observe() {
  server::Observation seen;
  seen.runtime_alive = runtime_->runtime_alive();
  if (seen.runtime_alive) local_.heard();
  seen.runtime_unlinked = !seen.runtime_alive && local_.is_there(std::chrono::steady_clock::now());
  seen.supervisor_alive = plans_->supervisor_alive();
  seen.plan = plans_->latest();
  seen.pictures = plans_->pictures();
  if (seen.plan && *seen.plan != tare_source_) {
    tare_source_ = *seen.plan;
    tare_ = tare_of(tare_source_);
  }
  seen.tare = tare_;
  seen.status = runtime_->status();
  auto snapshot = runtime_->snapshot();
  // Behind the image: what was lost before it came is counted by then.
  const dds::TopicTraffic images = runtime_->snapshot_traffic();
  seen.images = images.received;
  seen.images_lost = images.lost;
  // A runtime that has come back is not what an image of before shows; one that is gone has left it.
  if (!seen.runtime_alive) images_of_before_ = images.received;
  if (seen.runtime_alive && images.received == images_of_before_) snapshot.reset();
  std::string digest = snapshot ? snapshot->program_digest : std::string();
  if (seen.runtime_alive && !digest.empty() && fetch_program(digest)) {
    // The image has grown old meanwhile, and whoever looks takes it for one of now.
    snapshot = runtime_->snapshot();
    digest = snapshot->program_digest;
  }
  if (layout_ && layout_->program.digest == digest) seen.layout = layout_;
  if (!devices_.devices.empty()) seen.unread = unread_inputs(devices_, runtime_->health());
  if (snapshot) seen.snapshot = snapshot_of(std::move(*snapshot));
  return seen;
}

bool DdsCellSource::fetch_program(const std::string& digest) {
  const auto now = std::chrono::steady_clock::now();
  if ((layout_ && layout_->program.digest == digest) || now < next_fetch_) return false;
  next_fetch_ = now + kFetchPause;
  auto container = runtime_->program();
  if (!container) return true;  // asked again; the page says meanwhile that it knows no program
  next_fetch_ = now;
  // Another program may have come since the image was taken; its own images follow.
  if (service::to_hex(service::sha256(*container)) != digest) return true;
  auto layout = server::read_layout(*container, digest);
  if (!layout) {
    next_fetch_ = now + kFetchPause;
    log_.warning("program", result::to_string(layout.error()), {{"digest", digest}});
    return true;
  }
  for (const protocol::LeftOutArray& array : layout->program.left_out)
    log_.info("program", "the page is told no values of the array '" + array.name + "', which has " +
                             std::to_string(array.values) + " single ones (hmi_web/doc/tags.md)");
  if (auto info = reader::ProgramInfo::read(*container)) {
    std::string document(reader::document_text(*container));
    running_.set(std::make_shared<const KnownProgram>(
        KnownProgram{digest, std::move(*info), std::move(document),
                     std::make_shared<const std::vector<std::byte>>(std::move(*container))}));
  }
  layout_ = std::make_shared<const server::ProgramLayout>(std::move(*layout));
  return true;
}

}  // namespace stepwright::hmi
