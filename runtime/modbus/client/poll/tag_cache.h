#pragma once

// Cache of the newest values of one connection's devices: the poller's thread writes it, the exchange with
// the image reads it. It decides the quality of a value: good, uncertain until loss_after has passed without
// news, then bad and replaced by its value on loss.
//
// Threads: any; one lock, held for a copy. Invariant: the values of one request become visible together.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "runtime/modbus/client/poll/read_plan.h"
#include "runtime/modbus/client/poll/status.h"
#include "runtime/modbus/client/settings.h"

namespace stepwright::modbus::client {

class TagCache {
 public:
  using Clock = std::chrono::steady_clock;

  TagCache(std::vector<Device> devices, Clock::time_point start);

  const std::vector<Device>& devices() const { return devices_; }
  // The inputs of a device, in the order of its groups: what the indices below count.
  std::span<const Tag> inputs(std::size_t device) const { return states_[device].inputs; }

  // The poller's. `words` are those of the request, bits as 0 and 1.
  void read(std::size_t device, const ReadRequest& request, std::span<const std::uint16_t> words,
            Clock::time_point now);
  void not_read(std::size_t device, std::span<const std::uint32_t> inputs, Quality why,
                const std::string& error);
  void written(std::size_t device, std::span<const std::uint32_t> outputs,
               std::span<const std::uint8_t> exceeded, Clock::time_point now);
  void not_written(std::size_t device, std::span<const std::uint32_t> outputs, Quality why,
                   const std::string& error, Clock::time_point now);
  void outputs_are(std::span<const std::byte> area);
  // It answers, or can be reached where there is nothing to ask.
  void online(std::size_t device, Clock::time_point now);
  // Nothing of it can be had.
  void offline(std::size_t device, Quality why, const std::string& error, Clock::time_point now);
  // Figures, under the lock.
  void count(std::size_t device,
             const std::function<void(DeviceCounters&, std::vector<GroupStatus>&)>& change);

  // The exchange's. Writes the inputs of all devices, their qualities and ages.
  void collect(Clock::time_point now, std::span<std::byte> inputs) const;
  // A device without which the program may not drive is lost, or was never there.
  bool lost(Clock::time_point now) const;
  void report(Clock::time_point now, std::vector<DeviceStatus>& status) const;
  // Who came and went since the last call.
  std::vector<DeviceNews> take_news();

 private:
  struct State {
    std::uint64_t bits = 0;
    bool ever = false;
    bool exceeded = false;
    Quality fault = Quality::NotConnected;  // Good: the newest attempt went well
    Clock::time_point good_at{};            // or when we began
    Clock::time_point fault_since{};        // outputs: since when they are not as they should be
    std::chrono::system_clock::time_point wall{};
  };
  struct DeviceState {
    std::vector<Tag> inputs;
    std::vector<std::chrono::milliseconds> limits;  // of the age of each
    std::vector<Tag> outputs;
    std::vector<State> in;
    std::vector<State> out;
    bool online = false;
    Clock::time_point offline_since{};
    std::string error;
    DeviceCounters counters;
    std::vector<GroupStatus> groups;
  };

  static Quality quality_of(const State& state, bool too_old);
  static bool too_old(const DeviceState& device, std::size_t input, Clock::time_point now);
  bool lost(std::size_t device, Clock::time_point now) const;

  std::vector<Device> devices_;
  mutable std::mutex mutex_;
  std::vector<DeviceState> states_;
  std::vector<DeviceNews> news_;
};

}  // namespace stepwright::modbus::client
