#pragma once

// A serial line with several units, as a test wants them: how long each takes to answer, and which do not
// answer at all. As on a real line nothing stops an answer that is late. Register A of unit U holds
// 1000 U + A; only function 3 is known.
//
//   LineOfUnits line;
//   line.answer_after(2, 80ms);
//   Master::create(SerialEndpoint{.device = line.device()}, ...)
//
// Threads: its own serves; every member may be called from any.

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <thread>

namespace stepwright::support {

class LineOfUnits {
 public:
  LineOfUnits();
  ~LineOfUnits();
  LineOfUnits(const LineOfUnits&) = delete;
  LineOfUnits& operator=(const LineOfUnits&) = delete;

  const std::string& device() const { return device_; }
  int requests_of(std::uint8_t unit) const { return requests_[unit]; }

  void answer_after(std::uint8_t unit, std::chrono::milliseconds time) {
    delay_ms_[unit] = static_cast<int>(time.count());
  }
  void silence(std::uint8_t unit, bool silent) { silent_[unit] = silent; }
  // The unit's answers are kept until they are released, or until `other` is asked: then they come right
  // before its own.
  void keep(std::uint8_t unit, std::uint8_t other = 0) {
    before_[unit] = other;
    keep_[unit] = true;
  }
  // They are on the line when it returns; later ones are not kept.
  void release(std::uint8_t unit);
  // The adapter of the master repeats to it what it sends.
  void echo() { echo_ = true; }

 private:
  void serve();

  int ours_ = -1;
  int theirs_ = -1;  // kept open, so that a master may come and go
  std::string device_;
  std::array<std::atomic<int>, 256> delay_ms_{};
  std::array<std::atomic<int>, 256> requests_{};
  std::array<std::atomic<bool>, 256> silent_{};
  std::array<std::atomic<bool>, 256> keep_{};
  std::array<std::atomic<std::uint8_t>, 256> before_{};
  std::atomic<int> released_{-1};  // a unit whose kept answers are to be sent
  std::atomic<bool> echo_{false};
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace stepwright::support
