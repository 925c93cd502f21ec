#include "runtime/service/internal/listener.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace stepwright::service::internal {
namespace {

constexpr int kBacklog = 8;

tl::unexpected<result::Diagnostics> refused(const std::filesystem::path& path, const std::string& message,
                                            const std::string& hint) {
  return result::fail("R0001", {path.string(), 0, 0}, message, hint);
}

tl::unexpected<result::Diagnostics> failed(const std::filesystem::path& path, const char* what) {
  return refused(path, std::string(what) + ": " + std::strerror(errno), "");
}

}  // namespace

Listener::Listener(std::filesystem::path path, Descriptor lock, Descriptor socket)
    : path_(std::move(path)), lock_(std::move(lock)), socket_(std::move(socket)) {}

Listener::~Listener() {
  if (socket_.ok()) ::unlink(path_.c_str());
}

result::Result<Listener> Listener::bind(const std::filesystem::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.native().size() >= sizeof address.sun_path) {
    return refused(
        path,
        "the path of the socket is longer than " + std::to_string(sizeof address.sun_path - 1) + " bytes",
        "choose a shorter state_dir in [cell]");
  }
  std::memcpy(address.sun_path, path.c_str(), path.native().size());

  // The lock goes with its process, however that ends: who holds it may replace the socket that was left
  // behind.
  const std::string lock_path = path.string() + ".lock";
  Descriptor lock(::open(lock_path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600));
  if (!lock.ok()) return failed(path, "the lock beside the socket cannot be opened");
  if (::flock(lock.get(), LOCK_EX | LOCK_NB) != 0) {
    return refused(path, "the socket is in use: a runtime of this cell is running already",
                   "stop it, or give this cell another state_dir");
  }
  struct stat info {};
  if (::lstat(path.c_str(), &info) == 0) {
    if (!S_ISSOCK(info.st_mode)) return refused(path, "there is a file where the socket should be", "");
    ::unlink(path.c_str());
  }
  Descriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!socket.ok()) return failed(path, "no socket");
  if (::bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    return failed(path, "the socket cannot be bound");
  }
  // Nobody can connect before listen(), so that the mode holds from the first moment.
  if (::chmod(path.c_str(), 0600) != 0 || ::listen(socket.get(), kBacklog) != 0) {
    const auto error = failed(path, "the socket cannot be served");
    ::unlink(path.c_str());
    return error;
  }
  return Listener(path, std::move(lock), std::move(socket));
}

Descriptor Listener::accept() const {
  return Descriptor(::accept4(socket_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
}

}  // namespace stepwright::service::internal
