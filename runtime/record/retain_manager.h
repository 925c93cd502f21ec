#pragma once

// Manages retained values: from the store into the program that starts, from a program into the one that
// follows it, and into the store while it runs. A warm start has them, a cold start has initial values (IEC
// 61131-3, 6.5.6.2).
//
// Threads: `open` and `prepare` on the service thread, `note` and `committed` on any, the rest on the scan
// thread. A scan calls only `offer`: nothing until the period is over, then a copy and one atomic exchange;
// no heap, no lock, no system call. `prepare` works out how to copy the values of every program and store
// that may precede the prepared one, so that a start only copies and its time does not grow with the names.
// The other functions take memory only to report values that do not fit.
//
//   auto retain = RetainManager::open({.store = state_dir / "retain.store"});
//   auto channel = retain->prepare(program);                   // loaded
//   if (auto problems = retain->refusal(**channel, cold); !problems.empty()) ...
//   cycle.start(...); retain->begin(**channel, image, cold);   // started
//   retain->offer(image, now_ns);                              // after each scan
//   retain->finish(image);                                     // stopped, trapped, at the end

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/record/retain_store.h"
#include "runtime/record/retain_writer.h"

namespace stepwright::record {

// Policy for retained values that do not fit the program: names or types differ.
enum class RetainPolicy : std::uint8_t {
  Carry,       // what has its name and type keeps its value
  Initialise,  // all of them have initial values
  Refuse,      // the program is not started, but cold
};

struct RetainConfig {
  std::filesystem::path store;           // empty: values outlive programs, but not the process
  std::int64_t period_ns = 100'000'000;  // they are written at most this often
  RetainPolicy policy = RetainPolicy::Carry;
};

class RetainManager {
 public:
  // Reads the store. A damaged store is moved aside and reported by `note`: it never keeps a runtime from
  // starting.
  static std::unique_ptr<RetainManager> open(const RetainConfig& config);

  // Of a verified program, which is to start behind all that were prepared before. Fails with R0021.
  [[nodiscard]] result::Result<std::shared_ptr<RetainChannel>> prepare(const bytecode::Program& program);

  // Why the program may not start (R0025), under the policy Refuse; nothing if it may.
  result::Diagnostics refusal(const RetainChannel& channel, bool cold) const;
  // The image has its initial values; retained variables get theirs unless the start is a cold one.
  void begin(RetainChannel& channel, std::span<std::byte> image, bool cold);
  void offer(std::span<const std::byte> image, std::int64_t now_ns) {
    if (current_ == nullptr || now_ns < due_ns_) return;
    due_ns_ = now_ns + period_ns_;
    publish(image);
  }
  void finish(std::span<const std::byte> image);
  // Another program goes on with this image between two scans: what it retains is kept from now on. As cheap
  // as `offer`.
  void change(RetainChannel& channel, std::span<const std::byte> image);

  // Number of the newest values that were handed to the writer, and of the newest that the disk has.
  std::uint64_t published() const { return number_; }
  std::uint64_t committed() const { return writer_ == nullptr ? 0 : writer_->committed(); }
  // Message for the user: a store that was refused, values that did not fit, writes that fail.
  std::string note() const;

 private:
  explicit RetainManager(const RetainConfig& config);
  void publish(std::span<const std::byte> image);
  RetainArrival arrival(std::uint64_t source, const StateLayout& from, const RetainChannel& to) const;
  void forget_unused();
  void restore(const RetainChannel& channel, std::uint64_t source, std::span<std::byte> image);
  // Source of the values that are kept at present, as arrivals name it; none: there are none.
  std::optional<std::uint64_t> kept_source() const;
  const StateLayout& kept_layout() const;
  std::span<const std::byte> kept_payload() const;
  void set_note(std::string note);

  const RetainConfig config_;
  const std::int64_t period_ns_;
  std::shared_ptr<const StoredState> found_;  // what the store held at the beginning; null: nothing
  std::atomic<bool> begun_{false};            // a program has taken that over

  // The service thread's: all programs whose values may be kept, so that the last one to let go is this
  // thread.
  std::vector<std::shared_ptr<RetainChannel>> channels_;
  std::uint64_t sources_ = 0;

  std::shared_ptr<RetainChannel> kept_from_;  // the program whose values are kept, behind that
  RetainChannel* current_ = nullptr;          // it runs
  std::int64_t due_ns_ = 0;
  std::uint64_t number_ = 0;
  mutable std::mutex mutex_;  // of the note; never taken in a scan
  std::string note_;
  std::atomic<bool> noted_{false};        // there is one
  std::unique_ptr<RetainWriter> writer_;  // null without a store
};

}  // namespace stepwright::record
