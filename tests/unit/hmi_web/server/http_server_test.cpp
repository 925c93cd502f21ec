#include "hmi_web/server/http_server.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "hmi_web/server/api_lanes.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/hmi_web/server/raw_connection.h"

namespace stepwright::server {
namespace {

using nlohmann::json;

constexpr std::array kAssets = {
    protocol::Asset{"/", "text/html; charset=utf-8", "\"e1\"", false, "<html>page</html>", "squeezed"},
    protocol::Asset{"/assets/a.js", "text/javascript", "\"e2\"", true, "code", "squeezed"},
};

class HttpServerTest : public testing::Test {
 protected:
  HttpServerTest() { start({}); }
  ~HttpServerTest() override { end(); }

  void start(const ServerLimits& limits) {
    auto server = HttpServer::listen({"127.0.0.1", 0}, kAssets, feed_, limits);
    ASSERT_TRUE(server) << result::to_string(server.error());
    server_ = std::move(*server);
    network_ = std::thread([this] { server_->run(); });
  }
  void end() {
    if (!network_.joinable()) return;
    server_->stop();
    network_.join();
  }

  std::string get(const std::string& target, const std::string& fields = {}) {
    RawConnection connection(server_->port());
    connection.send("GET " + target + " HTTP/1.1\r\nHost: localhost:" + std::to_string(server_->port()) +
                    "\r\nConnection: close\r\n" + fields + "\r\n");
    return connection.read_all();
  }

  std::string upgrade_request(const std::string& fields = {}) const {
    return "GET /live HTTP/1.1\r\nHost: localhost:" + std::to_string(server_->port()) +
           "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
           "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n" +
           fields + "\r\n";
  }

  static constexpr std::string_view kBegin =
      R"({"type":"begin","protocol":5,"show":{"number":1,"tags":"all","also":["plan","trend"]}})";

  // The close frame, past what was sent before it.
  static std::string read_close(RawConnection& viewer) {
    while (const auto frame = viewer.read_frame()) {
      if (frame->rfind("close", 0) == 0) return *frame;
    }
    return "ended without a close";
  }

  void publish(std::uint64_t scan, std::size_t tags = 0) {
    CellView view;
    view.state.runtime_alive = true;
    view.state.scan = scan;
    view.state.tags.assign(tags, static_cast<double>(scan));
    feed_.update(view, std::chrono::steady_clock::now());
    server_->notify();
  }

