#include "hmi_web/server/request_policy.h"

#include <gtest/gtest.h>

#include <array>

namespace stepwright::server {
namespace {

constexpr std::array kAssets = {
    protocol::Asset{"/", "text/html", "\"e1\"", false, "<html>", "gz"},
    protocol::Asset{"/assets/a.js", "text/javascript", "\"e2\"", true, "x", "gz"},
};

class RequestPolicyTest : public testing::Test {
 protected:
  RequestPolicy policy_{{"127.0.0.1", 8080}, kAssets};
};

TEST_F(RequestPolicyTest, WhenTheHostIsOurs_ThenThePageIsServed) {
  for (const char* host : {"127.0.0.1:8080", "localhost:8080", "LOCALHOST:8080", "[::1]:8080"}) {
    const Decision decision = policy_.decide({"GET", "/", host, ""});
    EXPECT_EQ(decision.status, 200u) << host;
    EXPECT_EQ(decision.asset, &kAssets[0]) << host;
  }
}

TEST_F(RequestPolicyTest, WhenTheHostIsNotOurs_ThenItIsForbidden) {
  for (const char* host : {"", "evil.example:8080", "localhost", "localhost:80", "127.0.0.1:8081",
                           "localhost:8080.evil", "localhost.evil.example:8080"}) {
    EXPECT_EQ(policy_.decide({"GET", "/", host, ""}).status, 403u) << host;
  }
}

TEST_F(RequestPolicyTest, WhenAnotherAddressIsConfigured_ThenItsNameIsServedToo) {
  const RequestPolicy policy({"10.0.0.5", 80}, kAssets);

  EXPECT_EQ(policy.decide({"GET", "/", "10.0.0.5", ""}).status, 200u);
  EXPECT_EQ(policy.decide({"GET", "/", "10.0.0.5:80", ""}).status, 200u);
  EXPECT_EQ(policy.decide({"GET", "/", "10.0.0.6", ""}).status, 403u);
}

TEST_F(RequestPolicyTest, WhenItListensAtAllAddresses_ThenOnlyItsNamesAreServed) {
  ListenAddress address{"0.0.0.0", 443};
  address.certificate = "page.pem";
  address.names = {"Line.Plant", "10.0.0.5", "fe80::1"};
  const RequestPolicy policy(address, kAssets);
  for (const char* host : {"line.plant", "line.plant:443", "10.0.0.5", "[fe80::1]", "localhost:443"})
    EXPECT_EQ(policy.decide({"GET", "/", host, ""}).status, 200u) << host;
  for (const char* host : {"0.0.0.0", "0.0.0.0:443", "10.0.0.6", "fe80::1", "evil.example", "line.plant:80"})
    EXPECT_EQ(policy.decide({"GET", "/", host, ""}).status, 403u) << host;
  EXPECT_TRUE(policy.is_own_origin("https://line.plant"));
  EXPECT_FALSE(policy.is_own_origin("http://line.plant"));
}

TEST_F(RequestPolicyTest, WhenTheMethodChangesSomething_ThenItIsNotAllowed) {
  for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "CONNECT", ""}) {
    EXPECT_EQ(policy_.decide({method, "/", "localhost:8080", ""}).status, 405u) << method;
  }
}

TEST_F(RequestPolicyTest, WhenTheTargetIsNoAsset_ThenItIsNotFound) {
  for (const char* target :
       {"", "/../etc/passwd", "/assets/", "/assets/a.js/", "//", "http://evil/", "/%2e%2e/x"}) {
    EXPECT_EQ(policy_.decide({"GET", target, "localhost:8080", ""}).status, 404u) << target;
  }
  EXPECT_EQ(policy_.decide({"GET", "/assets/a.js?v=1", "localhost:8080", ""}).status, 200u);
}

TEST_F(RequestPolicyTest, WhenTheBrowserHasIt_ThenItIsNotModified) {
  EXPECT_EQ(policy_.decide({"GET", "/", "localhost:8080", "", "\"e1\""}).status, 304u);
  EXPECT_EQ(policy_.decide({"GET", "/", "localhost:8080", "", "\"e2\""}).status, 200u);
}

TEST_F(RequestPolicyTest, WhenAPageOfOursUpgrades_ThenItMay) {
  const Decision own = policy_.decide({"GET", "/live", "localhost:8080", "http://localhost:8080", "", true});
  const Decision program = policy_.decide({"GET", "/live", "localhost:8080", "", "", true});

  EXPECT_EQ(own.status, 101u);
  EXPECT_EQ(program.status, 101u);
}

TEST_F(RequestPolicyTest, WhenAForeignPageUpgrades_ThenItIsForbidden) {
  for (const char* origin : {"http://evil.example", "http://evil.example:8080", "https://localhost:8080",
                             "null", "http://localhost:8081", "http://localhost"}) {
    EXPECT_EQ(policy_.decide({"GET", "/live", "localhost:8080", origin, "", true}).status, 403u) << origin;
  }
}

TEST_F(RequestPolicyTest, WhenTheLivePathIsFetched_ThenAnUpgradeIsRequired) {
  EXPECT_EQ(policy_.decide({"GET", "/live", "localhost:8080", ""}).status, 426u);
  EXPECT_EQ(policy_.decide({"GET", "/", "localhost:8080", "", "", true}).status, 200u);
}

}  // namespace
}  // namespace stepwright::server
