#include "cell/runtime/runtime_journal.h"

#include <optional>
#include <variant>

#include "runtime/ground/result/counted.h"
#include "runtime/service/digest.h"

namespace stepwright::cell_runtime {
namespace {

// The first digits are enough for a person.
std::string shortened(const std::string& digest) {
  return digest.substr(0, 12);
}

std::optional<service::Sha256> digest_of(const service::RequestBody& body) {
  if (const auto* begin = std::get_if<service::DownloadBegin>(&body)) return begin->digest;
  if (const auto* commit = std::get_if<service::DownloadCommit>(&body)) return commit->digest;
  return std::nullopt;
}

}  // namespace

void RuntimeJournal::event(const host::StepEvent& event) {
  switch (event.kind) {
    case host::EventKind::Started:
      return log_.info("started", "program " + shortened(event.program_digest) + " started",
                       {{"digest", event.program_digest}, {"scan", event.scan}});
    case host::EventKind::Stopped:
      if (event.cause == scan::SafeCause::Killed) {
        return log_.error("stood_still", "program stopped: " + event.detail,
                          {{"digest", event.program_digest}, {"scan", event.scan}});
      }
      return log_.info("stopped", "program stopped: " + event.detail,
                       {{"digest", event.program_digest}, {"scan", event.scan}, {"reason", event.detail}});
    case host::EventKind::Trap:
      return log_.error(event.cause == scan::SafeCause::IoLost ? "lost_io" : "trap",
                        "scan " + std::to_string(event.scan) + ": " + event.detail,
                        {{"digest", event.program_digest}, {"scan", event.scan}, {"reason", event.detail}});
    case host::EventKind::Changed:
      return log_.info("changed", "program changed online " + event.detail,
                       {{"digest", event.program_digest}, {"scan", event.scan}});
    case host::EventKind::RolledBack:
      return log_.error("rolled_back", "the changed program was taken back: " + event.detail,
                        {{"digest", event.program_digest}, {"scan", event.scan}, {"reason", event.detail}});
    case host::EventKind::StepChange:
      return log_.debug("step", "steps changed in scan " + std::to_string(event.scan),
                        {{"sequence", event.sequence}, {"scan", event.scan}});
  }
}

void RuntimeJournal::status(const host::RuntimeStatus& status) {
  if (status.program_digest != digest_) {
    digest_ = status.program_digest;
    log_.info("loaded", "program " + shortened(digest_) + " is loaded", {{"digest", digest_}});
  }
  if (status.overruns > overruns_) {
    const std::uint64_t late = status.overruns - overruns_;
    overruns_ = status.overruns;
    log_.warning("overrun",
                 result::counted(late, "scan", "scans") + " came too late, " + std::to_string(overruns_) +
                     " since the start",
                 {{"late", late}, {"overruns", overruns_}, {"scan_max_us", status.scan_max_us}});
  }
  if (status.process.lost_events > lost_events_) {
    const std::uint64_t lost = status.process.lost_events - lost_events_;
    lost_events_ = status.process.lost_events;
    log_.warning("lost_events",
                 result::counted(lost, "event was", "events were") + " lost: nobody took them in time",
                 {{"lost", lost}, {"lost_events", lost_events_}});
  }
  log_.tick();
}

void RuntimeJournal::client(const std::string& name, service::Role role, bool came) {
  const bool controls = role == service::Role::Controller;
  const char* const word = controls ? "controller" : "observer";
  const std::string text = "client '" + name + "' (" + word + (came ? ") came" : ") left");
  const std::initializer_list<log::Field> fields = {{"name", name}, {"role", word}, {"came", came}};
  // Who only looks may come every few seconds, for the figures.
  controls ? log_.info("client", text, fields) : log_.debug("client", text, fields);
}

void RuntimeJournal::refusal(const std::string& client, const service::Request& request,
                             const service::Reply& reply) {
  const std::string why = result::to_string(reply.problems);
  const auto digest = digest_of(request.body);
  if (!digest && !std::holds_alternative<service::DownloadChunk>(request.body)) {
    return log_.info("refused", "a request of '" + client + "' was refused: " + why,
                     {{"name", client}, {"reason", why}});
  }
  const std::string hex = digest ? service::to_hex(*digest) : std::string();
  log_.warning("refused_download", "download " + shortened(hex) + " of '" + client + "' was refused: " + why,
               {{"name", client}, {"digest", hex}, {"reason", why}});
}

void RuntimeJournal::supervisor(bool alive) {
  if (alive) return log_.info("supervisor", "a supervisor is there", {{"alive", true}});
  log_.warning("supervisor", "the supervisor was lost", {{"alive", false}});
}

}  // namespace stepwright::cell_runtime