  Feed feed_{{"bench", "1"}, {}};
  std::unique_ptr<HttpServer> server_;
  std::thread network_;
};

TEST_F(HttpServerTest, WhenNobodyGivesMetrics_ThenThereIsNothing) {
  EXPECT_NE(get("/metrics").find("HTTP/1.1 404"), std::string::npos);
}

TEST_F(HttpServerTest, WhenMetricsAreAskedFor_ThenTheyAreMadeForThatRequest) {
  end();
  auto server = HttpServer::listen({"127.0.0.1", 0}, kAssets, feed_);
  ASSERT_TRUE(server) << result::to_string(server.error());
  server_ = std::move(*server);
  int asked = 0;
  server_->serve_metrics([&asked] { return "asked " + std::to_string(++asked) + "\n"; },
                         "text/plain; version=0.0.4");
  network_ = std::thread([this] { server_->run(); });
  EXPECT_NE(get("/metrics").find("\r\n\r\nasked 1\n"), std::string::npos);
  const std::string second = get("/metrics?x=1");
  EXPECT_NE(second.find("\r\n\r\nasked 2\n"), std::string::npos);
  EXPECT_NE(second.find("Content-Type: text/plain; version=0.0.4"), std::string::npos) << second;
  EXPECT_NE(second.find("X-Content-Type-Options: nosniff"), std::string::npos);
}

// Two routes, and a lane for each.
class TwoRoutes {
 public:
  explicit TwoRoutes(std::shared_future<void> held) {
    access::AccessOptions options;
    options.cost = {1, 8'192};
    control_ = *access::AccessControl::open(folder_ / "access", options, std::chrono::steady_clock::now);
    audit_ = *access::AuditLog::open(folder_ / "access/audit.jsonl");
    api::Route slow, quick;
    slow.method = quick.method = "GET";
    slow.least = quick.least = access::Role::None;
    slow.path = "/api/slow";
    slow.lane = api::Lane::Records;
    slow.handler = [held](const api::Call&) {
      held.wait();
      return api::Answer{200, "slow", "text/csv", "a.csv"};
    };
    quick.path = "/api/quick";
    quick.handler = [](const api::Call&) { return api::Answer{200, "quick"}; };
    table_.emplace(std::vector{slow, quick});
    guard_.emplace(*table_, *control_, *audit_, api::RequestGuardOptions{});
  }
  const api::RequestGuard& guard() const { return *guard_; }

 private:
  support::TemporaryFolder folder_;
  std::unique_ptr<access::AccessControl> control_;
  std::unique_ptr<access::AuditLog> audit_;
  std::optional<api::RouteTable> table_;
  std::optional<api::RequestGuard> guard_;
};

TEST_F(HttpServerTest, WhenRecordsAreReadForLong_ThenOtherRequestsDoNotWait) {
  end();
  auto server = HttpServer::listen({"127.0.0.1", 0}, kAssets, feed_);
  ASSERT_TRUE(server) << result::to_string(server.error());
  server_ = std::move(*server);
  std::promise<void> ends;
  const TwoRoutes routes(ends.get_future().share());
  server_->serve_api(routes.guard());
  network_ = std::thread([this] { server_->run(); });
  RawConnection slow(server_->port());
  slow.send("GET /api/slow HTTP/1.1\r\nHost: localhost:" + std::to_string(server_->port()) +
            "\r\nConnection: close\r\n\r\n");
  EXPECT_NE(get("/api/quick").find("\r\n\r\nquick"), std::string::npos);
  ends.set_value();
  const std::string answer = slow.read_all();
  EXPECT_NE(answer.find("\r\n\r\nslow"), std::string::npos);
  EXPECT_NE(answer.find("Content-Disposition: attachment; filename=\"a.csv\""), std::string::npos);
  EXPECT_NE(answer.find("X-Content-Type-Options: nosniff"), std::string::npos);
  end();  // before the guard that it refers to
}

TEST(ApiLanes, WhenTooManyWait_ThenTheNextIsRefusedUntilThereIsRoom) {
  std::promise<void> begun, ends;
  std::atomic<int> done = 0;
  ApiLanes lanes;
  ASSERT_TRUE(lanes.post(api::Lane::Records, [&, held = ends.get_future().share()] {
    begun.set_value();
    held.wait();
  }));
  begun.get_future().wait();
  for (std::size_t i = 0; i < ApiLanes::kMostWaiting; ++i)
    ASSERT_TRUE(lanes.post(api::Lane::Records, [&] { ++done; }));
  EXPECT_FALSE(lanes.post(api::Lane::Records, [&] { ++done; }));
  ends.set_value();
  std::promise<void> last;
  while (!lanes.post(api::Lane::Records, [&] { last.set_value(); })) std::this_thread::yield();
  last.get_future().wait();
  EXPECT_EQ(done, static_cast<int>(ApiLanes::kMostWaiting));
}

TEST_F(HttpServerTest, WhenItServesMetricsOnly_ThenThereIsNoPageAndNoViewer) {
  end();
  auto server = HttpServer::listen_for_metrics(
      {"127.0.0.1", 0, "modbus.server.metrics"}, [] { return std::string("figures\n"); }, "text/plain");
  ASSERT_TRUE(server) << result::to_string(server.error());
  server_ = std::move(*server);
  network_ = std::thread([this] { server_->run(); });
  EXPECT_NE(get("/metrics").find("\r\n\r\nfigures\n"), std::string::npos);
  EXPECT_NE(get("/").find("HTTP/1.1 404"), std::string::npos);
  EXPECT_NE(get("/live").find("HTTP/1.1 404"), std::string::npos);
  RawConnection viewer(server_->port());
  viewer.send(upgrade_request());
  EXPECT_NE(viewer.read_until("\r\n\r\n").find("HTTP/1.1 404"), std::string::npos);
  const auto taken = HttpServer::listen_for_metrics(
      {"127.0.0.1", server_->port(), "modbus.server.metrics"}, [] { return std::string(); }, "text/plain");
  ASSERT_FALSE(taken);
  EXPECT_EQ(taken.error().front().code, "H0001");
  EXPECT_NE(taken.error().front().hint.find("modbus.server.metrics.port"), std::string::npos);
}

TEST_F(HttpServerTest, WhenThePageIsAskedFor_ThenItComesWithItsSafetyHeaders) {
  const std::string response = get("/");

  EXPECT_NE(response.find("HTTP/1.1 200"), std::string::npos) << response;
  EXPECT_NE(response.find("Content-Security-Policy: default-src 'self';"), std::string::npos);
  EXPECT_NE(response.find("frame-ancestors 'none'"), std::string::npos);
  EXPECT_NE(response.find("X-Content-Type-Options: nosniff"), std::string::npos);
  EXPECT_NE(response.find("\r\n\r\n<html>page</html>"), std::string::npos);
}

TEST_F(HttpServerTest, WhenTheBrowserTakesGzip_ThenItGetsGzip) {
  const std::string response = get("/assets/a.js", "Accept-Encoding: gzip, br\r\n");

  EXPECT_NE(response.find("Content-Encoding: gzip"), std::string::npos) << response;
  EXPECT_NE(response.find("immutable"), std::string::npos);
  EXPECT_NE(response.find("\r\n\r\nsqueezed"), std::string::npos);
}

TEST_F(HttpServerTest, WhenTheBrowserHasTheFile_ThenNoBodyIsSent) {
  const std::string response = get("/", "If-None-Match: \"e1\"\r\n");

  EXPECT_NE(response.find("HTTP/1.1 304"), std::string::npos) << response;
  EXPECT_EQ(response.find("<html>"), std::string::npos);
}

TEST_F(HttpServerTest, WhenErrorsAreAnswered_ThenTheyCarryTheSafetyHeadersToo) {
  const std::string response = get("/nothing");

  EXPECT_NE(response.find("HTTP/1.1 404"), std::string::npos) << response;
  EXPECT_NE(response.find("nosniff"), std::string::npos);
}

TEST_F(HttpServerTest, WhenThePortIsTaken_ThenListeningFailsWithAHint) {
  const auto second = HttpServer::listen({"127.0.0.1", server_->port()}, kAssets, feed_);

  ASSERT_FALSE(second);
  EXPECT_EQ(second.error()[0].code, "H0001");
  EXPECT_NE(second.error()[0].message.find(std::to_string(server_->port())), std::string::npos);
  EXPECT_NE(second.error()[0].hint.find("--port"), std::string::npos);
}

TEST_F(HttpServerTest, WhenTheAddressIsNotOfThisMachine_ThenListeningFails) {
  const auto other = HttpServer::listen({"203.0.113.7", 0}, kAssets, feed_);

  ASSERT_FALSE(other);
  EXPECT_EQ(other.error()[0].code, "H0002");
}

TEST_F(HttpServerTest, WhenAViewerConnects_ThenItIsGreetedAndFollowsTheFeed) {
  publish(1);
  RawConnection viewer(server_->port());
  viewer.send(upgrade_request());
  EXPECT_NE(viewer.read_until("\r\n\r\n").find("101"), std::string::npos);

  EXPECT_EQ(json::parse(*viewer.read_frame())["type"], "hello");
  viewer.send_text(kBegin);
  EXPECT_EQ(json::parse(*viewer.read_frame())["scan"], 1);
  publish(2);
  const json delta = json::parse(*viewer.read_frame());
  EXPECT_EQ(delta["type"], "delta");
  EXPECT_EQ(delta["scan"], 2);
}

TEST_F(HttpServerTest, WhenAForeignPageConnects_ThenItIsRefused) {
  RawConnection viewer(server_->port());
  viewer.send(upgrade_request("Origin: http://evil.example\r\n"));

  EXPECT_NE(viewer.read_all().find("HTTP/1.1 403"), std::string::npos);
}

TEST_F(HttpServerTest, WhenAViewerSaysWhatNobodyUnderstands_ThenItIsDisconnected) {
  for (const std::string_view text : {"hi", "{}", R"({"type":"show","number":1})"}) {
    RawConnection viewer(server_->port());
    viewer.send(upgrade_request());
    viewer.read_until("\r\n\r\n");
    viewer.send_text(text);

    EXPECT_EQ(read_close(viewer), "close 1008") << text;
  }
}

TEST_F(HttpServerTest, WhenAViewerNeverBegins_ThenItIsGreetedAndDisconnected) {
  end();
  start({.viewer_begins = std::chrono::seconds(0)});
  RawConnection viewer(server_->port());
  viewer.send(upgrade_request());
  viewer.read_until("\r\n\r\n");
  EXPECT_EQ(json::parse(*viewer.read_frame())["type"], "hello");
  publish(1);

  EXPECT_EQ(read_close(viewer), "close 1008");
}

TEST_F(HttpServerTest, WhenAViewerSendsBytesInsteadOfText_ThenItIsDisconnected) {
  RawConnection viewer(server_->port());
  viewer.send(upgrade_request());
  viewer.read_until("\r\n\r\n");
  viewer.send(std::string("\x82\x82\0\0\0\0{}", 8));

  EXPECT_EQ(read_close(viewer), "close 1008");
}

TEST_F(HttpServerTest, WhenAViewerSaysTooMuchAtOnce_ThenItIsDisconnected) {
  RawConnection viewer(server_->port());
  viewer.send(upgrade_request());
  viewer.read_until("\r\n\r\n");
  viewer.send_text(kBegin);
  // Many times what is allowed at once and in the time that this takes.
  for (int i = 1; i < 400; ++i) viewer.send_text(R"({"type":"show","number":)" + std::to_string(i) + "}");

  EXPECT_EQ(read_close(viewer), "close 1008");
}

TEST_F(HttpServerTest, WhenAViewerChangesItsChoice_ThenTheAnswerComesAtOnce) {
  publish(1, 5);
  RawConnection viewer(server_->port());
  viewer.send(upgrade_request());
  viewer.read_until("\r\n\r\n");
  viewer.send_text(R"({"type":"begin","protocol":5,"show":{"number":1}})");
  json message = json::object();
  while (message.value("type", "") != "state") message = json::parse(*viewer.read_frame());
  EXPECT_EQ(message["tags"], json::object());
  viewer.send_text(R"({"type":"show","number":2,"tags":"all"})");

  const json answer = json::parse(*viewer.read_frame());
  EXPECT_EQ(answer["show"], 2);
  EXPECT_EQ(answer["tags"].size(), 5u);
}

TEST_F(HttpServerTest, WhenAViewerSendsTooMuch_ThenItIsDisconnected) {
  RawConnection viewer(server_->port());
  viewer.send(upgrade_request());
  viewer.read_until("\r\n\r\n");
  viewer.send(std::string("\x81\xff\x7f\xff\xff\xff\xff\xff\xff\xff\0\0\0\0", 14));  // 2^63 bytes announced

  EXPECT_EQ(read_close(viewer), "close 1009");
}

TEST_F(HttpServerTest, WhenAViewerIsSlow_ThenItSkipsStatesAndEndsUpWithTheNewest) {
  constexpr std::uint64_t kUpdates = 250;
  RawConnection viewer(server_->port(), 4'096);
  viewer.send(upgrade_request());
  viewer.read_until("\r\n\r\n");
  viewer.send_text(kBegin);
  // 250 messages of 50 kB are far more than the sockets between them hold.
  for (std::uint64_t scan = 1; scan <= kUpdates; ++scan) publish(scan, 5'000);

  std::uint64_t received = 0;
  std::uint64_t newest = 0;
  while (newest != kUpdates) {
    const auto frame = viewer.read_frame();
    ASSERT_TRUE(frame.has_value());
    const json message = json::parse(*frame);
    if (!message.contains("scan")) continue;
    ++received;
    newest = message["scan"];
  }
  EXPECT_LT(received, kUpdates / 2);
}

TEST_F(HttpServerTest, WhenBytesAreNoRequest_ThenTheServerLivesOn) {
  const std::string host = "Host: localhost:" + std::to_string(server_->port()) + "\r\n";
  const std::vector<std::string> corpus = {
      "\r\n\r\n",
      "GET\r\n\r\n",
      "GET / HTTP/9.9\r\n" + host + "\r\n",
      "GET / HTTP/1.1\r\n\r\n",
      "GET / HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n",
      "GET / HTTP/1.1\r\n" + host + "Content-Length: 99999999999999999999\r\n\r\n",
      "GET / HTTP/1.1\r\n" + host + "Content-Length: -1\r\n\r\n",
      "GET / HTTP/1.1\r\n" + host + "Content-Length: 5\r\n\r\nhello",
      "GET / HTTP/1.1\r\n" + host + "Transfer-Encoding: chunked\r\n\r\nfffffffff\r\n",
      "GET / HTTP/1.1\r\n" + host + "X: " + std::string(20'000, 'x') + "\r\n\r\n",
      "GET /" + std::string(20'000, 'x') + " HTTP/1.1\r\n" + host + "\r\n",
      "GET /live HTTP/1.1\r\n" + host + "Upgrade: websocket\r\nConnection: Upgrade\r\n\r\n",
      "GET /live HTTP/1.1\r\n" + host +
          "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: "
          "x\r\n\r\n",
      std::string("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 11),  // a TLS greeting
      std::string(100, '\0'),
      std::string(70'000, 'A'),
  };
  for (const std::string& bytes : corpus) {
    RawConnection connection(server_->port());
    connection.send(bytes);
    connection.end_of_input();
    const std::string response = connection.read_all();
    EXPECT_EQ(response.find("HTTP/1.1 200"), std::string::npos) << bytes.substr(0, 60);
  }
  EXPECT_NE(get("/").find("HTTP/1.1 200"), std::string::npos);
}

TEST_F(HttpServerTest, WhenTooManyConnect_ThenTheSurplusIsClosedAndOthersAreServedAfterwards) {
  end();
  start({.connections = 2});
  {
    RawConnection first(server_->port());
    first.send(upgrade_request());
    first.read_until("\r\n\r\n");
    RawConnection second(server_->port());
    second.send(upgrade_request());
    second.read_until("\r\n\r\n");

    EXPECT_EQ(get("/"), "");
  }
  // The two are gone as soon as the server has seen it.
  std::string response;
  for (int attempt = 0; attempt < 1'000 && response.empty(); ++attempt) response = get("/");
  EXPECT_NE(response.find("HTTP/1.1 200"), std::string::npos);
}

// More of them than there are places, and the page comes all the same.
TEST_F(HttpServerTest, WhenSocketsSayNothing_ThenTheyMakeRoomForThoseWhoDo) {
  end();
  start({.connections = 4});
  std::vector<std::unique_ptr<RawConnection>> silent;
  for (int i = 0; i < 12; ++i) {
    silent.push_back(std::make_unique<RawConnection>(server_->port()));
    if (i % 2 == 0) silent.back()->send("GET / HTTP/1.1\r\nHost:");
  }
  for (int i = 0; i < 20; ++i) EXPECT_NE(get("/").find("HTTP/1.1 200"), std::string::npos) << i;
}

TEST_F(HttpServerTest, WhenOneAddressOpensManyPages_ThenTheyAreBoundedAndOthersStillComeIn) {
  end();
  start({.connections = 6, .viewers = 4, .viewers_of_one = 3});
  std::vector<std::unique_ptr<RawConnection>> pages;
  for (int i = 0; i < 3; ++i) {
    pages.push_back(std::make_unique<RawConnection>(server_->port()));
    pages.back()->send(upgrade_request());
    EXPECT_NE(pages.back()->read_until("\r\n\r\n").find("101"), std::string::npos);
  }
  RawConnection surplus(server_->port());
  surplus.send(upgrade_request());
  EXPECT_NE(surplus.read_all().find("HTTP/1.1 503"), std::string::npos);
  EXPECT_NE(get("/").find("HTTP/1.1 200"), std::string::npos);
}

// Behind a proxy the second one may be read as another place.
TEST_F(HttpServerTest, WhenARequestHasTwoHosts_ThenItIsRefused) {
  EXPECT_NE(get("/", "Host: elsewhere\r\n").find("HTTP/1.1 400"), std::string::npos);
}

}  // namespace
}  // namespace stepwright::server
