#pragma once

// The init system's end of the protocol that NotifySocket speaks: who starts processes learns from them when
// they are ready.
//
//   auto listener = NotifyListener::open();
//   auto child = ChildProcess::start({.arguments = ..., .environment = {listener->variable()}});
//   for (const Notice& notice : listener->take())
//     if (notice.sender == child->pid() && notice.ready) ...
//
// Threads: one. Nothing blocks. The system says who has sent a notice: what others send is theirs.

#include <sys/types.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/ground/result/result.h"

namespace stepwright::process {

struct Notice {
  pid_t sender = 0;
  bool ready = false;
  bool alive = false;                      // a sign of life for who watches over it
  std::optional<std::string> status = {};  // what it is at, in one line
};

class NotifyListener {
 public:
  // Fails with M0014 if the system gives no socket.
  [[nodiscard]] static result::Result<NotifyListener> open();
  ~NotifyListener();
  NotifyListener(NotifyListener&& other) noexcept
      : descriptor_(std::exchange(other.descriptor_, -1)), name_(std::move(other.name_)) {}
  NotifyListener& operator=(NotifyListener&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    std::swap(name_, other.name_);
    return *this;
  }

  // "NOTIFY_SOCKET=..." for the environment of a process.
  std::string variable() const { return "NOTIFY_SOCKET=" + name_; }
  // Readable when there is something to take.
  int descriptor() const { return descriptor_; }
  // All that has come.
  std::vector<Notice> take();

 private:
  NotifyListener(int descriptor, std::string name) : descriptor_(descriptor), name_(std::move(name)) {}
  int descriptor_ = -1;
  std::string name_;  // '@' and the name of an abstract address, which no path is too long for
};

}  // namespace stepwright::process
