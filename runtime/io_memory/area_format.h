#pragma once

// The shared-memory I/O area as it lies in memory (runtime/doc/shared_memory_io.md, version 1): a header,
// then the inputs, which the plant writes, and the outputs, which whoever holds the lease writes. Everything
// is little-endian; instants are CLOCK_MONOTONIC in nanoseconds.
//
// Threads and processes: every field that changes is an atomic with one writer, named beside it.

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace stepwright::io_memory {

inline constexpr std::uint64_t kAreaMagic = 0x314D'454D'4F49'5753;  // "SWIOMEM1"
inline constexpr std::uint32_t kAreaVersion = 1;
inline constexpr std::uint32_t kMaxAreaBytes = 65'536;  // of inputs or outputs

// The process that drives the outputs. It holds the lease, a lock that the kernel releases when the process
// ends.
enum class Owner : std::uint32_t {
  Nobody = 0,    // never driven
  Runtime = 1,   // a program, or the safe state of a runtime that lives
  Guard = 2,     // the runtime was lost
  Released = 3,  // nobody any more; the runtime ended in good order
};

struct AreaHeader {
  // Written once, by whoever made the area.
  std::uint64_t magic;
  std::uint32_t version;
  std::uint32_t input_bytes;
  std::uint32_t output_bytes;
  std::uint32_t inputs_at;   // offset of the block of the inputs
  std::uint32_t outputs_at;  // of the outputs
  std::uint32_t reserved[9];

  // The holder of the lease.
  alignas(64) std::atomic<std::uint64_t> generation;  // one more with every new holder
  std::atomic<std::uint64_t> heartbeat_ns;            // he is alive
  std::atomic<std::uint32_t> owner;                   // Owner
  std::atomic<std::uint32_t> owner_pid;
  std::atomic<std::uint32_t> cause;    // scan::SafeCause that the outputs stand for, unless a program drives
  std::atomic<std::uint32_t> settled;  // 1: no ramp is on its way
  std::atomic<std::uint64_t> owner_space;  // PID namespace of owner_pid (its inode); 0: not said

  // The plant.
  alignas(64) std::atomic<std::uint64_t> plant_heartbeat_ns;
  std::atomic<std::uint64_t> plant_timeout_ns;  // how old its heartbeat may be; 0: it announces none

  // A runtime that wants the lease: its process, 0 if none does.
  alignas(64) std::atomic<std::uint32_t> wanted_by;

  // The guard, while it holds its lock.
  std::atomic<std::uint32_t> guard_pid;
  std::atomic<std::uint64_t> guard_space;
  std::atomic<std::uint64_t> guard_heartbeat_ns;
};
static_assert(sizeof(AreaHeader) == 256 && std::atomic<std::uint64_t>::is_always_lock_free);

// Bytes of the file that are locked (F_OFD_SETLK); there need be nothing behind them.
enum class AreaLock : std::uint8_t {
  Making = 0,  // the header is being written
  Lease = 1,   // the outputs are driven
  Guard = 2,   // a guard watches
  Plant = 3,   // a plant is attached
  Use = 4,     // shared by all who have it open: it keeps its sizes
};

// Block: two slots that are written in turn, so that the newest is whole whenever a writer is killed.
struct BlockHeader {
  std::atomic<std::uint64_t> count;  // complete writes; the newest is in slot count % 2
};
struct SlotHeader {
  std::uint64_t generation;  // of the writer's lease; of inputs: 0
  std::uint64_t time_ns;     // when it was written
};

constexpr std::uint32_t padded(std::uint32_t bytes) {
  return (bytes + 7u) / 8u * 8u;
}
constexpr std::uint32_t slot_bytes(std::uint32_t bytes) {
  return static_cast<std::uint32_t>(sizeof(SlotHeader)) + padded(bytes);
}
constexpr std::uint32_t kBlockHeaderBytes = 64;  // a cache line of its own
constexpr std::uint32_t block_bytes(std::uint32_t bytes) {
  return (kBlockHeaderBytes + 2 * slot_bytes(bytes) + 63u) / 64u * 64u;
}

}  // namespace stepwright::io_memory
