#include "hmi_web/notify/notifier.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>

#include "hmi_web/notify/codes.h"
#include "hmi_web/notify/curl_sender.h"

namespace stepwright::notify {
namespace {

using std::chrono::seconds;

constexpr seconds kPatience{60};

// Keeps what it is given; a channel called "dead" takes nothing and answers only when it is told to stop.
class RecordingSender : public Sender {
 public:
  result::Result<void> send(const Channel& channel, const Message& message,
                            const std::stop_token& stop) override {
    std::unique_lock lock(mutex_);
    if (channel.name == "dead") {
      changed_.wait(lock, stop, [] { return false; });
      return result::fail(kNotSent, {}, "nobody answers");
    }
    if (failing) return result::fail(kNotSent, {}, "nobody answers");
    subjects_.push_back(channel.name + ": " + message.subject);
    changed_.notify_all();
    return {};
  }
  bool has(const std::string& subject) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kPatience,
                             [&] { return std::ranges::find(subjects_, subject) != subjects_.end(); });
  }
  std::atomic<bool> failing{false};

 private:
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::vector<std::string> subjects_;
};

Channel channel(const std::string& name) {
  Channel one;
  one.name = name;
  one.web_hook = "http://127.0.0.1:1/";
  one.delay = seconds(0);
  return one;
}

std::vector<StandingAlarm> one_alarm() {
  StandingAlarm alarm;
  alarm.name = "runtime.lost";
  alarm.text = "The runtime does not answer";
  alarm.priority = alarms::Priority::Critical;
  return {alarm};
}

template <typename Condition>
bool comes_true(Condition condition) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

TEST(Notifier, WhenOneServerDoesNotAnswer_ThenTheOthersAreToldAllTheSame) {
  RecordingSender sender;
  Notifier notifier("bench", {channel("dead"), channel("shift")}, sender, one_alarm, [](auto...) {});
  EXPECT_TRUE(sender.has("shift: bench: The runtime does not answer (critical)"));
}

TEST(Notifier, WhenATestIsAskedFor_ThenItIsSentAndItsEndIsTold) {
  RecordingSender sender;
  std::vector<std::string> told;
  std::mutex mutex;
  Notifier notifier(
      "bench", {channel("shift")}, sender, [] { return std::vector<StandingAlarm>(); },
      [&](const std::string& name, bool failing, const std::string& what) {
        const std::lock_guard lock(mutex);
        told.push_back(name + (failing ? " fails: " : " works: ") + what);
      });
  ASSERT_TRUE(notifier.test("shift", "ada"));
  EXPECT_TRUE(sender.has("shift: bench: test of 'shift'"));
  ASSERT_TRUE(comes_true([&] { return notifier.status()[0].tests_done == 1; }));
  EXPECT_EQ(notifier.status()[0].problem, "");
  EXPECT_EQ(notifier.status()[0].sent, 1u);

  sender.failing = true;
  ASSERT_TRUE(notifier.test("shift", "ada"));
  ASSERT_TRUE(comes_true([&] { return notifier.status()[0].tests_done == 2; }));
  EXPECT_NE(notifier.status()[0].problem.find("nobody answers"), std::string::npos);
  EXPECT_GT(notifier.status()[0].failed_ms, 0);
  ASSERT_TRUE(notifier.test("shift", "ada"));
  ASSERT_TRUE(comes_true([&] { return notifier.status()[0].tests_done == 3; }));
  sender.failing = false;
  ASSERT_TRUE(notifier.test("shift", "ada"));
  ASSERT_TRUE(comes_true([&] {
    const std::lock_guard lock(mutex);
    return told.size() == 2;
  })) << "that it fails is told once, and once that it works again";
  EXPECT_NE(told[0].find("shift fails: "), std::string::npos);
  EXPECT_NE(told[1].find("shift works: "), std::string::npos);

  const auto unknown = notifier.test("night", "ada");
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().front().code, kNoSuchChannel);
}

TEST(CurlSender, WhenNobodyListens_ThenItSaysWhereAndWhatToLookAt) {
  CurlSender sender;
  Channel mail = channel("shift");
  mail.web_hook.clear();
  mail.server = "smtp://127.0.0.1:1";
  mail.from = "line@plant.example";
  mail.to = {"shift@plant.example"};
  for (const Channel& each : {channel("hook"), mail}) {
    const auto sent = sender.send(each, Message{"s", "t", "{}"}, {});
    ASSERT_FALSE(sent);
    EXPECT_EQ(sent.error().front().code, kNotSent);
    EXPECT_NE(sent.error().front().message.find("127.0.0.1:1"), std::string::npos);
    EXPECT_NE(sent.error().front().hint.find("is the server running"), std::string::npos);
  }
}

TEST(NotificationStoreFile, WhenItIsOpenedAgain_ThenItHasWhatWasKept) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "notified.json";
  std::filesystem::remove(file);
  {
    NotificationStore told(file);
    EXPECT_EQ(told.of("shift"), Notifications());
    EXPECT_TRUE(told.keep("shift", {{"runtime.lost", {7, 70}}}));
    EXPECT_TRUE(told.keep("chat", {{"a", {1, 10}}, {"b", {2, 20}}}));
    EXPECT_TRUE(told.keep("chat", {{"b", {2, 20}}}));
  }
  const NotificationStore again(file);
  EXPECT_EQ(again.of("shift"), (Notifications{{"runtime.lost", {7, 70}}}));
  EXPECT_EQ(again.of("chat"), (Notifications{{"b", {2, 20}}}));
  for (const char* damaged : {"", "[]", R"({"chat": {"b": "x"}})"}) {
    std::ofstream(file) << damaged;
    EXPECT_EQ(NotificationStore(file).of("chat"), Notifications()) << damaged;
  }
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace stepwright::notify
