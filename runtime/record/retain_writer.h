#pragma once

// The thread that writes retained values to their store, so that no scan ever waits for a disk. The scan
// thread leaves a copy in the buffer of a channel; the writer takes the newest one and acknowledges its
// number when the disk has it. What cannot be written is tried again until it can; the runtime goes on
// meanwhile.
//
// Threads: `add` and `note` any; `use` and `notify` the scan thread: no heap, no lock (`notify` is one system
// call, for stops, not for scans). Invariant: `committed` never names what a crash could lose.
//
//   writer.add(channel);                              // when its program is loaded
//   writer.use(*channel);                             // when it starts
//   channel->buffer.publish(number);                  // in a scan
//   if (writer.committed() >= number) ...             // it is there for good

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "runtime/record/retain_store.h"
#include "runtime/record/retained_values.h"

namespace stepwright::record {

class RetainWriter {
 public:
  // `found` is what the store holds, if it holds anything. Starts the thread.
  RetainWriter(std::filesystem::path path, std::chrono::nanoseconds period, std::optional<StoredState> found);
  // Writes what is still to be written, once, and joins the thread.
  ~RetainWriter();
  RetainWriter(const RetainWriter&) = delete;
  RetainWriter& operator=(const RetainWriter&) = delete;

  // The writer shares the channel with its program: either may end first.
  void add(std::shared_ptr<RetainChannel> channel);
  // From now on this channel's values are the retained ones. Requires an added channel whose program lives.
  void use(RetainChannel& channel) { current_.store(&channel, std::memory_order_release); }
  // Has it look now and not at the end of its period.
  void notify() const;

  // The newest number that the disk has.
  std::uint64_t committed() const { return committed_.load(std::memory_order_acquire); }
  // Why values are not written; empty if they are.
  std::string note() const;

 private:
  void run();
  void turn();
  bool save(RetainChannel& channel);
  std::shared_ptr<RetainChannel> current();
  void set_note(std::string note);

  const std::filesystem::path path_;
  const std::chrono::nanoseconds period_;
  int event_ = -1;
  std::atomic<RetainChannel*> current_{nullptr};
  std::atomic<std::uint64_t> committed_{0};
  std::atomic<bool> quit_{false};

  mutable std::mutex mutex_;  // of the two below; never taken in a scan
  std::vector<std::shared_ptr<RetainChannel>> channels_;
  std::string note_;

  // The rest belongs to the thread.
  std::shared_ptr<RetainChannel> writing_;
  bool unwritten_ = false;  // the front of its buffer is not in the store yet
  std::optional<StoredState> found_;
  std::optional<RetainStore> store_;
  std::vector<std::byte> written_;  // the newest values of the store
  std::uint64_t sequence_ = 0;      // of them
  std::thread thread_;
};

}  // namespace stepwright::record
