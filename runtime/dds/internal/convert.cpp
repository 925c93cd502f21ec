#include "runtime/dds/internal/convert.h"

#include <algorithm>
#include <cstring>

#include "runtime/host/limits.h"

namespace stepwright::dds::internal {
namespace {

std::string cut(const std::string& text, std::size_t bound) {
  return text.size() <= bound ? text : text.substr(0, bound);
}

// Hexadecimal; empty without a program.
bool fits_digest(const std::string& text) {
  constexpr std::size_t kDigits = 64;
  return text.size() <= kDigits;
}

bool within_bounds(const idl::Problem& problem) {
  const auto fits = [](const std::string& text) { return text.size() <= idl::TEXT_BOUND; };
  return problem.severity() <= static_cast<std::uint8_t>(result::Severity::Error) &&
         problem.code().size() <= idl::NAME_BOUND && fits(problem.file()) && fits(problem.message()) &&
         fits(problem.hint());
}

std::vector<std::uint8_t> to_octets(const std::vector<std::byte>& bytes) {
  const auto* octets = reinterpret_cast<const std::uint8_t*>(bytes.data());
  return {octets, octets + bytes.size()};
}

std::vector<std::byte> from_octets(const std::vector<std::uint8_t>& octets) {
  const auto* bytes = reinterpret_cast<const std::byte*>(octets.data());
  return {bytes, bytes + octets.size()};
}

std::vector<idl::NamedValue> to_plant(const std::vector<NamedValue>& plant) {
  std::vector<idl::NamedValue> out(std::min<std::size_t>(plant.size(), idl::PLANT_BOUND));
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i].name(cut(plant[i].name, idl::NAME_BOUND));
    out[i].value(plant[i].value);
  }
  return out;
}

std::optional<std::vector<NamedValue>> from_plant(const std::vector<idl::NamedValue>& plant) {
  const bool bounded = plant.size() <= idl::PLANT_BOUND &&
                       std::all_of(plant.begin(), plant.end(), [](const idl::NamedValue& value) {
                         return value.name().size() <= idl::NAME_BOUND;
                       });
  if (!bounded) return std::nullopt;
  std::vector<NamedValue> out;
  out.reserve(plant.size());
  for (const idl::NamedValue& value : plant) out.push_back({value.name(), value.value()});
  return out;
}

}  // namespace

idl::Reply to_reply(const std::string& runtime_id, const service::Reply& reply) {
  idl::Reply sample;
  sample.runtime_id(runtime_id);
  sample.client(reply.client);
  sample.request(reply.id);
  const std::size_t problems = std::min<std::size_t>(reply.problems.size(), idl::PROBLEM_BOUND);
  for (std::size_t i = 0; i < problems; ++i) {
    const result::Diagnostic& diagnostic = reply.problems[i];
    idl::Problem problem;
    problem.code(cut(diagnostic.code, idl::NAME_BOUND));
    problem.severity(static_cast<std::uint8_t>(diagnostic.severity));
    problem.file(cut(diagnostic.where.file, idl::TEXT_BOUND));
    problem.line(diagnostic.where.line);
    problem.column(diagnostic.where.column);
    problem.message(cut(diagnostic.message, idl::TEXT_BOUND));
    problem.hint(cut(diagnostic.hint, idl::TEXT_BOUND));
    sample.problems().push_back(std::move(problem));
  }
  sample.digest(reply.digest);
  sample.total_bytes(reply.total_bytes);
  sample.offset(reply.offset);
  sample.data(to_octets(reply.data));
  sample.change().carried(reply.change.carried);
  sample.change().initialised(reply.change.initialised);
  sample.change().dropped(reply.change.dropped);
  sample.change().retyped(reply.change.retyped);
  sample.change().dropped_forces(reply.change.dropped_forces);
  sample.change().pause_us(reply.change.pause_us);
  return sample;
}

