#pragma once

// The poller of one connection: a thread that reads and writes all units behind one host and port, or on one
// serial line, which take turns there. What it waits for holds up no other connection.
//
// The schedule says who is asked next. A connection is made anew when it is lost, when every unit of it is
// silent, or two of them are in a row (half-open: nothing comes and nothing says so); never twice within 20
// ms. The loss of one that has carried answers says nothing about its units: the request is repeated on the
// next one.
//
// Threads: its own; set_outputs, written and cache() from any.

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <thread>
#include <vector>

#include "runtime/modbus/client/poll/poll_schedule.h"
#include "runtime/modbus/client/poll/tag_cache.h"
#include "runtime/modbus/client/poll/unit.h"
#include "runtime/modbus/client/settings.h"
#include "runtime/modbus/master/master.h"

namespace stepwright::modbus::client {

class ConnectionWorker {
 public:
  using Clock = std::chrono::steady_clock;

  // All devices have one endpoint, which the master has, too.
  ConnectionWorker(std::vector<Device> devices, master::Master master, const ClientSettings& settings);
  // Ends within the timeout of a request.
  ~ConnectionWorker();
  ConnectionWorker(const ConnectionWorker&) = delete;
  ConnectionWorker& operator=(const ConnectionWorker&) = delete;

  TagCache& cache() { return cache_; }
  const TagCache& cache() const { return cache_; }

  // The output area as it is to be.
  void set_outputs(std::span<const std::byte> area);
  // Every unit that answers has acknowledged what was set last.
  bool written() const { return written_; }

 private:
  void run();
  void wait_until(Clock::time_point at);
  void take_outputs();
  bool connect();
  bool used_up() const;
  // The connection was lost in a request, which comes again on another one.
  bool repeats(const master::Outcome& outcome) const;
  void read_group(std::size_t unit, GroupPoll& group);
  void write_next(std::size_t unit);
  void probe(std::size_t unit);
  master::Outcome send(Unit& unit, const WriteRequest& request);
  master::Outcome read(Unit& unit, const ReadRequest& request);
  // Counts, and does what the outcome asks of unit and connection. False if the unit's turn is over.
  bool judge(std::size_t unit, const master::Outcome& outcome, Clock::time_point sent, bool write);
  void on_silence(std::size_t unit, const std::string& error, Clock::time_point sent, Clock::time_point now);
  void on_lost(const std::string& error, Clock::time_point now);

  TagCache cache_;
  master::Master master_;
  ClientSettings settings_;
  PollSchedule schedule_;
  std::vector<std::uint16_t> words_;
  std::vector<std::uint8_t> bits_;

  std::uint32_t most_requests_ = 0;  // of a connection; 0: any number
  std::chrono::milliseconds between_{0};
  std::uint32_t requests_ = 0;  // of this one
  bool answered_ = false;       // this one has carried an answer
  bool goes_on_ = false;        // the next one goes on where this one ends
  Clock::time_point connect_at_{};
  std::chrono::milliseconds pause_{0};  // before the next attempt but one

  std::mutex mutex_;  // of what follows
  std::condition_variable news_;
  std::vector<std::byte> outputs_;
  bool new_outputs_ = false;
  bool stop_ = false;
  std::atomic<bool> written_{true};
  std::thread thread_;
};

}  // namespace stepwright::modbus::client
