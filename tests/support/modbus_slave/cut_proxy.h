#pragma once

// A TCP proxy of a test that cuts connections as networks do: with a reset, or half open, where nothing comes
// any more and nobody says so. New connections work at once.
//
// Threads: its own carries; every member may be called from any.

#include <atomic>
#include <cstdint>
#include <list>
#include <mutex>
#include <thread>

namespace stepwright::support {

class CutProxy {
 public:
  // Carries between a free port of the loopback and `target`.
  explicit CutProxy(std::uint16_t target);
  ~CutProxy();
  CutProxy(const CutProxy&) = delete;
  CutProxy& operator=(const CutProxy&) = delete;

  std::uint16_t port() const { return port_; }
  int connections() const { return accepted_; }
  // All connections that there are, with a reset.
  void reset();
  // The same half open: they stay, and carry nothing.
  void freeze();

 private:
  struct Pair {
    int client = -1;
    int server = -1;
    bool frozen = false;
  };
  void carry();
  void accept_one();
  static bool move(int from, int to);
  static void close_with_reset(const Pair& pair);

  std::uint16_t target_;
  std::uint16_t port_ = 0;
  int listener_ = -1;
  std::mutex mutex_;
  std::list<Pair> pairs_;
  std::atomic<int> accepted_{0};
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace stepwright::support
