#include "runtime/ground/log/line_writer.h"

#include <pthread.h>
#include <signal.h>

#include <condition_variable>
#include <deque>
#include <mutex>
#include <system_error>
#include <utility>

namespace stepwright::log {
namespace {

using Target = std::shared_ptr<const LineTarget>;

// Signals belong to the threads that wait for them.
class SignalsHeldBack {
 public:
  SignalsHeldBack() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~SignalsHeldBack() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsHeldBack(const SignalsHeldBack&) = delete;
  SignalsHeldBack& operator=(const SignalsHeldBack&) = delete;

 private:
  sigset_t before_{};
};

}  // namespace

struct LineWriter::State {
  struct Line {
    Target target;
    std::string text;
  };

  void run();
  bool all_written() const { return lines.empty() && !writing; }

  std::mutex mutex;
  std::condition_variable wanted;
  std::condition_variable written;
  Target target;
  std::deque<Line> lines;
  std::size_t bytes = 0;
  std::uint64_t lost = 0;
  bool writing = false;
  bool behind = false;  // nobody waits before everything is written
  bool quit = false;
};

void LineWriter::State::run() {
  std::unique_lock lock(mutex);
  while (true) {
    wanted.wait(lock, [this] { return quit || !lines.empty(); });
    if (lines.empty()) return;
    const Line line = std::move(lines.front());
    lines.pop_front();
    bytes -= line.text.size();
    writing = true;
    lock.unlock();
    line.target->write(line.text);
    lock.lock();
    writing = false;
    if (!all_written()) continue;
    behind = false;
    written.notify_all();
  }
}

LineWriter::LineWriter() : state_(std::make_shared<State>()) {
  const SignalsHeldBack held;
  try {
    thread_ = std::thread([state = state_] { state->run(); });
  } catch (const std::system_error&) {
    // Then whoever logs waits.
  }
}

LineWriter::~LineWriter() {
  if (!thread_.joinable()) return;
  bool done = false;
  {
    std::unique_lock lock(state_->mutex);
    state_->quit = true;
    state_->wanted.notify_one();
    done = state_->written.wait_for(lock, kLastPatience, [this] { return state_->all_written(); });
  }
  // A thread that does not come back must not keep the process.
  done ? thread_.join() : thread_.detach();
}

void LineWriter::set_target(LineTarget target) {
  auto next = std::make_shared<const LineTarget>(std::move(target));
  const std::lock_guard lock(state_->mutex);
  state_->target = std::move(next);
}

void LineWriter::put(std::string line) {
  std::unique_lock lock(state_->mutex);
  State& s = *state_;
  if (!thread_.joinable()) {
    const Target target = s.target;
    lock.unlock();
    return target->write(line);
  }
  if (s.lines.size() >= kMaxLines || s.bytes + line.size() > kMaxBytes) {
    ++s.lost;
    return;
  }
  if (s.all_written() && !s.target->ready()) s.behind = true;
  s.bytes += line.size();
  s.lines.push_back({s.target, std::move(line)});
  s.wanted.notify_one();
  if (s.behind) return;
  if (!s.written.wait_for(lock, kPatience, [&s] { return s.all_written(); })) s.behind = true;
}

std::uint64_t LineWriter::take_lost() {
  const std::lock_guard lock(state_->mutex);
  return state_->lines.size() < kMaxLines / 2 ? std::exchange(state_->lost, 0) : 0;
}

}  // namespace stepwright::log
