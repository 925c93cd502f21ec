#include "runtime/ground/network/ip_range.h"

#include <gtest/gtest.h>

namespace stepwright::network {
namespace {

TEST(IpRange, WhenParsed_ThenItContainsItsNetwork) {
  const auto network = IpRange::parse("192.168.1.0/25");
  ASSERT_TRUE(network);
  EXPECT_TRUE(network->contains(*parse_ip("192.168.1.127")));
  EXPECT_FALSE(network->contains(*parse_ip("192.168.1.128")));
  EXPECT_TRUE(network->contains(*parse_ip("::ffff:192.168.1.1")));
  EXPECT_TRUE(IpRange::parse("0.0.0.0/0")->contains(*parse_ip("8.8.8.8")));
  EXPECT_FALSE(IpRange::parse("0.0.0.0/0")->contains(*parse_ip("::1")));
  EXPECT_TRUE(IpRange::parse("fd00::/8")->contains(*parse_ip("fdab::1")));
  EXPECT_TRUE(IpRange::parse("10.0.0.7")->contains(*parse_ip("10.0.0.7")));
  EXPECT_FALSE(IpRange::parse("10.0.0.7")->contains(*parse_ip("10.0.0.6")));
  for (const char* wrong :
       {"", "10.0.0", "10.0.0.0/33", "10.0.0.0/", "10.0.0.0/-1", "::/129", "host", "10.0.0.0/8x"})
    EXPECT_FALSE(IpRange::parse(wrong)) << wrong;
}

TEST(IpAddress, WhenWritten_ThenAsPeopleDo) {
  EXPECT_EQ(to_string(*parse_ip("192.168.1.7")), "192.168.1.7");
  EXPECT_EQ(to_string(*parse_ip("::ffff:192.168.1.7")), "192.168.1.7");
  EXPECT_EQ(to_string(*parse_ip("fe80::1")), "fe80::1");
}

}  // namespace
}  // namespace stepwright::network
