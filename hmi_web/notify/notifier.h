#pragma once

// Tells people of alarms that nobody acknowledges, each channel by a thread of its own: a mail server that
// does not answer holds up neither the other channels nor anything else, and costs a line in the log when
// that begins and when it ends.
//
//   Notifier notifier("bench", channels, sender, [&] { return standing(); }, tell);
//   notifier.test("shift", "ada");              // sends now; status() tells what became of it
//
// Threads: every function from any. What it is given outlives it; the destructor ends what is under way.

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "hmi_web/api/cell_notifications.h"
#include "hmi_web/notify/channel.h"
#include "hmi_web/notify/schedule.h"
#include "hmi_web/notify/sender.h"
#include "runtime/ground/result/result.h"

namespace stepwright::notify {

class Notifier : public api::CellNotifications {
 public:
  // Alarms that stand and that nobody has acknowledged; from any thread.
  using Standing = std::function<std::vector<StandingAlarm>()>;
  // For the log: `failing` begins (true) or ends. From any thread.
  using Tell = std::function<void(const std::string& channel, bool failing, const std::string& what)>;
  static constexpr std::chrono::milliseconds kTurn{500};

  // `told` keeps what was told of over restarts; null: every start tells again.
  Notifier(std::string cell, std::vector<Channel> channels, Sender& sender, Standing standing, Tell tell,
           NotificationStore* told = nullptr);
  ~Notifier() override;
  Notifier(const Notifier&) = delete;
  Notifier& operator=(const Notifier&) = delete;

  std::vector<api::NotificationStatus> status() const override;
  [[nodiscard]] result::Result<void> test(const std::string& channel, const std::string& user) override;

 private:
  struct Worker;
  void work(Worker& worker, const std::stop_token& stop);
  bool send(Worker& worker, const Message& message, bool is_test, const std::stop_token& stop);

  const std::string cell_;
  Sender& sender_;
  const Standing standing_;
  const Tell tell_;
  NotificationStore* const told_;
  std::vector<std::unique_ptr<Worker>> workers_;
};

}  // namespace stepwright::notify
