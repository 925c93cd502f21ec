// The bounds of what travels, on the socket and on Fast DDS alike: outwards what is too long is cut or not
// sent, inwards it is malformed.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <limits>

#include "runtime/bytecode/container_format.h"
#include "runtime/host/duration_counts.h"
#include "runtime/host/limits.h"
#include "runtime/service/codec.h"

namespace stepwright::service {
namespace {

std::vector<std::byte> bytes_of(const Message& message) {
  std::vector<std::byte> bytes;
  EXPECT_TRUE(encode(message, bytes));
  return bytes;
}

bool is_sent(const Message& message) {
  std::vector<std::byte> bytes;
  return encode(message, bytes);
}

// What arrives of it.
template <typename Body>
Body through(const Body& body) {
  auto back = decode(bytes_of(body));
  EXPECT_TRUE(back);
  return back ? std::get<Body>(std::move(*back)) : Body{};
}

// The message with one more letter in the text that is `size` times an 'x'.
std::vector<std::byte> with_longer_text(std::vector<std::byte> bytes, std::uint32_t size) {
  const std::vector<std::byte> text(size, std::byte{'x'});
  const auto begin = std::search(bytes.begin(), bytes.end(), text.begin(), text.end());
  EXPECT_NE(begin, bytes.end());
  const std::uint32_t longer = size + 1;
  std::memcpy(&*begin - sizeof longer, &longer, sizeof longer);
  bytes.insert(begin, std::byte{'x'});
  return bytes;
}

// The message, whose last field is a list of `count` elements of `size` bytes each, with one more that is
// zero.
std::vector<std::byte> with_longer_list(std::vector<std::byte> bytes, std::uint32_t count, std::size_t size) {
  const std::uint32_t longer = count + 1;
  std::memcpy(bytes.data() + bytes.size() - count * size - sizeof longer, &longer, sizeof longer);
  bytes.insert(bytes.end(), size, std::byte{0});
  return bytes;
}

struct TextField {
  const char* name;
  std::size_t bound;
  std::function<Message(std::string)> message;
};

std::vector<TextField> cut_texts() {
  const auto in_event = [](auto set) {
    return [set](std::string text) {
      host::StepEvent event;
      event.plant.resize(1);
      set(event, std::move(text));
      return Message(event);
    };
  };
  const auto in_problem = [](auto set) {
    return [set](std::string text) {
      Reply reply;
      reply.problems.resize(1);
      set(reply.problems[0], std::move(text));
      return Message(reply);
    };
  };
  const auto in_status = [](auto set) {
    return [set](std::string text) {
      LinkStatus news;
      news.status.tasks.resize(1);
      set(news.status, std::move(text));
      return Message(news);
    };
  };
  const auto in_health = [](auto set) {
    return [set](std::string text) {
      RuntimeHealth health;
      health.tasks.resize(1);
      health.devices.resize(1);
      set(health, std::move(text));
      return Message(health);
    };
  };
  using std::string;
  return {
      {"event.detail", host::kMaxTextBytes, in_event([](auto& e, string t) { e.detail = std::move(t); })},
      {"event.plant", host::kMaxNameBytes,
       in_event([](auto& e, string t) { e.plant[0].name = std::move(t); })},
      {"problem.code", host::kMaxNameBytes, in_problem([](auto& p, string t) { p.code = std::move(t); })},
      {"problem.file", host::kMaxTextBytes,
       in_problem([](auto& p, string t) { p.where.file = std::move(t); })},
      {"problem.message", host::kMaxTextBytes,
       in_problem([](auto& p, string t) { p.message = std::move(t); })},
      {"problem.hint", host::kMaxTextBytes, in_problem([](auto& p, string t) { p.hint = std::move(t); })},
      {"status.detail", host::kMaxTextBytes, in_status([](auto& s, string t) { s.detail = std::move(t); })},
      {"status.task", host::kMaxNameBytes,
       in_status([](auto& s, string t) { s.tasks[0].name = std::move(t); })},
      {"status.version", host::kMaxTextBytes,
       in_status([](auto& s, string t) { s.process.version = std::move(t); })},
      {"health.task", host::kMaxNameBytes,
       in_health([](auto& h, string t) { h.tasks[0].name = std::move(t); })},
      {"health.problem", host::kMaxReasonBytes,
       in_health([](auto& h, string t) { h.devices_problem = std::move(t); })},
      {"device.name", host::kMaxNameBytes,
       in_health([](auto& h, string t) { h.devices[0].name = std::move(t); })},
      {"device.endpoint", host::kMaxReasonBytes,
       in_health([](auto& h, string t) { h.devices[0].endpoint = std::move(t); })},
      {"device.error", host::kMaxReasonBytes,
       in_health([](auto& h, string t) { h.devices[0].error = std::move(t); })},
      {"presence.process", host::kMaxProcessBytes,
       [](string t) {
         return Message(Presence{std::move(t), 1});
       }},
      {"beacon.runtime_id", host::kMaxNameBytes,
       [](string t) {
         return Message(Beacon{std::move(t), "there"});
       }},
      {"beacon.place", host::kMaxPathBytes,
       [](string t) {
         return Message(Beacon{"bench", std::move(t)});
       }},
  };
}

TEST(Bounds, WhenATextIsTooLong_ThenItIsCutOutwardsAndMalformedInwards) {
  for (const TextField& field : cut_texts()) {
    const auto good = bytes_of(field.message(std::string(field.bound, 'x')));
    EXPECT_EQ(bytes_of(field.message(std::string(field.bound + 500, 'x'))), good) << field.name;
    EXPECT_TRUE(decode(good)) << field.name;
    const auto refused = decode(with_longer_text(good, static_cast<std::uint32_t>(field.bound)));
    ASSERT_FALSE(refused) << field.name;
    EXPECT_EQ(refused.error().front().code, "R0005");
  }
}

TEST(Bounds, WhenADigestIsTooLong_ThenTheMessageIsNeitherSentNorRead) {
  const auto in = [](std::string digest) {
    return std::vector<Message>{Reply{1, 2, {}, digest, 0, 0, {}, {}},
                                host::StepEvent{1, 2, 3, host::EventKind::Started, digest, {}, {}, {}},
                                host::Snapshot{1, 2, digest, {}, {}}};
  };
  for (const Message& message : in(std::string(host::kDigestLetters + 1, 'x')))
    EXPECT_FALSE(is_sent(message)) << message.index();
  for (const Message& message : in(std::string(host::kDigestLetters, 'x')))
    EXPECT_FALSE(decode(with_longer_text(bytes_of(message), host::kDigestLetters))) << message.index();
}

TEST(Bounds, WhenBytesAreTooMany_ThenTheMessageIsNotSent) {
  host::StepEvent event;
  event.image.resize(host::kMaxImageBytes);
  EXPECT_TRUE(is_sent(event));
  event.image.emplace_back();
  EXPECT_FALSE(is_sent(event));
  host::Snapshot snapshot;
  snapshot.image.resize(host::kMaxImageBytes + 1);
  EXPECT_FALSE(is_sent(snapshot));
  Reply reply;
  reply.data.resize(host::kMaxChunkBytes + 1);
  EXPECT_FALSE(is_sent(reply));
}

TEST(Bounds, WhenAListIsTooLong_ThenTheFirstOnesGoAndMoreIsMalformed) {
  host::StepEvent event;
  event.plant.resize(host::kMaxPlantValues + 5);
  EXPECT_EQ(through(event).plant.size(), host::kMaxPlantValues);
  constexpr std::size_t kNamedValue = 12;
  EXPECT_FALSE(decode(with_longer_list(bytes_of(event), host::kMaxPlantValues, kNamedValue)));
  Reply reply;
  reply.problems.resize(host::kMaxProblems + 5);
  EXPECT_EQ(through(reply).problems.size(), host::kMaxProblems);
  LinkStatus news;
  news.status.tasks.resize(bytecode::kMaxTasks + 5);
  EXPECT_EQ(through(news).status.tasks.size(), bytecode::kMaxTasks);
  RuntimeHealth health;
  health.tasks.resize(bytecode::kMaxTasks + 5);
  health.devices.resize(host::kMaxDevices + 5);
  EXPECT_EQ(through(health).tasks.size(), bytecode::kMaxTasks);
  EXPECT_EQ(through(health).devices.size(), host::kMaxDevices);
}

// The first bucket and the number of those that follow are bounded together.
TEST(Bounds, WhenADistributionEndsBehindTheLastBucket_ThenItIsNotSentAsItIs) {
  RuntimeHealth health;
  health.tasks.resize(1);
  const auto sent = [&](host::DurationCounts counts) {
    health.tasks[0].latency = std::move(counts);
    return through(health).tasks[0].latency;
  };
  constexpr std::uint32_t kLast = host::kMaxDurationCounts - 1;
  EXPECT_EQ(sent({kLast, {7}}), (host::DurationCounts{kLast, {7}}));
  EXPECT_EQ(sent({kLast, {7, 8}}), (host::DurationCounts{kLast, {7}}));
  EXPECT_EQ(sent({kLast + 1, {7}}), host::DurationCounts{});
  EXPECT_EQ(sent({0xFFFF'FFFF, {7}}), host::DurationCounts{});
}

TEST(Bounds, WhenAFigureOfADeviceIsNone_ThenTheRestTravels) {
  RuntimeHealth health;
  health.devices.resize(1);
  health.devices[0].name = "valves";
  health.devices[0].answer_p50_us = std::numeric_limits<double>::quiet_NaN();
  health.devices[0].answer_max_us = -1.0;
  health.devices[0].answer_age_ms = -2;
  const DeviceHealth arrived = through(health).devices[0];
  EXPECT_EQ(arrived.name, "valves");
  EXPECT_EQ(arrived.answer_p50_us, 0.0);
  EXPECT_EQ(arrived.answer_max_us, 0.0);
  EXPECT_EQ(arrived.answer_age_ms, -1);
}

TEST(Bounds, WhenAFigureOfADeviceIsNoneInwards_ThenTheMessageIsMalformed) {
  RuntimeHealth health;
  health.devices.resize(1);
  const auto good = bytes_of(health);
  const auto with = [&](auto value, std::size_t from_the_end) {
    auto bytes = good;
    std::memcpy(bytes.data() + bytes.size() - from_the_end, &value, sizeof value);
    return decode(bytes).has_value();
  };
  EXPECT_TRUE(with(std::int64_t{-1}, 8));
  EXPECT_FALSE(with(std::int64_t{-2}, 8));
  EXPECT_TRUE(with(5.0, 16));
  EXPECT_FALSE(with(-5.0, 16));
  EXPECT_FALSE(with(std::numeric_limits<double>::infinity(), 24));
  EXPECT_FALSE(with(std::numeric_limits<double>::quiet_NaN(), 32));
}

}  // namespace
}  // namespace stepwright::service