std::optional<service::Reply> from_reply(const idl::Reply& sample) {
  if (sample.problems().size() > idl::PROBLEM_BOUND || sample.data().size() > idl::CHUNK_BOUND ||
      !fits_digest(sample.digest())) {
    return std::nullopt;
  }
  service::Reply reply{sample.client(),      sample.request(), {}, sample.digest(),
                       sample.total_bytes(), sample.offset(),  {}, {}};
  for (const idl::Problem& problem : sample.problems()) {
    if (!within_bounds(problem)) return std::nullopt;
    reply.problems.push_back({problem.code(),
                              static_cast<result::Severity>(problem.severity()),
                              {problem.file(), problem.line(), problem.column()},
                              problem.message(),
                              problem.hint()});
  }
  reply.data = from_octets(sample.data());
  const idl::ChangeReport& change = sample.change();
  reply.change = {change.carried(), change.initialised(),    change.dropped(),
                  change.retyped(), change.dropped_forces(), change.pause_us()};
  return reply;
}

idl::Event to_event(const std::string& runtime_id, std::uint64_t incarnation, const StepEvent& event) {
  idl::Event sample;
  sample.runtime_id(runtime_id);
  sample.incarnation(incarnation);
  sample.event(event.sequence);
  sample.scan(event.scan);
  sample.time_ns(event.time_ns);
  sample.kind(static_cast<std::uint8_t>(event.kind));
  sample.program_digest(event.program_digest);
  sample.detail(cut(event.detail, idl::TEXT_BOUND));
  sample.image(to_octets(event.image));
  sample.plant(to_plant(event.plant));
  return sample;
}

std::optional<StepEvent> from_event(const idl::Event& sample) {
  auto plant = from_plant(sample.plant());
  if (!plant || sample.image().size() > idl::IMAGE_BOUND || !fits_digest(sample.program_digest()) ||
      sample.detail().size() > idl::TEXT_BOUND ||
      sample.kind() > static_cast<std::uint8_t>(EventKind::RolledBack)) {
    return std::nullopt;
  }
  return StepEvent{sample.event(),
                   sample.scan(),
                   sample.time_ns(),
                   static_cast<EventKind>(sample.kind()),
                   sample.program_digest(),
                   sample.detail(),
                   from_octets(sample.image()),
                   std::move(*plant)};
}

namespace {

idl::Spread to_spread(const host::DurationSpread& spread) {
  idl::Spread sample;
  sample.p50_us(spread.p50_us);
  sample.p99_us(spread.p99_us);
  sample.p999_us(spread.p999_us);
  sample.p9999_us(spread.p9999_us);
  sample.max_us(spread.max_us);
  return sample;
}

host::DurationSpread from_spread(const idl::Spread& sample) {
  return {sample.p50_us(), sample.p99_us(), sample.p999_us(), sample.p9999_us(), sample.max_us()};
}

idl::TaskStatus to_task(const host::TaskStatus& task) {
  idl::TaskStatus sample;
  sample.name(cut(task.name, idl::NAME_BOUND));
  sample.interval_us(task.interval_us);
  sample.priority(task.priority);
  sample.cycles(task.cycles);
  sample.overruns(task.overruns);
  sample.skipped(task.skipped);
  sample.latency(to_spread(task.latency));
  sample.execution(to_spread(task.execution));
  sample.jitter(to_spread(task.jitter));
  return sample;
}

host::TaskStatus from_task(const idl::TaskStatus& sample) {
  return {sample.name(),
          sample.interval_us(),
          sample.priority(),
          sample.cycles(),
          sample.overruns(),
          sample.skipped(),
          from_spread(sample.latency()),
          from_spread(sample.execution()),
          from_spread(sample.jitter())};
}

}  // namespace

