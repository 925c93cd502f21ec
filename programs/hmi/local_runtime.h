#pragma once

// Watch for a runtime of the cell that listens on this machine although nobody carries it here: its link does
// not run.
//
//   LocalRuntime local(config.socket_path());
//   if (!alive) seen.unlinked = local.is_there(now);      // asked often
//
// Threads: one. The socket is looked at and not opened: a runtime counts those that come.

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

namespace stepwright::hmi {

class LocalRuntime {
 public:
  using Time = std::chrono::steady_clock::time_point;

  explicit LocalRuntime(const std::filesystem::path& socket);

  // It has listened for some seconds: a link that is about to be there has had time.
  bool is_there(Time now);
  // It has been heard: the time begins anew.
  void heard() { since_.reset(); }

 private:
  std::string socket_;
  std::optional<Time> since_;  // it listens
  Time next_look_{};
};

// Whether somebody listens at this path, by the text of /proc/net/unix.
bool listens_at(const std::string& socket, const std::string& table);

}  // namespace stepwright::hmi
