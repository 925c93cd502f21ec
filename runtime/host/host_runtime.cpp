#include "runtime/host/host_runtime.h"

#include <algorithm>
#include <future>
#include <random>
#include <system_error>
#include <utility>

#include "runtime/host/busy.h"
#include "runtime/host/named_values.h"
#include "runtime/host/status_detail.h"
#include "runtime/host/task_status.h"

namespace stepwright::host {
namespace {

// Fewer than the queues of the scan loop hold.
constexpr std::size_t kMaxUnderWay = 200;
// What goes ahead of the others has some room of its own.
constexpr std::size_t kMaxUrgentUnderWay = 250;
constexpr double kNsPerUs = 1'000.0;

// What the system refused to the scan thread and its process.
std::string enter_real_time(int cpu) {
  std::string refused = place_thread({.cpu = cpu});
  const std::string unlocked = lock_memory();
  if (!refused.empty() && !unlocked.empty()) refused += "; ";
  return refused + unlocked;
}

std::uint64_t random_incarnation() {
  std::random_device source;
  const std::uint64_t high = source();
  return (high << 32 | source()) | 1u;
}

// A watchdog's expiry (R0041) says in the reason what took how long.
std::string trap_text(const bytecode::Program& program, const EventNote& note) {
  result::Diagnostic diagnostic = reader::describe(program, note.trap);
  if (!note.reason.view().empty()) {
    diagnostic.code = "R0041";
    diagnostic.message = note.reason.str();
  }
  return result::to_string(diagnostic);
}

}  // namespace

result::Result<std::unique_ptr<HostRuntime>> HostRuntime::create(const HostConfig& config,
                                                                 image::IoDriver& driver,
                                                                 PlantAccess* plant) {
  const auto names = plant == nullptr ? std::span<const std::string>{} : plant->value_names();
  auto snapshots = SnapshotWriter::create(names);
  if (!snapshots) return result::forward(snapshots);
  auto reader = SnapshotReader::open((*snapshots)->descriptor());
  if (!reader) return result::forward(reader);
  try {
    std::unique_ptr<HostRuntime> self(
        new HostRuntime(config, driver, plant, std::move(*snapshots), std::move(*reader)));
    if (!self->loop_->ok()) return result::fail("R0077", {}, "the system gives no more descriptors");
    self->start_threads();
    return self;
  } catch (const std::system_error& error) {
    return result::fail("R0077", {}, std::string("the system gives no thread: ") + error.what(),
                        "the limit of processes (ulimit -u) may be reached");
  }
}

void HostRuntime::start_threads() {
  std::promise<std::string> entered;
  std::future<std::string> refused = entered.get_future();
  thread_ = std::thread([loop = loop_.get(), real = config_.clock == ClockMode::Real, cpu = config_.cpu,
                         entered = std::move(entered)]() mutable {
    entered.set_value(real ? enter_real_time(cpu) : std::string());
    loop->run();
  });
  refused_ = refused.get();
  monitor_.start();
}

HostRuntime::HostRuntime(const HostConfig& config, image::IoDriver& driver, PlantAccess* plant,
                         std::unique_ptr<SnapshotWriter> snapshots, std::unique_ptr<SnapshotReader> reader)
    : config_(config),
      io_(driver, config.input_bytes, config.output_bytes),
      plant_(plant),
      plant_names_(plant == nullptr ? std::span<const std::string>{} : plant->value_names()),
      snapshots_(std::move(snapshots)),
      reader_(std::move(reader)),
      incarnation_(random_incarnation()),
      retain_(record::RetainManager::open(config_.retain)),
      loop_(std::make_unique<ScanLoop>(config_, io_, plant, *snapshots_, *retain_)),
      monitor_(config.safety.monitor_ns, [this] { io_.beat(); }),
      preparer_([this](PreparationJob job) { return prepare(std::move(job)); },
                [this] { loop_->news().notify(); }) {
  monitor_.watch(loop_->liveness());
}

HostRuntime::~HostRuntime() {
  end();
}

void HostRuntime::end() {
  if (!thread_.joinable()) return;
  loop_->quit();
  thread_.join();
}

result::Result<void> HostRuntime::record(std::uint64_t ticket, const record::RecordingOptions& options) {
  const record::RuntimeFacts facts{config_.clock == ClockMode::Real, scan::ScanConfig{}.budget,
                                   config_.safety.safe_state.matrix()};
  auto session = recorder_.begin(options, facts);
  if (!session) return result::forward(session);
  programs_.for_each([this](const PreparedProgram& program) {
    recorder_.announce(program.digest(), program.loaded().bytes());
  });
  Command command;
  command.kind = CommandKind::RecordBegin;
  command.ticket = ticket;
  command.recording = *session;
  if (send(command)) return {};
  recorder_.abandon();
  return busy();
}

Forces HostRuntime::forces() const {
  const ForceList list = loop_->forces();
  const std::int64_t now_ns = loop_->clock().now_ns();
  Forces forces{list.program_digest.str(), {}};
  for (image::Force force : std::span(list.forces).first(list.count)) {
    if (force.end_ns != image::kNoEnd) force.end_ns = std::max<std::int64_t>(0, force.end_ns - now_ns);
    forces.places.push_back(force);
  }
  return forces;
}

std::vector<PlantFault> HostRuntime::faults() const {
  return plant_ == nullptr ? std::vector<PlantFault>() : plant_->faults();
}

bool HostRuntime::submit(const Command& command) {
  return send(command);
}

result::Result<void> HostRuntime::write(std::uint64_t ticket, BlockWrite block) {
  auto held = std::make_unique<const BlockWrite>(std::move(block));
  Command command;
  command.kind = CommandKind::WriteBlock;
  command.ticket = ticket;
  command.block = held.get();
  command.program_digest = FixedText<kDigestLetters>(held->program_digest);
  if (!send(command)) return busy();
  blocks_.emplace(ticket, std::move(held));
  return {};
}

bool HostRuntime::send(const Command& command) {
  const std::size_t most = goes_ahead(command.kind) ? kMaxUrgentUnderWay : kMaxUnderWay;
  if (commands_under_way_ >= most) return false;
  Command ordered = command;
  ordered.order = ++last_order_;
  // What is to be started is the program that is on its way.
  if (command.kind == CommandKind::Start && preparer_.under_way() > 0) {
    starts_.push_back(ordered);
    ++commands_under_way_;
    return true;
  }
  return pass_on(ordered);
}

bool HostRuntime::pass_on(Command command) {
  if (!loop_->submit(std::move(command))) return false;
  ++commands_under_way_;
  return true;
}

std::optional<Completion> HostRuntime::take_completion() {
  take_preparations();
  if (!refusals_.empty()) {
    Completion refusal = std::move(refusals_.front());
    refusals_.pop_front();
    return refusal;
  }
  auto completion = loop_->take_completion();
  if (!completion) return std::nullopt;
  --commands_under_way_;
  blocks_.erase(completion->ticket);
  const ProgramRegistry::Held* held = programs_.done(completion->ticket);
  if (held != nullptr && held->plan != nullptr) explain(*held, *completion);
  return completion;
}

std::optional<StepEvent> HostRuntime::take_event() {
  const ScanFigures figures = loop_->figures();
  const ProgramRegistry::Held* held = programs_.next_event();
  if (held == nullptr) {
    if (!changing_) preparer_.discard(programs_.take_unused(figures.program, figures.kept));
    return std::nullopt;
  }
  EventRing& ring = held->program->events();
  const bool was_full = ring.full();
  StepEvent event = to_event(*held->program, *ring.front());
  ring.pop();
  if (was_full) loop_->events_taken();
  newest_ = {event.kind, event.program_digest, event.detail};
  if (event.kind == EventKind::Trap) ++traps_;
  return event;
}

StepEvent HostRuntime::to_event(const PreparedProgram& program, const EventRing::Slot& slot) const {
  StepEvent event;
  event.sequence = slot.note.sequence;
  event.scan = slot.note.scan;
  event.time_ns = slot.note.time_ns;
  event.kind = slot.note.kind;
  event.program_digest = program.digest();
  event.detail = slot.note.reason.str();
  event.cause = slot.note.cause;
  if (slot.note.trap) {
    event.detail = trap_text(program.loaded().program(), slot.note);
  }
  if (slot.note.kind == EventKind::Changed)
    event.detail = "from " + slot.note.other->digest() + " to " + program.digest();
  if (slot.note.kind == EventKind::RolledBack) {
    event.detail = slot.note.other->digest() + " trapped: " +
                   result::to_string(reader::describe(slot.note.other->loaded().program(), slot.note.trap));
    if (!slot.note.reason.view().empty()) event.detail += "; " + slot.note.reason.str();
  }
  event.image = slot.image;
  event.plant = named_values(plant_names_, slot.plant);
  return event;
}

// Another program, or the same one loaded or started again, has not stopped for what was said of the one
// before.
bool HostRuntime::still_holds(const NewestEvent& event, const ScanFigures& figures) {
  if (figures.program == nullptr || event.program_digest != figures.program->digest()) return false;
  switch (event.kind) {
    case EventKind::Trap:
      return figures.state == RuntimeState::Fault;
    case EventKind::Stopped:
      return figures.state == RuntimeState::Stopped;
    case EventKind::Changed:
      return false;  // what it was before is no reason why it runs
    default:
      return figures.state == RuntimeState::Running;
  }
}

RuntimeStatus HostRuntime::status() const {
  const ScanFigures figures = loop_->figures();
  RuntimeStatus status;
  status.incarnation = incarnation_;
  status.state = figures.state;
  if (figures.program != nullptr) status.program_digest = figures.program->digest();
  status.scan = figures.scan;
  status.time_ns = figures.time_ns;
  status.overruns = figures.overruns;
  status.scan_p50_us = static_cast<double>(figures.scan_p50_ns) / kNsPerUs;
  status.scan_p99_us = static_cast<double>(figures.scan_p99_ns) / kNsPerUs;
  status.scan_max_us = static_cast<double>(figures.scan_max_ns) / kNsPerUs;
  status.realtime_factor = figures.realtime_factor;
  status.trace_hash = figures.trace_hash;
  status.waiting_for_supervisor = figures.waiting_for_supervisor;
  status.changes = figures.changes;
  status.last_change_pause_us = static_cast<double>(figures.last_change_pause_ns) / kNsPerUs;
  if (still_holds(newest_, figures)) status.detail = newest_.detail;
  const auto note = [&](const std::string& text) { add_detail(status, text); };
  note(refused_);
  const auto warn = [&](const std::string& text) {
    note(text);
    ++status.process.warnings;
  };
  if (const std::string retain = retain_->note(); !retain.empty()) warn(retain);
  {
    const std::lock_guard lock(note_mutex_);
    for (const auto& [of, text] : notes_) warn(text);
  }
  if (const std::int64_t silent_ns = monitor_.silent_ns(); silent_ns > 0)
    note("the scan has not come back for " + std::to_string(silent_ns / 1'000'000) + " ms");
  if (const std::uint64_t held = io_.held_reads(); held > 0)
    note("inputs were held in " + std::to_string(held) +
         " reads: the plant writes faster than they are read");
  status.process.traps = traps_;
  add_events(status, figures.events);
  if (figures.program != nullptr) {
    const TaskPlan& plan = figures.program->tasks();
    note(plan.unknown);
    for (std::uint32_t i = 0; i < plan.tasks.size(); ++i) {
      const scan::TaskTiming timing = figures.program->timing(i);
      status.tasks.push_back(task_status(plan.tasks[i], timing));
      status.task_details.push_back(task_detail(plan.tasks[i], plan.options[i].watchdog, timing));
    }
  }
  if (auto snapshot = reader_->read()) status.plant = std::move(snapshot->plant);
  return status;
}

void HostRuntime::set_note(const std::string& of, std::string note) {
  const std::lock_guard lock(note_mutex_);
  if (note.empty()) {
    notes_.erase(of);
  } else {
    notes_[of] = std::move(note);
  }
}

std::span<const std::byte> HostRuntime::program() const {
  const PreparedProgram* loaded = loop_->figures().program;
  return loaded == nullptr ? std::span<const std::byte>{} : loaded->loaded().bytes();
}

int HostRuntime::descriptor() const {
  return loop_->news().descriptor();
}
void HostRuntime::clear() {
  loop_->news().clear();
}
int HostRuntime::snapshot_descriptor() const {
  return snapshots_->descriptor();
}

}  // namespace stepwright::host
