#pragma once

// Every structure on the wire with its fields in wire order and their bounds: one list for writing and
// reading (message_coder.h), on the service socket and on Fast DDS. A change needs a new kProtocolVersion.
// Requests have no bounds here: too large ones are answered (R0004).
//
// Pure; any thread.

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "runtime/bytecode/container_format.h"
#include "runtime/host/duration_counts.h"
#include "runtime/host/limits.h"
#include "runtime/service/messages.h"

namespace stepwright::service::internal {

template <typename T, typename Plain>
concept Like = std::same_as<std::remove_const_t<T>, Plain>;

// A text or a list of which the first ones are sent; one that brings more than `most` is malformed.
template <typename T>
struct First {
  std::size_t most;
  T& value;
};
template <typename T>
First(std::size_t, T&) -> First<T>;

// A text or a list that is not sent if it has more than `most`; one that brings more is malformed.
template <typename T>
struct AtMost {
  std::size_t most;
  T& value;
};
template <typename T>
AtMost(std::size_t, T&) -> AtMost<T>;

// A number that is sent as `least` if it lies outside; one that comes from outside is malformed, as is NaN.
template <typename T>
struct Within {
  std::remove_const_t<T> least;
  std::remove_const_t<T> most;
  T& value;

  bool holds() const { return value >= least && value <= most; }
};

template <typename T, typename Plain>
Within<T> within(Plain least, Plain most, T& value) {
  return {least, most, value};
}
template <typename T>
Within<T> duration(T& us) {
  return {0.0, std::numeric_limits<double>::max(), us};
}

// The highest value of every enumeration on the wire.
constexpr Role last_of(Role) {
  return Role::Controller;
}
constexpr host::EventKind last_of(host::EventKind) {
  return host::EventKind::RolledBack;
}
constexpr scan::SafeCause last_of(scan::SafeCause) {
  return scan::SafeCause::Killed;
}
constexpr host::DownloadMode last_of(host::DownloadMode) {
  return host::DownloadMode::ChangeRestartCharts;
}
constexpr host::RuntimeState last_of(host::RuntimeState) {
  return host::RuntimeState::Fault;
}
constexpr result::Severity last_of(result::Severity) {
  return result::Severity::Error;
}
constexpr IoKind last_of(IoKind) {
  return IoKind::Nothing;
}

// The fields of every structure.
template <typename A, Like<Hello> T>
void fields(A& a, T& m) {
  a(m.version, m.role, m.first_event, m.name);
}
template <typename A, Like<Welcome> T>
void fields(A& a, T& m) {
  a(m.version);
}
template <typename A, Like<SupervisorLife> T>
void fields(A& a, T& m) {
  a(m.alive);
}
template <typename A, Like<Start> T>
void fields(A& a, T& m) {
  a(m.barrier, m.cold);
}
template <typename A, Like<Stop> T>
void fields(A& a, T& m) {
  a(m.reason);
}
template <typename A, Like<Acknowledge> T>
void fields(A& a, T& m) {
  a(m.event);
}
template <typename A, Like<host::ImageBits> T>
void fields(A& a, T& m) {
  a(m.byte_offset, m.mask, m.value);
}
template <typename A, Like<host::ProgramBits> T>
void fields(A& a, T& m) {
  a(m.program_digest, m.bits);
}
template <typename A, Like<Force> T>
void fields(A& a, T& m) {
  a(m.force.place, m.force.duration_ms);
}
template <typename A, typename T>
requires Like<T, Unforce> || Like<T, Write>
void fields(A& a, T& m) {
  a(m.place);
}
template <typename A, Like<host::BlockWrite> T>
void fields(A& a, T& m) {
  a(m.program_digest, m.parts);
}
template <typename A, Like<WriteBlock> T>
void fields(A& a, T& m) {
  a(m.block);
}
template <typename A, Like<InjectFault> T>
void fields(A& a, T& m) {
  a(m.name, m.value);
}
template <typename A, Like<DownloadBegin> T>
void fields(A& a, T& m) {
  a(m.total_bytes, m.digest);
}
template <typename A, Like<DownloadCommit> T>
void fields(A& a, T& m) {
  a(m.total_bytes, m.digest, m.mode);
}
template <typename A, Like<DownloadChunk> T>
void fields(A& a, T& m) {
  a(m.offset, m.data);
}
template <typename A, Like<ReadProgram> T>
void fields(A& a, T& m) {
  a(m.offset);
}
template <typename A, typename T>
requires Like<T, ResendEvents> || Like<T, ReadFaults>
void fields(A& a, T& m) {
  a(m.first);
}
template <typename A, typename T>
requires Like<T, ReadForces> || Like<T, Continue> || Like<T, EndRecording> || Like<T, ReadRecording> ||
    Like<T, Reload>
void fields(A&, T&) {}
template <typename A, Like<Step> T>
void fields(A& a, T& m) {
  a(m.scans);
}
template <typename A, Like<BeginRecording> T>
void fields(A& a, T& m) {
  a(m.file, m.max_bytes, m.hash_every, m.keyframe_every);
}
template <typename A, Like<Request> T>
void fields(A& a, T& m) {
  a(m.client, m.id, m.supervisor, m.body);
}
template <typename A, Like<result::Location> T>
void fields(A& a, T& m) {
  a(First{host::kMaxTextBytes, m.file}, m.line, m.column);
}
template <typename A, Like<result::Diagnostic> T>
void fields(A& a, T& m) {
  a(First{host::kMaxNameBytes, m.code}, m.severity, m.where, First{host::kMaxTextBytes, m.message},
    First{host::kMaxTextBytes, m.hint});
}
template <typename A, Like<host::ChangeReport> T>
void fields(A& a, T& m) {
  a(m.carried, m.initialised, m.dropped, m.retyped, m.dropped_forces, m.pause_us);
}
template <typename A, Like<Reply> T>
void fields(A& a, T& m) {
  a(m.client, m.id, First{host::kMaxProblems, m.problems}, AtMost{host::kDigestLetters, m.digest},
    m.total_bytes, m.offset, AtMost{host::kMaxChunkBytes, m.data}, m.change);
}
template <typename A, Like<host::NamedValue> T>
void fields(A& a, T& m) {
  a(First{host::kMaxNameBytes, m.name}, m.value);
}
template <typename A, Like<host::StepEvent> T>
void fields(A& a, T& m) {
  a(m.incarnation, m.sequence, m.scan, m.time_ns, m.kind, AtMost{host::kDigestLetters, m.program_digest},
    First{host::kMaxTextBytes, m.detail}, AtMost{host::kMaxImageBytes, m.image},
    First{host::kMaxPlantValues, m.plant}, m.cause);
}
template <typename A, Like<host::Snapshot> T>
void fields(A& a, T& m) {
  a(m.incarnation, m.scan, m.time_ns, AtMost{host::kDigestLetters, m.program_digest},
    AtMost{host::kMaxImageBytes, m.image}, First{host::kMaxPlantValues, m.plant});
}
template <typename A, Like<host::DurationSpread> T>
void fields(A& a, T& m) {
  a(m.p50_us, m.p99_us, m.p999_us, m.p9999_us, m.max_us);
}
template <typename A, Like<host::TaskStatus> T>
void fields(A& a, T& m) {
  a(First{host::kMaxNameBytes, m.name}, m.interval_us, m.priority, m.cycles, m.overruns, m.skipped, m.latency,
    m.execution, m.jitter);
}
template <typename A, Like<host::DurationCounts> T>
void fields(A& a, T& m) {
  constexpr std::uint32_t kMost = host::kMaxDurationCounts;
  a(within(0u, kMost - 1, m.first));
  a(First{kMost - std::min(m.first, kMost), m.counts});
}
template <typename A, Like<host::TaskDetail> T>
void fields(A& a, T& m) {
  a(First{host::kMaxNameBytes, m.name}, m.watchdog_us, m.watchdog_sensitivity, m.too_long,
    m.watchdog_expiries, m.latency, m.execution, m.jitter);
}
template <typename A, Like<host::ProcessFigures> T>
void fields(A& a, T& m) {
  a(First{host::kMaxTextBytes, m.version}, m.uptime_s, m.resident_bytes, m.clients, m.traps, m.lost_events,
    m.warnings);
}
template <typename A, Like<host::RuntimeStatus> T>
void fields(A& a, T& m) {
  a(m.incarnation, m.state, AtMost{host::kDigestLetters, m.program_digest}, m.scan, m.time_ns, m.last_event,
    m.overruns, m.scan_p50_us, m.scan_p99_us, m.scan_max_us, m.realtime_factor, m.trace_hash,
    m.waiting_for_supervisor, First{host::kMaxTextBytes, m.detail}, m.changes, m.last_change_pause_us,
    First{host::kMaxPlantValues, m.plant}, First{bytecode::kMaxTasks, m.tasks},
    First{bytecode::kMaxTasks, m.task_details}, m.process);
}
template <typename A, Like<LinkStatus> T>
void fields(A& a, T& m) {
  a(m.status, m.runtime_connected);
}
template <typename A, Like<DeviceHealth> T>
void fields(A& a, T& m) {
  a(First{host::kMaxNameBytes, m.name}, First{host::kMaxReasonBytes, m.endpoint}, m.unit, m.online, m.lost,
    First{host::kMaxReasonBytes, m.error}, m.requests, m.timeouts, m.exceptions, m.bad_answers,
    m.connection_losses, duration(m.answer_p50_us), duration(m.answer_p99_us), duration(m.answer_max_us),
    within(std::int64_t{-1}, std::numeric_limits<std::int64_t>::max(), m.answer_age_ms));
}
template <typename A, Like<RuntimeHealth> T>
void fields(A& a, T& m) {
  a(m.readers, First{bytecode::kMaxTasks, m.tasks}, m.io, m.devices_known,
    First{host::kMaxReasonBytes, m.devices_problem}, First{host::kMaxDevices, m.devices});
}
template <typename A, Like<Presence> T>
void fields(A& a, T& m) {
  a(First{host::kMaxProcessBytes, m.process}, m.client);
}
template <typename A, Like<Beacon> T>
void fields(A& a, T& m) {
  a(First{host::kMaxNameBytes, m.runtime_id}, First{host::kMaxPathBytes, m.place});
}
template <typename A, Like<OperatorRequest> T>
void fields(A& a, T& m) {
  a(m.client, m.number, AtMost{kMaxOperatorRequestBytes, m.text});
}
template <typename A, Like<OperatorAnswer> T>
void fields(A& a, T& m) {
  a(m.client, m.number, First{kMaxOperatorProblems, m.problems});
}

}  // namespace stepwright::service::internal
