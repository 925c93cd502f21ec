#pragma once

// A TCP connection to a loopback port that sends exactly the bytes it is given: for requests that no client
// library would send. Blocking, with a limit of 10 s on every read.

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace stepwright::server {

class RawConnection {
 public:
  explicit RawConnection(std::uint16_t port, int receive_buffer = 0)
      : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    const timeval limit{10, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
    ::setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof limit);
    if (receive_buffer > 0)
      ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ = ::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
  }
  ~RawConnection() { ::close(socket_); }
  RawConnection(const RawConnection&) = delete;
  RawConnection& operator=(const RawConnection&) = delete;

  bool connected() const { return connected_; }
  bool send(std::string_view bytes) {
    return ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
  }
  // A text frame as a browser sends it, masked with zeros.
  bool send_text(std::string_view text) {
    std::string frame = "\x81";
    if (text.size() < 126) {
      frame += static_cast<char>(0x80 | text.size());
    } else {
      frame += '\xfe';
      frame += static_cast<char>(text.size() >> 8 & 0xff);
      frame += static_cast<char>(text.size() & 0xff);
    }
    return send(frame + std::string(4, '\0') + std::string(text));
  }
  void end_of_input() { ::shutdown(socket_, SHUT_WR); }

  // All that comes until the other side closes.
  std::string read_all() {
    while (fill()) {
    }
    return std::move(input_);
  }

  // Up to and with `mark`; what follows stays for the next read.
  std::string read_until(std::string_view mark) {
    while (input_.find(mark) == std::string::npos && fill()) {
    }
    const auto at = input_.find(mark);
    return take(at == std::string::npos ? input_.size() : at + mark.size());
  }

  // The payload of the next WebSocket frame of a server (unmasked); none if the connection ended. The text of
  // a close frame is its status code.
  std::optional<std::string> read_frame() {
    if (!need(2)) return std::nullopt;
    const bool is_close = (input_[0] & 0x0f) == 8;
    std::size_t length = static_cast<unsigned char>(input_[1]) & 0x7f;
    std::size_t header = 2;
    const std::size_t extra = length == 126 ? 2 : length == 127 ? 8 : 0;
    if (extra > 0) {
      if (!need(2 + extra)) return std::nullopt;
      length = 0;
      for (std::size_t i = 0; i < extra; ++i)
        length = length << 8 | static_cast<unsigned char>(input_[2 + i]);
      header += extra;
    }
    if (!need(header + length)) return std::nullopt;
    take(header);
    const std::string payload = take(length);
    if (!is_close || payload.size() < 2) return payload;
    return "close " + std::to_string(static_cast<unsigned char>(payload[0]) << 8 |
                                     static_cast<unsigned char>(payload[1]));
  }

 private:
  bool fill() {
    char buffer[4096];
    const ssize_t count = ::recv(socket_, buffer, sizeof buffer, 0);
    if (count <= 0) return false;
    input_.append(buffer, static_cast<std::size_t>(count));
    return true;
  }
  bool need(std::size_t bytes) {
    while (input_.size() < bytes) {
      if (!fill()) return false;
    }
    return true;
  }
  std::string take(std::size_t bytes) {
    std::string front = input_.substr(0, bytes);
    input_.erase(0, bytes);
    return front;
  }

  int socket_;
  bool connected_ = false;
  std::string input_;
};

}  // namespace stepwright::server
