#pragma once

// Client of QEMU's GDB stub (GDB manual, appendix E), as far as the tests need it: memory of the board, read
// and written while it stands still; it runs on when the stub is let go. One thread.

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace stepwright::firmware_test {

class GdbStub {
 public:
  // The board stands still from here on.
  explicit GdbStub(const std::filesystem::path& socket) : descriptor_(::socket(AF_UNIX, SOCK_STREAM, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    socket.string().copy(address.sun_path, sizeof(address.sun_path) - 1);
    if (::connect(descriptor_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0)
      throw std::runtime_error("no GDB stub at " + socket.string());
    timeval patience{10, 0};
    ::setsockopt(descriptor_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
  }
  ~GdbStub() {
    try {
      ask("D");
    } catch (const std::runtime_error&) {
      std::fputs("the GDB stub was lost\n", stderr);
    }
    ::close(descriptor_);
  }
  GdbStub(const GdbStub&) = delete;
  GdbStub& operator=(const GdbStub&) = delete;

  std::vector<std::uint8_t> read(std::uint32_t address, std::uint32_t bytes) {
    char request[32];
    std::snprintf(request, sizeof(request), "m%x,%x", address, bytes);
    const std::string answer = ask(request);
    std::vector<std::uint8_t> out;
    for (std::size_t i = 0; i + 1 < answer.size(); i += 2)
      out.push_back(static_cast<std::uint8_t>(std::stoul(answer.substr(i, 2), nullptr, 16)));
    return out;
  }

  void write16(std::uint32_t address, std::uint16_t value) {
    char request[32];
    std::snprintf(request, sizeof(request), "M%x,2:%02x%02x", address, value & 0xFFu,
                  static_cast<unsigned>(value >> 8));
    if (ask(request) != "OK") throw std::runtime_error("the memory cannot be written");
  }

 private:
  // $text#sum, acknowledged by +.
  std::string ask(const std::string& text) {
    unsigned sum = 0;
    for (const char c : text) sum += static_cast<unsigned char>(c);
    char tail[4];
    std::snprintf(tail, sizeof(tail), "#%02x", sum & 0xFF);
    const std::string packet = "$" + text + tail;
    if (::write(descriptor_, packet.data(), packet.size()) != static_cast<ssize_t>(packet.size()))
      throw std::runtime_error("the GDB stub is gone");
    // The stub tells unasked that the board has stopped.
    std::string answer = packet_of();
    while (answer.starts_with("T")) answer = packet_of();
    return answer;
  }
  std::string packet_of() {
    std::string answer;
    while (next() != '$') {
    }
    for (char c = next(); c != '#'; c = next()) answer += c;
    next();
    next();
    static_cast<void>(::write(descriptor_, "+", 1) == 1);
    return answer;
  }
  char next() {
    char c = 0;
    if (::read(descriptor_, &c, 1) != 1) throw std::runtime_error("the GDB stub is silent");
    return c;
  }

  int descriptor_;
};

}  // namespace stepwright::firmware_test
