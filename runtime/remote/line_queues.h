#pragma once

// Queues between the service's thread and the line's thread of a gateway: commands, completions, events and
// the newest figures.
//
// Threads: functions under "Service" and "Line" belong to those threads. A mutex guards all: none of it is on
// a scan's path. Invariant: who sees a completion or an event finds figures that are at least as new.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "runtime/host/command.h"
#include "runtime/host/messages.h"
#include "runtime/host/notifier.h"
#include "runtime/image/force_table.h"
#include "runtime/remote/remote_program.h"

namespace stepwright::remote {

struct RemoteCommand {
  host::Command command;
  std::shared_ptr<const RemoteProgram> program;  // CommandKind::Load
};

// Figures of the controller and the line, published by the line's thread.
struct RemoteFigures {
  host::RuntimeStatus status;
  std::shared_ptr<const RemoteProgram> program;
  std::vector<image::Force> forces;  // of that program, with the time that each has left
  bool contact = false;              // the line carries answers
  std::string line_problem;          // why it does not
  std::uint64_t repeated = 0;        // requests that had to be sent again
  std::uint64_t losses = 0;          // how often the controller was lost
};

class LineQueues {
 public:
  // Service.
  // False if too many are under way. What goes ahead (host::goes_ahead) has room of its own.
  bool submit(RemoteCommand command);
  std::optional<host::Completion> take_completion();
  std::optional<host::StepEvent> take_event();
  RemoteFigures figures() const;
  host::Notifier& news() { return news_; }

  // Line.
  // Commands that go ahead come first.
  std::optional<RemoteCommand> next_command();
  // Only what goes ahead: between the parts of something long.
  std::optional<RemoteCommand> next_urgent();
  void complete(host::Completion completion);
  // An event more than there is room for is lost; false then. A line in lock-step asks first.
  bool add(host::StepEvent event);
  bool full() const;
  void publish(RemoteFigures figures);
  host::Notifier& wake() { return wake_; }

  bool ok() const { return wake_.ok() && news_.ok(); }

 private:
  mutable std::mutex mutex_;
  std::deque<RemoteCommand> commands_;
  std::deque<RemoteCommand> urgent_;
  std::deque<host::Completion> completions_;
  std::deque<host::StepEvent> events_;
  std::uint64_t last_order_ = 0;
  std::size_t under_way_ = 0;
  RemoteFigures figures_;
  host::Notifier wake_;
  host::Notifier news_;
};

}  // namespace stepwright::remote
