#include "runtime/ground/network/own_addresses.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace stepwright::network {
namespace {

IpAddress address(const char* text) {
  return *parse_ip(text);
}

TEST(OwnAddresses, WhenAnInterfaceHasOne_ThenItIsThisMachines) {
  const std::vector<IpAddress> own = {address("192.168.1.7"), address("fe80::1")};
  EXPECT_TRUE(is_own(address("192.168.1.7"), own));
  EXPECT_TRUE(is_own(address("fe80::1"), own));
  EXPECT_FALSE(is_own(address("192.168.1.8"), own));
  EXPECT_FALSE(is_own(address("fe80::2"), own));
}

TEST(OwnAddresses, WhenItIsLoopbackOrEveryAddress_ThenItIsThisMachines) {
  for (const char* text : {"127.0.0.1", "127.8.9.10", "::1", "0.0.0.0", "::"})
    EXPECT_TRUE(is_own(address(text), {})) << text;
  for (const char* text : {"128.0.0.1", "0.0.0.1", "::2"}) EXPECT_FALSE(is_own(address(text), {})) << text;
}

TEST(OwnAddresses, WhenThisMachineIsAsked_ThenLoopbackIsAmongThem) {
  const std::vector<IpAddress> own = own_addresses();
  EXPECT_NE(std::find(own.begin(), own.end(), address("127.0.0.1")), own.end()) << list_of(own, false);
  // Of the block that is kept for documents (RFC 5737).
  EXPECT_FALSE(is_own(address("192.0.2.1"), own));
}

TEST(OwnAddresses, WhenTheyAreListed_ThenAsPeopleWriteThem) {
  const std::vector<IpAddress> own = {address("127.0.0.1"), address("::1"), address("10.0.0.7")};
  EXPECT_EQ(list_of(own, false), "127.0.0.1, ::1, 10.0.0.7");
  EXPECT_EQ(list_of(own, true), "127.0.0.1, 10.0.0.7");
  EXPECT_EQ(list_of({}, true), "");
}

}  // namespace
}  // namespace stepwright::network
