#include "hmi_web/notify/curl_sender.h"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>
#include <string_view>
#include <thread>

#include "hmi_web/notify/codes.h"

namespace stepwright::notify {
namespace {

// A port of this machine for one client.
class Listener {
 public:
  Listener() : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    EXPECT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&address), size), 0);
    EXPECT_EQ(listen(socket_, 1), 0);
    EXPECT_EQ(getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size), 0);
    port_ = ntohs(address.sin_port);
  }
  ~Listener() { close(socket_); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  int accept_client() const { return accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC); }
  std::string port() const { return std::to_string(port_); }

 private:
  int socket_;
  std::uint16_t port_ = 0;
};

// A web hook that answers one request with `status`, and goes on to talk until nobody listens any more.
class EndlessServer {
 public:
  explicit EndlessServer(std::string_view status)
      : thread_([this, head = "HTTP/1.1 " + std::string(status) + "\r\n\r\n"] { talk(head); }) {}
  ~EndlessServer() { thread_.join(); }
  EndlessServer(const EndlessServer&) = delete;
  EndlessServer& operator=(const EndlessServer&) = delete;

  std::string address() const { return "http://127.0.0.1:" + listener_.port() + "/"; }

 private:
  void talk(const std::string& head) const {
    const int client = listener_.accept_client();
    std::string text = head;
    while (send(client, text.data(), text.size(), MSG_NOSIGNAL) > 0) text.assign(4'096, 'x');
    close(client);
  }

  Listener listener_;
  std::thread thread_;  // last, as it uses the others
};

// A mail server that takes one connection and answers each command, `refused` ones with `refusal`.
class MailServer {
 public:
  MailServer(std::string_view refused, std::string_view refusal)
      : refused_(refused), refusal_(refusal), thread_([this] { talk(); }) {}
  ~MailServer() { thread_.join(); }
  MailServer(const MailServer&) = delete;
  MailServer& operator=(const MailServer&) = delete;

  std::string address() const { return "smtp://127.0.0.1:" + listener_.port(); }

 private:
  std::string answer_to(const std::string& line) const {
    if (line.starts_with(refused_)) return refusal_;
    if (line.starts_with("DATA")) return "354 go on\r\n";
    return line.starts_with("QUIT") ? "221 bye\r\n" : "250 fine\r\n";
  }
  void talk() const {
    const int client = listener_.accept_client();
    const auto say = [client](const std::string& text) {
      send(client, text.data(), text.size(), MSG_NOSIGNAL);
    };
    say("220 mail\r\n");
    std::string line;
    bool data = false;
    for (char c = 0; recv(client, &c, 1, 0) == 1;) {
      line += c;
      if (!line.ends_with("\r\n")) continue;
      if (!data || line == ".\r\n") say(answer_to(line));
      data = data ? line != ".\r\n" : line.starts_with("DATA") && !line.starts_with(refused_);
      line.clear();
    }
    close(client);
  }

  Listener listener_;
  std::string refused_;
  std::string refusal_;
  std::thread thread_;  // last, as it uses the others
};

std::string refusal_of(std::string_view refused, std::string_view refusal) {
  CurlSender sender;
  const MailServer server(refused, refusal);
  Channel channel;
  channel.name = "shift";
  channel.server = server.address();
  channel.from = "line@plant.example";
  channel.to = {"a@plant.example"};
  channel.needs_tls = false;
  const auto sent = sender.send(channel, Message{"s", "t\n", "{}"}, {});
  return sent ? "sent" : sent.error().front().code + " " + sent.error().front().message;
}

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

TEST(CurlSender, WhenAMailServerRefuses_ThenItsOwnWordsAreTold) {
  using testing::HasSubstr;
  EXPECT_EQ(refusal_of("nothing", ""), "sent");
  EXPECT_THAT(refusal_of("RCPT", "550 5.1.1 no such user\r\n"),
              AllOf(HasSubstr("H0085 "), HasSubstr("the server said \"550 5.1.1 no such user\"")));
  EXPECT_THAT(refusal_of("RCPT", "550-no such user\r\n550 here\r\n"), HasSubstr("\"550-no such user here\""));
  EXPECT_THAT(refusal_of(".\r\n", "452 4.3.1 full\r\n"), HasSubstr("\"452 4.3.1 full\""));
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
