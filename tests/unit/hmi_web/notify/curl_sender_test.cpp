#include "hmi_web/notify/curl_sender.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>
#include <string_view>
#include <thread>

#include "hmi_web/notify/codes.h"

namespace stepwright::notify {
namespace {

// A web hook that answers one request with `status`, and goes on to talk until nobody listens any more.
class EndlessServer {
 public:
  explicit EndlessServer(std::string_view status)
      : listener_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    EXPECT_EQ(bind(listener_, reinterpret_cast<const sockaddr*>(&address), size), 0);
    EXPECT_EQ(listen(listener_, 1), 0);
    EXPECT_EQ(getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size), 0);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this, head = "HTTP/1.1 " + std::string(status) + "\r\n\r\n"] { talk(head); });
  }
  ~EndlessServer() {
    thread_.join();
    close(listener_);
  }
  EndlessServer(const EndlessServer&) = delete;
  EndlessServer& operator=(const EndlessServer&) = delete;

  std::string address() const { return "http://127.0.0.1:" + std::to_string(port_) + "/"; }

 private:
  void talk(const std::string& head) const {
    const int client = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
    std::string text = head;
    while (send(client, text.data(), text.size(), MSG_NOSIGNAL) > 0) text.assign(4'096, 'x');
    close(client);
  }

  int listener_;
  std::uint16_t port_ = 0;
  std::thread thread_;
};

Channel hook(const EndlessServer& server) {
  Channel channel;
  channel.name = "hook";
  channel.web_hook = server.address();
  return channel;
}

TEST(CurlSender, WhenAnAnswerHasNoEnd_ThenItsStatusCountsAndTheRestIsNotRead) {
  CurlSender sender;
  const EndlessServer server("200 OK");
  const auto sent = sender.send(hook(server), Message{"s", "t", "{}"}, {});
  EXPECT_TRUE(sent) << result::to_string(sent.error());
}

TEST(CurlSender, WhenARefusalHasNoEnd_ThenItIsARefusal) {
  CurlSender sender;
  const EndlessServer server("500 Internal Server Error");
  const auto sent = sender.send(hook(server), Message{"s", "t", "{}"}, {});
  ASSERT_FALSE(sent);
  EXPECT_EQ(sent.error().front().code, kNotSent);
  EXPECT_NE(sent.error().front().message.find("answers with status 500"), std::string::npos);
}

}  // namespace
}  // namespace stepwright::notify
