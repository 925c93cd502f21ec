#include "runtime/service/connection.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <random>
#include <utility>

#include "runtime/ground/files/descriptor.h"
#include "runtime/host/limits.h"
#include "runtime/service/codec.h"
#include "runtime/service/digest.h"

namespace stepwright::service {
namespace {

using files::Descriptor;
using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kGreetingTimeout{5'000};  // of a machine with much else to do
// A service that does not take a connection or a message for so long is taken for dead.
constexpr timeval kSendTimeout{1, 0};
constexpr std::size_t kReadBytes = 64u << 10;

tl::unexpected<result::Diagnostics> failed(const std::filesystem::path& path, const std::string& message,
                                           const char* hint = "is the runtime of this cell running?") {
  return result::fail("R0001", {path.string(), 0, 0}, message, hint);
}

tl::unexpected<result::Diagnostics> not_served(const std::filesystem::path& path, int reason) {
  const std::string message = std::string("nobody serves the socket: ") + std::strerror(reason);
  if (reason == EACCES || reason == EPERM)
    return failed(path, message, "be the user who runs the cell, or root");
  return failed(path, message);
}

int remaining_ms(Clock::time_point deadline) {
  const auto left = std::chrono::ceil<milliseconds>(deadline - Clock::now());
  return static_cast<int>(std::max(left, milliseconds(0)).count());
}

// Receives bytes and, beside them, at most one descriptor.
ssize_t receive_bytes(int socket, std::span<std::byte> buffer, Descriptor& passed) {
  iovec part{buffer.data(), buffer.size()};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  const ssize_t count = ::recvmsg(socket, &message, MSG_CMSG_CLOEXEC | MSG_DONTWAIT);
  if (count < 0) return count;
  for (cmsghdr* header = CMSG_FIRSTHDR(&message); header != nullptr; header = CMSG_NXTHDR(&message, header)) {
    if (header->cmsg_level != SOL_SOCKET || header->cmsg_type != SCM_RIGHTS) continue;
    int descriptor = -1;
    std::memcpy(&descriptor, CMSG_DATA(header), sizeof descriptor);
    passed = Descriptor(descriptor);
  }
  return count;
}

}  // namespace

struct Connection::State {
  Descriptor socket;
  FrameBuffer in;
  Descriptor passed;
  std::unique_ptr<host::SnapshotReader> snapshots;
  std::deque<Message> kept;
  bool closed = false;
  std::uint64_t client = 0;
  std::uint64_t last_id = 0;
};

Connection::Connection(std::unique_ptr<State> state) : state_(std::move(state)) {}
Connection::~Connection() = default;

result::Result<std::unique_ptr<Connection>> Connection::open(const std::filesystem::path& path,
                                                             const ConnectionOptions& options) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.native().size() >= sizeof address.sun_path)
    return failed(path, "the path of the socket is too long");
  std::memcpy(address.sun_path, path.c_str(), path.native().size());
  auto state = std::make_unique<State>();
  std::random_device random;
  state->client = (std::uint64_t{random()} << 32 | random()) | 1u;
  state->socket = Descriptor(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  // It bounds the wait for a service that hangs with a full queue of connections, too.
  ::setsockopt(state->socket.get(), SOL_SOCKET, SO_SNDTIMEO, &kSendTimeout, sizeof kSendTimeout);
  if (!state->socket.ok() ||
      ::connect(state->socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    return not_served(path, errno);
  }
  std::unique_ptr<Connection> self(new Connection(std::move(state)));
  Hello hello;
  hello.role = options.role;
  hello.name = options.name.substr(0, host::kMaxNameBytes);
  hello.first_event = options.first_event;
  self->send(hello);
  const auto answer = self->receive(kGreetingTimeout);
  const auto* welcome = answer ? std::get_if<Welcome>(&*answer) : nullptr;
  if (welcome == nullptr) {
    return failed(path, "the service does not answer the greeting of version " +
                            std::to_string(kProtocolVersion) + " of its protocol");
  }
  if (welcome->version != kProtocolVersion) {
    return result::fail("R0001", {path.string(), 0, 0},
                        "the runtime speaks version " + std::to_string(welcome->version) +
                            " of the service's protocol, and this program version " +
                            std::to_string(kProtocolVersion),
                        "both have to be of the same version of Stepwright");
  }
  auto snapshots = host::SnapshotReader::open(self->state_->passed.get());
  if (!snapshots) return result::forward(snapshots);
  self->state_->snapshots = std::move(*snapshots);
  return self;
}

int Connection::descriptor() const {
  return state_->socket.get();
}
bool Connection::closed() const {
  return state_->closed;
}

bool Connection::send(const Message& message) {
  std::vector<std::byte> bytes;
  return encode(message, bytes) && pass_on(bytes);
}

bool Connection::pass_on(std::span<const std::byte> message) {
  if (state_->closed) return false;
  std::vector<std::byte> frame;
  append_frame(message, frame);
  std::size_t sent = 0;
  while (sent < frame.size()) {
    const ssize_t count =
        ::send(state_->socket.get(), frame.data() + sent, frame.size() - sent, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      state_->closed = true;
      return false;
    }
    sent += static_cast<std::size_t>(count);
  }
  return true;
}

std::optional<Message> Connection::receive(milliseconds timeout) {
  if (!state_->kept.empty()) {
    Message message = std::move(state_->kept.front());
    state_->kept.pop_front();
    return message;
  }
  return receive_new(timeout);
}

std::optional<Message> Connection::receive_new(milliseconds timeout) {
  const auto deadline = Clock::now() + timeout;
  std::array<std::byte, kReadBytes> buffer;
  while (true) {
    auto body = state_->in.next();
    if (body && *body) {
      if (auto message = decode(**body)) return std::move(*message);
      state_->closed = true;
    } else if (!body) {
      state_->closed = true;
    }
    if (state_->closed) return std::nullopt;
    pollfd entry{state_->socket.get(), POLLIN, 0};
    const int ready = poll(&entry, 1, remaining_ms(deadline));
    if (ready == 0) return std::nullopt;
    const ssize_t count = receive_bytes(state_->socket.get(), buffer, state_->passed);
    if (count > 0) {
      state_->in.append(std::span(buffer).first(static_cast<std::size_t>(count)));
    } else if (count == 0 || (errno != EAGAIN && errno != EINTR)) {
      state_->closed = true;
    }
  }
}

std::optional<host::Snapshot> Connection::snapshot() const {
  return state_->snapshots->read();
}

const host::SnapshotReader& Connection::snapshots() const {
  return *state_->snapshots;
}

result::Result<Reply> Connection::call(RequestBody body, milliseconds timeout) {
  const auto deadline = Clock::now() + timeout;
  const std::uint64_t id = ++state_->last_id;
  send(Request{state_->client, id, std::move(body)});
  while (auto message = receive_new(milliseconds(remaining_ms(deadline)))) {
    auto* reply = std::get_if<Reply>(&*message);
    if (reply == nullptr || reply->client != state_->client || reply->id != id) {
      state_->kept.push_back(std::move(*message));
      continue;
    }
    if (!reply->accepted()) return tl::unexpected(std::move(reply->problems));
    return std::move(*reply);
  }
  return result::fail("R0001", {},
                      state_->closed ? "the runtime ended the connection" : "the runtime does not answer");
}

result::Result<std::string> Connection::download(std::span<const std::byte> container, milliseconds timeout) {
  auto reply = download(container, host::DownloadMode::Replace, timeout);
  if (!reply) return result::forward(reply);
  return std::move(reply->digest);
}

result::Result<Reply> Connection::download(std::span<const std::byte> container, host::DownloadMode mode,
                                           milliseconds timeout) {
  const Sha256 digest = sha256(container);
  auto reply = call(DownloadBegin{container.size(), digest}, timeout);
  for (std::size_t at = 0; reply && at < container.size(); at += host::kMaxChunkBytes) {
    const auto part = container.subspan(at, std::min(host::kMaxChunkBytes, container.size() - at));
    reply = call(DownloadChunk{at, {part.begin(), part.end()}}, timeout);
  }
  if (reply) reply = call(DownloadCommit{container.size(), digest, mode}, timeout);
  return reply;
}

}  // namespace stepwright::service
