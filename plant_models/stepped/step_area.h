#pragma once

// The shared memory through which a plant in a process of its own is stepped, as it lies in memory
// (plant_models/doc/shared_plant.md, version 1): a header, the names of all terminals, and a block of numbers
// for each kind of them. The runtime makes it as a file without a name (memfd) that nobody can make smaller
// or larger, so that no access to it can fail, whatever the plant does.
//
// Threads and processes: the socket between both orders all accesses; what the plant writes is untrusted, so
// each number of it is read once.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"

namespace stepwright::stepped {

inline constexpr std::uint64_t kStepMagic = 0x3154'4E41'4C50'5753;  // "SWPLANT1"
inline constexpr std::uint32_t kStepVersion = 1;
inline constexpr std::size_t kMaxTerminals = 4096;  // of one kind
inline constexpr std::size_t kMessageBytes = 256;
// What a process that is started as a plant finds open.
inline constexpr int kPeerSocket = 3;
inline constexpr int kPeerArea = 4;
inline constexpr char kStepByte = 's';   // "a step is asked for", on the socket
inline constexpr char kReadyByte = 'r';  // "the step is done", and before the first: "ready"

// Where a block is, and how much of it there is.
struct BlockPlace {
  std::uint32_t count;  // numbers, or bytes of the names
  std::uint32_t at;     // offset from the beginning of the area
};

enum class PeerStatus : std::uint32_t { Good = 0, Failed = 1 };

struct StepHeader {
  // Written once, by the runtime.
  std::uint64_t magic;       // 0
  std::uint32_t version;     // 8
  std::uint32_t area_bytes;  // 12
  BlockPlace actuators;      // 16
  BlockPlace sensors;        // 24
  BlockPlace values;         // 32
  BlockPlace faults;         // 40
  BlockPlace names;          // 48
  std::uint64_t seed;        // 56: of all that the plant draws by lot

  // The runtime, before each step.
  alignas(64) std::atomic<std::uint64_t> step;  // 64: steps that were asked for
  std::atomic<std::int64_t> time_ns;            // 72: simulated time at the end of the step
  std::atomic<std::int64_t> step_ns;            // 80: its length

  // The plant.
  alignas(64) std::atomic<std::uint32_t> peer_version;  // 128: of the protocol that it speaks
  std::atomic<std::uint32_t> status;                    // 132: PeerStatus
  std::atomic<std::uint64_t> done;                      // 136: steps that are done
  char message[kMessageBytes];                          // 144: what has failed: UTF-8, ended by a zero
};
static_assert(sizeof(StepHeader) == 448 && offsetof(StepHeader, step) == 64 &&
              offsetof(StepHeader, peer_version) == 128 && offsetof(StepHeader, message) == 144);

// Names of all that the area has, in the order of its blocks.
struct StepNames {
  std::vector<std::string> actuators;
  std::vector<std::string> sensors;
  std::vector<std::string> values;
  std::vector<std::string> faults;
};

// One mapped area. Move-only.
class StepArea {
 public:
  // The runtime's side: requires at most kMaxTerminals names of a kind, without control characters. Fails
  // with R0151 if the system gives no memory.
  [[nodiscard]] static result::Result<StepArea> make(const StepNames& names, std::uint64_t seed);
  // The plant's side: the area of an open descriptor, which stays open. Fails with R0152: it is no area of
  // this version, or smaller than its header says.
  [[nodiscard]] static result::Result<StepArea> attach(int descriptor);
  ~StepArea();
  StepArea(StepArea&& other) noexcept;
  StepArea& operator=(StepArea&& other) noexcept;

  StepHeader& header() const { return *reinterpret_cast<StepHeader*>(memory_); }
  int descriptor() const { return descriptor_; }  // of make(); -1 after attach()

  // Where the blocks were when the area was opened, whatever its header says now.
  std::size_t actuators() const { return actuators_.count; }
  std::size_t sensors() const { return sensors_.count; }
  std::size_t values() const { return values_.count; }
  std::size_t faults() const { return faults_.count; }
  double actuator(std::size_t index) const { return load(actuators_, index); }
  double sensor(std::size_t index) const { return load(sensors_, index); }
  double value(std::size_t index) const { return load(values_, index); }
  double fault(std::size_t index) const { return load(faults_, index); }
  void set_actuator(std::size_t index, double number) const { store(actuators_, index, number); }
  void set_sensor(std::size_t index, double number) const { store(sensors_, index, number); }
  void set_value(std::size_t index, double number) const { store(values_, index, number); }
  void set_fault(std::size_t index, double number) const { store(faults_, index, number); }

  StepNames names() const;
  // What the plant has written there: printable, without an end that it does not have.
  std::string message() const;
  void set_message(std::string_view text) const;

 private:
  StepArea(int descriptor, std::byte* memory, std::size_t bytes);
  double load(BlockPlace place, std::size_t index) const;
  void store(BlockPlace place, std::size_t index, double number) const;

  int descriptor_ = -1;
  std::byte* memory_ = nullptr;
  std::size_t bytes_ = 0;
  BlockPlace actuators_{};
  BlockPlace sensors_{};
  BlockPlace values_{};
  BlockPlace faults_{};
  BlockPlace names_{};
};

}  // namespace stepwright::stepped
