#include "programs/hmi/dds_cell_change.h"

#include <algorithm>
#include <utility>

#include "cell/hmi/supervisor_word.h"
#include "cell/monitors/cell_monitors.h"
#include "hmi_web/api/cell_codes.h"
#include "programs/hmi/compile_sources.h"
#include "programs/hmi/source_cache.h"
#include "runtime/bytecode/reader/document_text.h"
#include "runtime/bytecode/writer/document_section.h"
#include "runtime/ground/result/last_barrier.h"
#include "runtime/service/digest.h"

namespace stepwright::hmi {
namespace {

using api::Trial;
using result::Result;

constexpr std::chrono::milliseconds kEventTurn{200};
// The event that says why comes with the status that shows it, a little before or behind.
constexpr std::chrono::seconds kForTheReason{3};

// "9f.. trapped: main.st:3:5: error R0400: division by zero" without the digest, which the page names anyway.
std::string reason_of(const std::string& detail) {
  constexpr std::string_view kBefore = " trapped: ";
  const std::size_t at = detail.find(kBefore);
  return at == std::string::npos ? detail : detail.substr(at + kBefore.size());
}

// The first digest of "from 9f.. to 3a..".
std::optional<std::string> replaced_by(const std::string& detail) {
  constexpr std::string_view kFrom = "from ";
  const std::size_t end = detail.find(" to ");
  if (!detail.starts_with(kFrom) || end == std::string::npos) return std::nullopt;
  return detail.substr(kFrom.size(), end - kFrom.size());
}

void end(Trial& trial, Trial::State state, std::string why) {
  while (!why.empty() && why.back() == '\n') why.pop_back();
  trial.state = state;
  trial.why = std::move(why);
}

}  // namespace

DdsCellChange::DdsCellChange(DdsCellSource& source, const config::CellConfig& config)
    : source_(source),
      trial_scans_(config.change.trial_scans),
      dialect_(config.mission.table ? config.mission.table->dialect()
                                    : *source::find_dialect(config.boot.dialect)),
      config_(config),
      remote_(config.controller.remote()),
      listener_([this](const std::stop_token& stop) { listen(stop); }) {}

void DdsCellChange::listen(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    // An event that cannot be taken is missed; the status shows the same a little later.
    static_cast<void>(result::thrown_by([this] {
      if (const auto event = source_.client().wait_event(kEventTurn)) take(*event);
    }));
  }
}

void DdsCellChange::take(const dds::StepEvent& event) {
  const std::lock_guard lock(mutex_);
  if (!change_) return;
  if (event.kind == dds::EventKind::Changed && event.program_digest == change_->to) {
    change_->swap_scan = event.scan;
    // Whoever was faster by a moment: the runtime goes back to the program that it really replaced.
    if (auto from = replaced_by(event.detail)) change_->from = *std::move(from);
  }
  if (event.kind == dds::EventKind::RolledBack && event.detail.starts_with(change_->to))
    change_->rolled_back = reason_of(event.detail);
}

Result<api::LoadedNow> DdsCellChange::loaded() {
  const auto program = source_.running().get();
  const auto status = source_.client().status();
  if (!program || !status || !source_.client().runtime_alive())
    return result::fail(api::kNobodyAnswers, {}, "no runtime answers with a program",
                        "is the runtime of the cell running?");
  if (status->program_digest != program->digest)
    return result::fail(api::kProgramJustChanged, {}, "the program has just changed",
                        "try again in a moment");
  api::LoadedNow now{program->digest, program->container, status->state == dds::RuntimeState::Running, {}};
  auto snapshot = source_.client().snapshot();
  if (snapshot && snapshot->program_digest == now.digest) now.image = std::move(snapshot->image);
  return now;
}

std::string DdsCellChange::engaged() {
  const auto document = source_.plans().latest();
  if (!document) return {};
  const auto status = source_.client().status();
  return at_work(*document, source_.plans().supervisor_alive(), status ? status->program_digest : "");
}

std::vector<std::byte> DdsCellChange::fitted(std::vector<std::byte> container) {
  return remote_ ? writer::without_document(container) : container;
}

Result<api::Takeover> DdsCellChange::change(std::span<const std::byte> container, bool restart_charts) {
  const auto before = source_.client().status();
  if (!before)
    return result::fail(api::kNobodyAnswers, {}, "no runtime answers", "is the runtime of the cell running?");
  {
    const std::lock_guard lock(mutex_);
    change_ = Change{before->program_digest,
                     service::to_hex(service::sha256(container)),
                     before->incarnation,
                     before->changes,
                     {},
                     {},
                     {},
                     {Trial::State::Running, 0, trial_scans_, ""}};
  }
  auto done = source_.client().download(
      container, restart_charts ? dds::DownloadMode::ChangeRestartCharts : dds::DownloadMode::Change);
  if (!done) {
    const std::lock_guard lock(mutex_);
    change_.reset();
    return result::forward(done);
  }
  api::Takeover takeover{done->change.carried,
                         done->change.initialised,
                         done->change.dropped,
                         done->change.retyped,
                         done->change.dropped_forces,
                         done->change.pause_us,
                         {}};
  for (const result::Diagnostic& note : done->notes) takeover.notes.push_back(note.message);
  return takeover;
}

Trial DdsCellChange::trial() {
  const auto status = source_.client().status();
  const std::lock_guard lock(mutex_);
  if (!change_) return {};
  if (status && change_->trial.state == Trial::State::Running) judge(*change_, *status);
  return change_->trial;
}

// By the newest status; the event only says why, and when it began.
void DdsCellChange::judge(Change& change, const dds::RuntimeStatus& status) const {
  Trial& trial = change.trial;
  if (status.incarnation != change.incarnation)
    return end(trial, Trial::State::Ended, "the runtime was started again meanwhile");
  if (status.changes <= change.changes_before) return;  // from before the change
  if (status.program_digest == change.from) {
    const auto now = Clock::now();
    if (!change.gone_back) change.gone_back = now;
    if (!change.rolled_back && now < *change.gone_back + kForTheReason) return;
    return end(trial, Trial::State::RolledBack, change.rolled_back.value_or(status.detail));
  }
  if (status.program_digest != change.to)
    return end(trial, Trial::State::Ended, "another program was brought meanwhile");
  if (status.state != dds::RuntimeState::Running)
    return end(trial, Trial::State::Ended, "the program was stopped: " + status.detail);
  if (!change.swap_scan) change.swap_scan = status.scan;
  const std::uint64_t scans = status.scan - std::min(status.scan, *change.swap_scan);
  trial.scan = static_cast<std::uint32_t>(std::min<std::uint64_t>(scans, trial.scans));
  if (scans >= trial.scans) end(trial, Trial::State::Kept, "");
}

Result<api::Compiled> DdsCellChange::compile(const api::SourceTexts& sources) {
  const auto monitors = cell_monitors::cell_monitors(config_);
  if (!monitors) return tl::unexpected(monitors.error());
  return compile_sources(sources, dialect_, cell_monitors::watchers_of(*monitors));
}

api::Answer DdsCellChange::sources(const std::string& digest, std::span<const std::byte> container) {
  const auto info = reader::ProgramInfo::read(container);
  if (!info) return api::refused(info.error());
  return sources_of(digest, *info, reader::document_text(container));
}

}  // namespace stepwright::hmi
