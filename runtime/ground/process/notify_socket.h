#pragma once

// Messages to the init system that started the process: the datagram protocol of sd_notify(3), spoken
// directly so that no library comes into the process for a few bytes. Without NOTIFY_SOCKET in the
// environment nothing happens.
//
//   NotifySocket init;
//   init.ready("listens on /run/bench.sock");
//   if (alive) init.watchdog();                  // more often than watchdog_interval()
//   init.stopping();
//
// Threads: one. Nothing blocks and nothing fails: what an init system that is busy does not take is kept and
// comes with the next message; one that does not listen has its own timeouts.

#include <chrono>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

namespace stepwright::process {

class NotifySocket {
 public:
  // Reads NOTIFY_SOCKET, WATCHDOG_USEC and WATCHDOG_PID.
  NotifySocket();
  ~NotifySocket();
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;

  bool present() const { return descriptor_ >= 0; }
  // After this time without a sign of life this process is killed and started again; none: nobody watches.
  std::optional<std::chrono::microseconds> watchdog_interval() const { return watchdog_; }

  // The first sign of life, too, where somebody watches for them.
  void ready(std::string_view status);
  // Followed by ready().
  void reloading();
  void stopping();
  void status(std::string_view text);
  void watchdog();
  // Tries again what was not taken.
  void flush();

 private:
  void send(std::string text);
  bool sent(const std::string& text) const;

  int descriptor_ = -1;
  std::string address_;  // as the system wants it: '\0' in front of an abstract name
  std::optional<std::chrono::microseconds> watchdog_;
  std::deque<std::string> kept_;  // in the order in which it is to be told
};

// Feeds the watchdog from a loop that may turn as often as it likes.
class Heartbeat {
 public:
  explicit Heartbeat(NotifySocket& init) : init_(init) {}
  // Call it at least four times in the interval, and only while all is well.
  void turn();

 private:
  NotifySocket& init_;
  std::chrono::steady_clock::time_point due_{};
};

}  // namespace stepwright::process
