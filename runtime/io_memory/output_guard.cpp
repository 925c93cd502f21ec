#include "runtime/io_memory/output_guard.h"

#include <poll.h>
#include <time.h>
#include <unistd.h>

#include <utility>

#include "runtime/io_memory/process_mark.h"

namespace stepwright::io_memory {
namespace {

// Longer than a runtime takes from wanting the lease to having it, and a killed process to be gone.
constexpr std::int64_t kPatienceNs = 1'000'000'000;
constexpr int kFenceMs = 1'000;
constexpr int kLockAttempts = 20;

// Whatever stands in the memory of others.
scan::SafeCause cause_of(const AreaHeader& header) {
  const std::uint32_t cause = header.cause.load(std::memory_order_relaxed);
  return cause < scan::kSafeCauses ? static_cast<scan::SafeCause>(cause) : scan::SafeCause::Stop;
}

}  // namespace

result::Result<std::unique_ptr<OutputGuard>> OutputGuard::create(const std::string& area,
                                                                 std::uint32_t input_bytes,
                                                                 std::uint32_t output_bytes,
                                                                 const scan::SafeMatrix& matrix,
                                                                 const GuardOptions& options) {
  auto opened = IoArea::open(area, input_bytes, output_bytes);
  if (!opened) return result::forward(opened);
  // One that is about to end, because its runtime did, is given the time for it.
  bool locked = (*opened)->try_lock(AreaLock::Guard);
  for (int i = 0; !locked && i < kLockAttempts; ++i) {
    const timespec pause{0, options.tick_ns};
    nanosleep(&pause, nullptr);
    locked = (*opened)->try_lock(AreaLock::Guard);
  }
  if (!locked) {
    return result::fail(kGuardedAlready, {(*opened)->path().string(), 0, 0},
                        "another guard watches this area");
  }
  return std::unique_ptr<OutputGuard>(new OutputGuard(std::move(*opened), matrix, options));
}

OutputGuard::OutputGuard(std::unique_ptr<IoArea> area, const scan::SafeMatrix& matrix,
                         const GuardOptions& options)
    : area_(std::move(area)),
      options_(options),
      outputs_(area_->header().output_bytes),
      memory_(outputs_.size()),
      safe_(matrix, memory_),
      looked_ns_(monotonic_ns()),
      awake_since_ns_(looked_ns_) {
  AreaHeader& header = area_->header();
  const ProcessMark self = ProcessMark::own();
  header.guard_heartbeat_ns.store(static_cast<std::uint64_t>(looked_ns_), std::memory_order_relaxed);
  header.guard_pid.store(self.pid, std::memory_order_relaxed);
  header.guard_space.store(self.space, std::memory_order_release);
}

OutputGuard::~OutputGuard() {
  forget_process();
}

const char* OutputGuard::turn(int stop) {
  pollfd entries[] = {{stop, POLLIN, 0}, {process_, POLLIN, 0}};  // a negative descriptor is passed over
  const timespec tick{0, options_.tick_ns};
  ppoll(entries, 2, &tick, nullptr);
  return look(monotonic_ns());
}

const char* OutputGuard::look(std::int64_t now_ns) {
  // Who was kept from looking, with the whole machine perhaps, says nothing about others before he has
  // watched them for as long as they have time.
  if (now_ns - looked_ns_ > options_.tick_ns + options_.timeout_ns / 2) awake_since_ns_ = now_ns;
  looked_ns_ = now_ns;
  area_->header().guard_heartbeat_ns.store(static_cast<std::uint64_t>(now_ns), std::memory_order_release);
  switch (state_) {
    case GuardState::Waiting:
      return wait_for_owner(now_ns);
    case GuardState::Watching:
    case GuardState::Helpless:
      return watch(now_ns);
    case GuardState::Driving:
      return drive(now_ns);
  }
  return nullptr;
}

const char* OutputGuard::wait_for_owner(std::int64_t now_ns) {
  AreaHeader& header = area_->header();
  const Owner owner = this->owner();
  if (owner == Owner::Nobody) return nullptr;
  if (owner == Owner::Released) {
    if (header.settled.load(std::memory_order_acquire) != 0) return nullptr;
    // It ended while a ramp was on its way.
    return begin_driving(cause_of(header), now_ns);
  }
  const bool expected = header.wanted_by.load(std::memory_order_acquire) != 0;
  if (expected && gave_way_ns_ == 0) gave_way_ns_ = now_ns;
  if (!area_->locked_elsewhere(AreaLock::Lease)) {
    if (expected && now_ns - gave_way_ns_ < kPatienceNs) return nullptr;
    // Nobody released the outputs, and nobody drives: killed before the guard began to watch.
    return begin_driving(scan::SafeCause::Killed, now_ns);
  }
  if (owner != Owner::Runtime) return nullptr;
  gave_way_ns_ = 0;
  generation_ = header.generation.load(std::memory_order_acquire);
  process_ = open_process(
      {header.owner_pid.load(std::memory_order_acquire), header.owner_space.load(std::memory_order_acquire)});
  // The same holder still: then the descriptor is that of his process and of no later one with its number.
  const bool same = area_->locked_elsewhere(AreaLock::Lease) &&
                    header.generation.load(std::memory_order_acquire) == generation_;
  if (!same) {
    forget_process();
    return nullptr;
  }
  state_ = GuardState::Watching;
  awake_since_ns_ = now_ns;
  return process_ >= 0 ? "watches a runtime"
                       : "watches a runtime of another PID namespace, by its lock and its heartbeat";
}

const char* OutputGuard::watch(std::int64_t now_ns) {
  AreaHeader& header = area_->header();
  // Of a process that it cannot see the kernel says by the lock that it is gone.
  const bool ended = process_ >= 0 ? process_ended(0) : !area_->locked_elsewhere(AreaLock::Lease);
  const bool same = header.generation.load(std::memory_order_acquire) == generation_;
  if (!same || owner() == Owner::Released) {
    forget_process();
    state_ = GuardState::Waiting;
    return same ? "the runtime ended in good order" : nullptr;
  }
  if (ended) {
    forget_process();
    return begin_driving(scan::SafeCause::Killed, now_ns);
  }
  const auto heard_ns = static_cast<std::int64_t>(header.heartbeat_ns.load(std::memory_order_acquire));
  const std::int64_t since_ns = heard_ns > awake_since_ns_ ? heard_ns : awake_since_ns_;
  if (now_ns - since_ns > options_.timeout_ns) return fence();
  state_ = GuardState::Watching;
  return nullptr;
}

// A runtime that is not heard of may wake up in the middle of a write: it must be gone first.
const char* OutputGuard::fence() {
  if (process_ < 0 || !kill_process(process_) || !process_ended(kFenceMs)) {
    const bool known = std::exchange(state_, GuardState::Helpless) == GuardState::Helpless;
    return known ? nullptr : "the runtime is not heard of and cannot be killed: its outputs stay as they are";
  }
  forget_process();
  return begin_driving(scan::SafeCause::Killed, monotonic_ns());
}

const char* OutputGuard::begin_driving(scan::SafeCause cause, std::int64_t now_ns) {
  // Whoever has the lease now came in between.
  state_ = GuardState::Waiting;
  if (!area_->try_lock(AreaLock::Lease)) return nullptr;
  AreaHeader& header = area_->header();
  SlotHeader slot{};
  if (area_->outputs().read(slot, outputs_)) safe_.driven(outputs_);
  generation_ = header.generation.load(std::memory_order_relaxed) + 1;
  const ProcessMark self = ProcessMark::own();
  header.owner_pid.store(self.pid, std::memory_order_relaxed);
  header.owner_space.store(self.space, std::memory_order_relaxed);
  header.cause.store(static_cast<std::uint32_t>(cause), std::memory_order_relaxed);
  header.settled.store(0, std::memory_order_relaxed);
  header.wanted_by.store(0, std::memory_order_relaxed);
  header.generation.store(generation_, std::memory_order_relaxed);
  header.owner.store(static_cast<std::uint32_t>(Owner::Guard), std::memory_order_release);
  gave_way_ns_ = 0;
  safe_.enter(cause, now_ns);
  state_ = GuardState::Driving;
  drive(now_ns);
  return cause == scan::SafeCause::Killed ? "the runtime was lost: the guard drives the outputs"
                                          : "the runtime ended: the guard brings its ramps to their ends";
}

const char* OutputGuard::drive(std::int64_t now_ns) {
  AreaHeader& header = area_->header();
  if (header.wanted_by.load(std::memory_order_acquire) != 0) {
    gave_way_ns_ = now_ns;
    state_ = GuardState::Waiting;
    area_->unlock(AreaLock::Lease);
    return "gives way to a runtime";
  }
  safe_.apply(now_ns, outputs_);
  area_->outputs().write({generation_, static_cast<std::uint64_t>(now_ns)}, outputs_);
  header.settled.store(safe_.settled() ? 1 : 0, std::memory_order_relaxed);
  header.heartbeat_ns.store(static_cast<std::uint64_t>(now_ns), std::memory_order_release);
  if (safe_.cause() == scan::SafeCause::Killed || !safe_.settled()) return nullptr;
  // What the runtime left to do is done.
  header.owner.store(static_cast<std::uint32_t>(Owner::Released), std::memory_order_release);
  state_ = GuardState::Waiting;
  area_->unlock(AreaLock::Lease);
  return "the outputs are where they stay";
}

bool OutputGuard::idle() const {
  const bool settled = area_->header().settled.load(std::memory_order_acquire) != 0;
  return state_ == GuardState::Waiting &&
         (owner() == Owner::Nobody || (owner() == Owner::Released && settled));
}

bool OutputGuard::process_ended(int timeout_ms) const {
  pollfd entry{process_, POLLIN, 0};
  return poll(&entry, 1, timeout_ms) == 1 && (entry.revents & POLLIN) != 0;
}

void OutputGuard::forget_process() {
  if (process_ >= 0) close(process_);
  process_ = -1;
}

}  // namespace stepwright::io_memory
