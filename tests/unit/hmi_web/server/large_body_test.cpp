#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "hmi_web/server/http_server.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/hmi_web/server/raw_connection.h"

namespace stepwright::server {
namespace {

// A route that takes a large body from engineers, and one that does not.
class LargeRoute {
 public:
  static constexpr std::size_t kMost = 200'000;

  LargeRoute() {
    access::AccessOptions options;
    options.cost = {1, 8'192};
    control_ = *access::AccessControl::open(folder_ / "access", options, std::chrono::steady_clock::now);
    audit_ = *access::AuditLog::open(folder_ / "access/audit.jsonl");
    api::Route large;
    large.method = "POST";
    large.least = access::Role::Engineer;
    large.body = {"Large", {{.name = "text", .most = kMost}}};
    large.handler = [](const api::Call& call) {
      return api::Answer{200, std::to_string(call.body.text("text").size()) + " bytes"};
    };
    api::Route usual = large;
    large.path = "/api/large";
    large.most_body = kMost;
    usual.path = "/api/usual";
    table_.emplace(std::vector{large, usual});
    guard_.emplace(*table_, *control_, *audit_, api::RequestGuardOptions{});
  }
  const api::RequestGuard& guard() const { return *guard_; }
  access::OpenedSession session(access::Role role) {
    EXPECT_TRUE(control_->add_user(access::to_string(role), role, "correct horse"));
    return control_->sessions().open(access::to_string(role), role, "127.0.0.1");
  }

 private:
  support::TemporaryFolder folder_;
  std::unique_ptr<access::AccessControl> control_;
  std::unique_ptr<access::AuditLog> audit_;
  std::optional<api::RouteTable> table_;
  std::optional<api::RequestGuard> guard_;
};

class LargeBodyTest : public testing::Test {
 protected:
  LargeBodyTest() {
    auto server = HttpServer::listen({"127.0.0.1", 0}, {}, feed_);
    EXPECT_TRUE(server) << result::to_string(server.error());
    server_ = std::move(*server);
    server_->serve_api(routes_.guard());
    network_ = std::thread([this] { server_->run(); });
  }
  ~LargeBodyTest() override {
    server_->stop();
    network_.join();
  }

  std::string head(const std::string& path, const access::OpenedSession& as,
                   const std::string& length) const {
    const std::string own = "localhost:" + std::to_string(server_->port());
    return "POST " + path + " HTTP/1.1\r\nHost: " + own + "\r\nOrigin: http://" + own +
           "\r\nContent-Type: application/json\r\nCookie: " + std::string(api::kSessionCookie) + "=" +
           as.token + "\r\nX-CSRF-Token: " + as.csrf + "\r\n" + length + "\r\n\r\n";
  }
  // What is answered, the body being sent only if somebody may.
  std::string post(const std::string& path, const access::OpenedSession& as, std::size_t bytes,
                   bool sends = true) {
    const std::string body = R"({"text": ")" + std::string(bytes, 'x') + "\"}";
    RawConnection connection(server_->port());
    connection.send(head(path, as, "Connection: close\r\nContent-Length: " + std::to_string(body.size())));
    if (sends) connection.send(body);
    return connection.read_all();
  }

  LargeRoute routes_;
  const Feed feed_{{"bench", "1"}, {}};
  std::unique_ptr<HttpServer> server_;
  std::thread network_;
  const access::OpenedSession engineer_ = routes_.session(access::Role::Engineer);
  const access::OpenedSession operator_ = routes_.session(access::Role::Operator);
};

TEST_F(LargeBodyTest, WhenTheRouteAdmitsSomebody_ThenItsBodyMayBeLarge) {
  EXPECT_NE(post("/api/large", engineer_, 150'000).find("\r\n\r\n150000 bytes"), std::string::npos);
  EXPECT_NE(post("/api/large", engineer_, 100).find("\r\n\r\n100 bytes"), std::string::npos);
  EXPECT_NE(post("/api/usual", engineer_, 100).find("\r\n\r\n100 bytes"), std::string::npos);
}

TEST_F(LargeBodyTest, WhenItIsTooLarge_ThenItIsRefusedBeforeItIsRead) {
  EXPECT_EQ(post("/api/large", engineer_, LargeRoute::kMost + 1, false).rfind("HTTP/1.1 413", 0), 0u);
  EXPECT_EQ(post("/api/large", engineer_, 40'000'000, false).rfind("HTTP/1.1 413", 0), 0u);
  EXPECT_EQ(post("/api/usual", engineer_, 20'000, false).rfind("HTTP/1.1 413", 0), 0u);
  EXPECT_EQ(post("/api/nowhere", engineer_, 20'000, false).rfind("HTTP/1.1 413", 0), 0u);
}

TEST_F(LargeBodyTest, WhenTheRouteDoesNotAdmitSomebody_ThenNoLargeBodyIsReadOfThem) {
  access::OpenedSession forged = engineer_;
  forged.csrf = "x";
  for (const access::OpenedSession& one : {access::OpenedSession{}, operator_, forged})
    EXPECT_EQ(post("/api/large", one, 150'000, false).rfind("HTTP/1.1 413", 0), 0u);
  EXPECT_EQ(post("/api/large", operator_, 100).rfind("HTTP/1.1 403", 0), 0u);
}

TEST_F(LargeBodyTest, WhenItsLengthIsNotSaid_ThenTheSameHolds) {
  const auto chunked = [&](const access::OpenedSession& as, std::size_t bytes) {
    const std::string body = R"({"text": ")" + std::string(bytes, 'x') + "\"}";
    char size[32];
    std::snprintf(size, sizeof size, "%zx\r\n", body.size());
    RawConnection connection(server_->port());
    connection.send(head("/api/large", as, "Connection: close\r\nTransfer-Encoding: chunked"));
    connection.send(size);
    connection.send(body + "\r\n0\r\n\r\n");
    return connection.read_all();
  };
  EXPECT_NE(chunked(engineer_, 150'000).find("150000 bytes"), std::string::npos);
  EXPECT_EQ(chunked(engineer_, LargeRoute::kMost + 1).find("200 OK"), std::string::npos);
  EXPECT_EQ(chunked(operator_, 150'000).find("200 OK"), std::string::npos);
}

TEST_F(LargeBodyTest, WhenRequestsFollowOneAnother_ThenEachIsJudgedByItself) {
  RawConnection connection(server_->port());
  const std::string large = R"({"text": ")" + std::string(100'000, 'x') + "\"}";
  const std::string small = R"({"text": "abc"})";
  connection.send(head("/api/large", engineer_, "Content-Length: " + std::to_string(large.size())) + large);
  EXPECT_NE(connection.read_until("100000 bytes").find("200 OK"), std::string::npos);
  connection.send(head("/api/usual", operator_, "Content-Length: " + std::to_string(small.size())) + small);
  EXPECT_NE(connection.read_until("\r\n\r\n").find("403 Forbidden"), std::string::npos);
}

}  // namespace
}  // namespace stepwright::server
