#include "hmi_web/notify/notifier.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "hmi_web/notify/codes.h"
#include "hmi_web/notify/message.h"

namespace stepwright::notify {
namespace {

using std::chrono::system_clock;

std::int64_t now_ms() {
  return std::chrono::duration_cast<std::chrono::milliseconds>(system_clock::now().time_since_epoch())
      .count();
}

std::string receivers(const Channel& channel) {
  std::string all;
  for (const std::string& each : channel.to) all += (all.empty() ? "" : ", ") + each;
  return all;
}

}  // namespace

struct Notifier::Worker {
  explicit Worker(Channel given) : channel(std::move(given)) {}

  const Channel channel;
  mutable std::mutex mutex;
  std::condition_variable_any changed;
  api::NotificationStatus status;            // this and below: guarded by mutex
  std::optional<std::string> test_asked_by;  // by whom a test is asked for
  std::jthread thread;                       // last: it uses all of the above
};

Notifier::Notifier(std::string cell, std::vector<Channel> channels, Sender& sender, Standing standing,
                   Tell tell, NotificationStore* told)
    : cell_(std::move(cell)),
      sender_(sender),
      standing_(std::move(standing)),
      tell_(std::move(tell)),
      told_(told) {
  for (Channel& channel : channels) {
    workers_.push_back(std::make_unique<Worker>(std::move(channel)));
    Worker& worker = *workers_.back();
    const Channel& of = worker.channel;
    worker.status.channel = of.name;
    worker.status.kind = of.is_mail() ? "mail" : "web hook";
    worker.status.to = receivers(of);
    worker.status.priority = alarms::to_string(of.at_least);
    worker.status.delay = of.delay;
    worker.status.repeat = of.repeat;
  }
  for (auto& worker : workers_)
    worker->thread =
        std::jthread([this, at = worker.get()](const std::stop_token& stop) { work(*at, stop); });
}

Notifier::~Notifier() {
  // All are asked before the first is waited for.
  for (auto& worker : workers_) worker->thread.request_stop();
}

void Notifier::work(Worker& worker, const std::stop_token& stop) {
  Schedule schedule(worker.channel, told_ == nullptr ? Notifications() : told_->of(worker.channel.name));
  while (!stop.stop_requested()) {
    std::optional<std::string> tester;
    {
      std::unique_lock lock(worker.mutex);
      worker.changed.wait_for(lock, stop, kTurn, [&] { return worker.test_asked_by.has_value(); });
      tester = std::exchange(worker.test_asked_by, {});
    }
    if (stop.stop_requested()) return;
    if (tester) send(worker, test_message(cell_, worker.channel, *tester), true, stop);
    const auto due = schedule.due(standing_(), std::chrono::steady_clock::now());
    if (due.empty()) continue;
    const bool arrived = send(worker, message_of(cell_, due, worker.channel.repeat), false, stop);
    schedule.sent(arrived, std::chrono::steady_clock::now());
    // A disk that takes nothing is told by the history, and a restart tells of the alarms again.
    if (arrived && told_ != nullptr) std::ignore = told_->keep(worker.channel.name, schedule.told());
  }
}

bool Notifier::send(Worker& worker, const Message& message, bool is_test, const std::stop_token& stop) {
  const auto done = sender_.send(worker.channel, message, stop);
  if (stop.stop_requested()) return static_cast<bool>(done);
  const std::string problem = done ? "" : result::to_string(done.error());
  bool was_failing = false;
  {
    const std::lock_guard lock(worker.mutex);
    api::NotificationStatus& status = worker.status;
    was_failing = !status.problem.empty();
    status.problem = problem;
    if (done) ++status.sent;
    (done ? status.sent_ms : status.failed_ms) = now_ms();
    if (is_test) status.tests_done += 1;
  }
  if (!done && !was_failing) tell_(worker.channel.name, true, problem);
  if (done && was_failing) tell_(worker.channel.name, false, "it arrives again");
  return static_cast<bool>(done);
}

std::vector<api::NotificationStatus> Notifier::status() const {
  std::vector<api::NotificationStatus> all;
  for (const auto& worker : workers_) {
    const std::lock_guard lock(worker->mutex);
    all.push_back(worker->status);
  }
  return all;
}

result::Result<void> Notifier::test(const std::string& channel, const std::string& user) {
  const auto found =
      std::ranges::find_if(workers_, [&](const auto& each) { return each->channel.name == channel; });
  if (found == workers_.end())
    return result::fail(kNoSuchChannel, {}, "there is no notification '" + channel + "'",
                        "[[notify]] of the cell's configuration names them");
  {
    const std::lock_guard lock((*found)->mutex);
    (*found)->test_asked_by = user;
  }
  (*found)->changed.notify_one();
  return {};
}

}  // namespace stepwright::notify
