#include "cell/device_status/status_socket.h"

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <memory>
#include <utility>

namespace stepwright::device_status {
namespace {

constexpr int kWaiting = 8;
constexpr timeval kPatience{1, 0};  // for a reader that does not read, and a server that does not write
constexpr std::chrono::seconds kMostOfAnAnswer{3};  // for one that reads drop by drop
constexpr std::chrono::milliseconds kPause{50};

tl::unexpected<result::Diagnostics> failed(const std::filesystem::path& path, const std::string& what,
                                           const std::string& hint) {
  return result::fail("R0127", {path.string(), 0, 0}, what + ": " + std::strerror(errno), hint);
}

sockaddr_un address_of(const std::filesystem::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
  return address;
}

int make_socket() {
  return socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
}

void write_all(int client, const std::string& text) {
  setsockopt(client, SOL_SOCKET, SO_SNDTIMEO, &kPatience, sizeof kPatience);
  const auto deadline = std::chrono::steady_clock::now() + kMostOfAnAnswer;
  std::size_t sent = 0;
  while (sent < text.size() && std::chrono::steady_clock::now() < deadline) {
    const ssize_t count = send(client, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
    if (count <= 0) return;
    sent += static_cast<std::size_t>(count);
  }
}

}  // namespace

result::Result<std::unique_ptr<StatusServer>> StatusServer::create(const std::filesystem::path& path,
                                                                   std::function<std::string()> text) {
  const char* const hint = "is the state folder of the cell one that this user may write to?";
  const int listener = make_socket();
  if (listener < 0) return failed(path, "no socket for the status", hint);
  const sockaddr_un address = address_of(path);
  unlink(path.c_str());  // the lock of the I/O area says that there is no other client
  const mode_t before = umask(0177);
  const int bound = bind(listener, reinterpret_cast<const sockaddr*>(&address), sizeof address);
  umask(before);
  if (bound != 0 || listen(listener, kWaiting) != 0) {
    auto why = failed(path, "no socket for the status", hint);
    close(listener);
    return why;
  }
  return std::unique_ptr<StatusServer>(new StatusServer(path, listener, std::move(text)));
}

StatusServer::StatusServer(std::filesystem::path path, int listener, std::function<std::string()> text)
    : path_(std::move(path)), listener_(listener), text_(std::move(text)), thread_([this] { serve(); }) {}

StatusServer::~StatusServer() {
  ends_ = true;
  shutdown(listener_, SHUT_RDWR);  // wakes the thread
  thread_.join();
  close(listener_);
  unlink(path_.c_str());
}

void StatusServer::serve() {
  while (true) {
    const int client = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
    if (ends_) {
      if (client >= 0) close(client);
      return;
    }
    if (client < 0) {
      // Who asked has gone again; or there is no descriptor, until others are closed.
      if (errno != EINTR && errno != ECONNABORTED) std::this_thread::sleep_for(kPause);
      continue;
    }
    write_all(client, text_());
    close(client);
  }
}

result::Result<std::string> ask_status(const std::filesystem::path& path) {
  const int server = make_socket();
  const sockaddr_un address = address_of(path);
  if (server < 0 || connect(server, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    auto why = failed(path, "no Modbus client answers", "does `stepwright modbus-client` of this cell run?");
    if (server >= 0) close(server);
    return why;
  }
  setsockopt(server, SOL_SOCKET, SO_RCVTIMEO, &kPatience, sizeof kPatience);
  std::string text;
  std::array<char, 16'384> part;
  ssize_t count = 0;
  while ((count = recv(server, part.data(), part.size(), 0)) > 0)
    text.append(part.data(), static_cast<std::size_t>(count));
  close(server);
  if (count < 0) return failed(path, "the Modbus client does not answer", "");
  return text;
}

}  // namespace stepwright::device_status
