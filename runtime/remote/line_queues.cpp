#include "runtime/remote/line_queues.h"

#include <utility>

namespace stepwright::remote {
namespace {

constexpr std::size_t kMaxUnderWay = 200;
// What goes ahead of the others has some room of its own.
constexpr std::size_t kMaxUrgentUnderWay = 250;
constexpr std::size_t kMaxEvents = 256;

template <typename T>
std::optional<T> pop(std::deque<T>& queue) {
  if (queue.empty()) return std::nullopt;
  std::optional<T> front(std::move(queue.front()));
  queue.pop_front();
  return front;
}

}  // namespace

bool LineQueues::submit(RemoteCommand command) {
  {
    const std::lock_guard lock(mutex_);
    const bool ahead = host::goes_ahead(command.command.kind);
    if (under_way_ >= (ahead ? kMaxUrgentUnderWay : kMaxUnderWay)) return false;
    ++under_way_;
    command.command.order = ++last_order_;
    (ahead ? urgent_ : commands_).push_back(std::move(command));
  }
  wake_.notify();
  return true;
}

std::optional<host::Completion> LineQueues::take_completion() {
  const std::lock_guard lock(mutex_);
  auto completion = pop(completions_);
  if (completion) --under_way_;
  return completion;
}

std::optional<host::StepEvent> LineQueues::take_event() {
  const std::lock_guard lock(mutex_);
  const bool was_full = events_.size() >= kMaxEvents;
  auto event = pop(events_);
  if (was_full) wake_.notify();  // the clock may have stood still for want of room
  return event;
}

RemoteFigures LineQueues::figures() const {
  const std::lock_guard lock(mutex_);
  return figures_;
}

std::optional<RemoteCommand> LineQueues::next_command() {
  const std::lock_guard lock(mutex_);
  return pop(urgent_.empty() ? commands_ : urgent_);
}

std::optional<RemoteCommand> LineQueues::next_urgent() {
  const std::lock_guard lock(mutex_);
  return pop(urgent_);
}

void LineQueues::complete(host::Completion completion) {
  {
    const std::lock_guard lock(mutex_);
    completions_.push_back(std::move(completion));
  }
  news_.notify();
}

bool LineQueues::add(host::StepEvent event) {
  {
    const std::lock_guard lock(mutex_);
    if (events_.size() >= kMaxEvents) return false;
    events_.push_back(std::move(event));
  }
  news_.notify();
  return true;
}

bool LineQueues::full() const {
  const std::lock_guard lock(mutex_);
  return events_.size() >= kMaxEvents;
}

void LineQueues::publish(RemoteFigures figures) {
  const std::lock_guard lock(mutex_);
  figures_ = std::move(figures);
}

}  // namespace stepwright::remote