idl::Status to_status(const std::string& runtime_id, const RuntimeStatus& status, bool runtime_connected) {
  idl::Status sample;
  sample.runtime_id(runtime_id);
  sample.runtime_connected(runtime_connected);
  sample.incarnation(status.incarnation);
  sample.state(static_cast<std::uint8_t>(status.state));
  sample.program_digest(status.program_digest);
  sample.scan(status.scan);
  sample.time_ns(status.time_ns);
  sample.last_event(status.last_event);
  sample.overruns(status.overruns);
  sample.scan_p50_us(status.scan_p50_us);
  sample.scan_p99_us(status.scan_p99_us);
  sample.scan_max_us(status.scan_max_us);
  sample.realtime_factor(status.realtime_factor);
  sample.trace_hash(status.trace_hash);
  sample.waiting_for_supervisor(status.waiting_for_supervisor);
  sample.detail(cut(status.detail, idl::TEXT_BOUND));
  sample.plant(to_plant(status.plant));
  for (const host::TaskStatus& task : status.tasks) {
    if (sample.tasks().size() < idl::TASK_BOUND) sample.tasks().push_back(to_task(task));
  }
  idl::ProcessFigures process;
  process.version(cut(status.process.version, idl::TEXT_BOUND));
  process.uptime_s(status.process.uptime_s);
  process.resident_bytes(status.process.resident_bytes);
  process.clients(status.process.clients);
  process.traps(status.process.traps);
  process.lost_events(status.process.lost_events);
  process.warnings(status.process.warnings);
  sample.process(process);
  sample.changes(status.changes);
  sample.last_change_pause_us(status.last_change_pause_us);
  return sample;
}

std::optional<RuntimeStatus> from_status(const idl::Status& sample) {
  auto plant = from_plant(sample.plant());
  if (!plant || !fits_digest(sample.program_digest()) || sample.detail().size() > idl::TEXT_BOUND ||
      sample.process().version().size() > idl::TEXT_BOUND ||
      sample.state() > static_cast<std::uint8_t>(RuntimeState::Fault) ||
      sample.tasks().size() > idl::TASK_BOUND) {
    return std::nullopt;
  }
  RuntimeStatus status;
  for (const idl::TaskStatus& task : sample.tasks()) {
    if (task.name().size() > idl::NAME_BOUND) return std::nullopt;
    status.tasks.push_back(from_task(task));
  }
  status.incarnation = sample.incarnation();
  status.state = static_cast<RuntimeState>(sample.state());
  status.program_digest = sample.program_digest();
  status.scan = sample.scan();
  status.time_ns = sample.time_ns();
  status.last_event = sample.last_event();
  status.overruns = sample.overruns();
  status.scan_p50_us = sample.scan_p50_us();
  status.scan_p99_us = sample.scan_p99_us();
  status.scan_max_us = sample.scan_max_us();
  status.realtime_factor = sample.realtime_factor();
  status.trace_hash = sample.trace_hash();
  status.waiting_for_supervisor = sample.waiting_for_supervisor();
  status.detail = sample.detail();
  status.plant = std::move(*plant);
  const idl::ProcessFigures& process = sample.process();
  status.process = {process.version(), process.uptime_s(),    process.resident_bytes(), process.clients(),
                    process.traps(),   process.lost_events(), process.warnings()};
  status.changes = sample.changes();
  status.last_change_pause_us = sample.last_change_pause_us();
  return status;
}

idl::Snapshot to_snapshot(const std::string& runtime_id, const Snapshot& snapshot) {
  idl::Snapshot sample;
  sample.runtime_id(runtime_id);
  sample.scan(snapshot.scan);
  sample.time_ns(snapshot.time_ns);
  sample.program_digest(snapshot.program_digest);
  sample.image(to_octets(snapshot.image));
  sample.plant(to_plant(snapshot.plant));
  return sample;
}

std::optional<Snapshot> from_snapshot(const idl::Snapshot& sample) {
  auto plant = from_plant(sample.plant());
  if (!plant || sample.image().size() > idl::IMAGE_BOUND || !fits_digest(sample.program_digest())) {
    return std::nullopt;
  }
  return Snapshot{sample.scan(), sample.time_ns(), sample.program_digest(), from_octets(sample.image()),
                  std::move(*plant)};
}

}  // namespace stepwright::dds::internal
