#include "hmi_web/notify/message.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace stepwright::notify {
namespace {

using alarms::Priority;
using nlohmann::json;

constexpr std::chrono::minutes kRepeat{15};

StandingAlarm high() {
  return {"a1.high",      "Tank a1 is nearly full",
          "Main.level",   "close the valve",
          Priority::High, 1'767'225'600'000'000'000,
          92.5,           false,
          "92.50 l",      "l"};
}
StandingAlarm lost() {
  return {"runtime.lost", "The runtime does not answer", "cell.runtime_alive", "", Priority::Critical, 1, 0};
}

Channel mail() {
  Channel channel;
  channel.name = "shift";
  channel.server = "smtp://localhost:25";
  channel.from = "line@plant.example";
  channel.to = {"a@plant.example", "b@plant.example"};
  return channel;
}

TEST(Message, WhenAnAlarmStands_ThenItSaysWhatSinceWhenAndWhatToDo) {
  const Message message = message_of("bench", {high()}, kRepeat);
  EXPECT_EQ(message.subject, "bench: Tank a1 is nearly full (high)");
  EXPECT_NE(
      message.text.find("a1.high, unacknowledged, raised 2026-01-01 00:00:00 UTC, Main.level = 92.50 l"),
      std::string::npos)
      << message.text;
  EXPECT_NE(message.text.find("What to do: close the valve"), std::string::npos);
  const json document = json::parse(message.json);
  EXPECT_EQ(document["cell"], "bench");
  EXPECT_EQ(document["alarms"][0]["name"], "a1.high");
  EXPECT_EQ(document["alarms"][0]["value"], 92.5);
  EXPECT_EQ(document["alarms"][0]["told"], "92.50 l");
  EXPECT_EQ(document["alarms"][0]["unit"], "l");
  EXPECT_EQ(document["alarms"][0]["raised_ms"], 1'767'225'600'000);
}

TEST(Message, WhenItIsToldOnce_ThenItDoesNotSayThatItIsToldAgain) {
  const auto last = [](std::chrono::seconds repeat) {
    const std::string text = message_of("bench", {high()}, repeat).text;
    return text.substr(text.rfind("\nSent ") + 1);
  };
  EXPECT_EQ(last(kRepeat), "Sent by the cell bench until somebody acknowledges it on its page.\n");
  EXPECT_EQ(last({}), "Sent once by the cell bench: its page shows what stands now.\n");
}

TEST(Message, WhenTheSourceIsABool_ThenItsValueIsATruthValue) {
  StandingAlarm hot = high();
  hot.source = "Main.hot";
  hot.value = 1;
  hot.is_bool = true;
  hot.told = "TRUE";
  const Message on = message_of("bench", {hot}, kRepeat);
  EXPECT_NE(on.text.find("Main.hot = TRUE\n"), std::string::npos) << on.text;
  EXPECT_EQ(json::parse(on.json)["alarms"][0]["value"], true);
  EXPECT_TRUE(json::parse(on.json)["alarms"][0]["value"].is_boolean());
  hot.value = 0;
  hot.told = "FALSE";
  EXPECT_NE(message_of("bench", {hot}, kRepeat).text.find("Main.hot = FALSE\n"), std::string::npos);
}

TEST(Message, WhenSeveralStand_ThenTheMostUrgentIsTheSubject) {
  const Message message = message_of("bench", {high(), lost()}, kRepeat);
  EXPECT_EQ(message.subject, "bench: The runtime does not answer (critical) and 1 more");
  EXPECT_EQ(json::parse(message.json)["alarms"][0]["name"], "runtime.lost");
  EXPECT_EQ(message.text.find("cell.runtime_alive ="), std::string::npos) << "that number says nothing";
}

TEST(Mail, WhenTextsHaveLineBreaksAndOtherLetters_ThenHeadersStayWhole) {
  StandingAlarm alarm = high();
  alarm.text = "Beh\u00e4lter voll\r\nBcc: <evil@plant.example>";
  const std::string text =
      mail_of(mail(), message_of("bench", {alarm}, kRepeat), "Thu, 01 Jan 2026 00:00:00 +0000", "id@x");
  const std::string head = text.substr(0, text.find("\r\n\r\n"));
  EXPECT_EQ(head.find("\nBcc"), std::string::npos) << head;
  EXPECT_NE(head.find("\r\nTo: <a@plant.example>, <b@plant.example>\r\n"), std::string::npos);
  EXPECT_NE(head.find("\r\nSubject: =?UTF-8?B?"), std::string::npos);
  for (const char c : head) EXPECT_TRUE((c >= 0x20 && c < 0x7F) || c == '\r' || c == '\n');
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 1))
    EXPECT_EQ(text[at - 1], '\r');
  EXPECT_NE(mail_of(mail(), message_of("bench", {high()}, kRepeat), "d", "i").find("Subject: bench: Tank a1"),
            std::string::npos)
      << "plain words stay as they are";
}

}  // namespace
}  // namespace stepwright::notify
