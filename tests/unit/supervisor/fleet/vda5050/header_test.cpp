#include "supervisor/fleet/vda5050/header.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>

namespace stepwright::fleet::vda5050 {
namespace {

using namespace std::chrono_literals;

Timestamp at(std::chrono::sys_days day, std::chrono::milliseconds time) {
  return day + time;
}

TEST(Header, Timestamp_WhenWritten_ThenIso8601InUtcWithMilliseconds) {
  using std::chrono::year, std::chrono::sys_days;
  EXPECT_EQ(to_text(at(sys_days(year(2026) / 11 / 23), 3h + 50min + 7s + 5ms)), "2026-11-23T03:50:07.005Z");
  EXPECT_EQ(to_text(at(sys_days(year(1969) / 12 / 31), 23h + 59min + 59s + 999ms)),
            "1969-12-31T23:59:59.999Z");
}

TEST(Header, Timestamp_WhenReadBack_ThenTheSame) {
  for (std::int64_t ms = -2'000'000'000'000; ms < 4'000'000'000'000; ms += 98'765'432'101) {
    const Timestamp time{std::chrono::milliseconds(ms)};
    EXPECT_EQ(timestamp_of(to_text(time)), time) << ms;
  }
  EXPECT_EQ(timestamp_of("2017-04-15T11:40:03.12Z"), timestamp_of("2017-04-15T11:40:03.120Z"));
  EXPECT_EQ(timestamp_of("2017-04-15T11:40:03Z"), timestamp_of("2017-04-15T11:40:03.000999999Z"));
  EXPECT_TRUE(timestamp_of("2024-02-29T00:00:00Z").has_value());
}

TEST(Header, Timestamp_WhenItIsNone_ThenNothing) {
  for (const std::string text :
       {"", "2017-04-15", "2017-04-15T11:40:03.12", "2017-04-15T11:40:03.12+01:00", "2017-04-15T11:40:03.Z",
        "2017-04-15T11:40:03.1234567890Z", "2017-02-29T11:40:03Z", "2017-13-01T11:40:03Z",
        "2017-04-15T24:00:00Z", "2017-04-15T11:60:03Z", "2017-04-15T11:40:60Z", "2017-04-15 11:40:03Z",
        "20170415T114003Z", "2017-04-15T11:40:03Z ", "+017-04-15T11:40:03Z"}) {
    EXPECT_FALSE(timestamp_of(text).has_value()) << text;
  }
}

TEST(Header, Ids_WhenMessagesAreMade_ThenEachTopicCountsOnItsOwn) {
  HeaderIds ids;
  const Address address{"uagv", "Stepwright", "v1"};
  EXPECT_EQ(make_header(address, Topic::Order, ids, {}).header_id, 0u);
  EXPECT_EQ(make_header(address, Topic::Order, ids, {}).header_id, 1u);
  const Header other = make_header(address, Topic::InstantActions, ids, {});
  EXPECT_EQ(other.header_id, 0u);
  EXPECT_EQ(other.version, "2.1.0");
  EXPECT_EQ(other.serial_number, "v1");
}

TEST(Topic, Name_WhenReadBack_ThenTheSameAddressAndTopic) {
  const Address address{"uagv", "Stepwright GmbH", "fork_1.a:b-2"};
  for (const Topic topic : kTopics) {
    const auto found = parse_topic_name(topic_name(address, topic));
    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(found->address, address);
    EXPECT_EQ(found->topic, topic);
  }
  EXPECT_EQ(topic_name(address, Topic::InstantActions),
            "uagv/v2/Stepwright GmbH/fork_1.a:b-2/instantActions");
}

TEST(Topic, Name_WhenItIsNoneOfTheStandard_ThenNothing) {
  for (const std::string name :
       {"", "uagv/v2/m/s", "uagv/v3/m/s/order", "uagv/v2/m/s/orders", "uagv/v2/m//order",
        "uagv/v2/m/s/order/", "/v2/m/s/order", "uagv/v2/m/+/order", "uagv/v2/m/s s/order"}) {
    EXPECT_FALSE(parse_topic_name(name).has_value()) << name;
  }
}

TEST(Topic, Address_WhenALevelIsWrong_ThenItIsNamed) {
  EXPECT_TRUE(check(Address{"uagv", "Stepwright", "v1"}).empty());
  const auto wrong = check(Address{"u/agv", "", "vehicle 1"});
  ASSERT_EQ(wrong.size(), 3u);
  EXPECT_EQ(wrong[0].code, "F0906");
  EXPECT_NE(wrong[0].message.find("interfaceName 'u/agv'"), std::string::npos);
  EXPECT_NE(wrong[2].message.find("serialNumber 'vehicle 1'"), std::string::npos);
}

TEST(Topic, Delivery_WhenAsked_ThenAsTheStandardHasIt) {
  EXPECT_EQ(delivery_of(Topic::Order).qos, 0);
  EXPECT_FALSE(delivery_of(Topic::Order).retained);
  EXPECT_EQ(delivery_of(Topic::Connection).qos, 1);
  EXPECT_TRUE(delivery_of(Topic::Connection).retained);
  EXPECT_TRUE(delivery_of(Topic::Factsheet).retained);
}

}  // namespace
}  // namespace stepwright::fleet::vda5050
