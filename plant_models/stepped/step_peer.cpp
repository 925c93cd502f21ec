#include "plant_models/stepped/step_peer.h"

#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>

namespace stepwright::stepped {

result::Result<StepPeer> StepPeer::open(int socket, int area) {
  auto attached = StepArea::attach(area);
  if (!attached) return result::forward(attached);
  return StepPeer(std::move(*attached), socket);
}

bool StepPeer::answer() const {
  return send(socket_, &kReadyByte, 1, MSG_NOSIGNAL) == 1;
}

int StepPeer::refuse(std::string_view why) {
  area_.set_message(why);
  StepHeader& header = area_.header();
  header.peer_version.store(kStepVersion, std::memory_order_relaxed);
  header.status.store(static_cast<std::uint32_t>(PeerStatus::Failed), std::memory_order_release);
  static_cast<void>(answer());
  return 1;
}

int StepPeer::serve(const Step& step) {
  StepHeader& header = area_.header();
  header.peer_version.store(kStepVersion, std::memory_order_release);
  if (!answer()) return 0;
  for (;;) {
    char byte = 0;
    const ssize_t got = recv(socket_, &byte, 1, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got != 1) return 0;  // the runtime has ended
    const std::uint64_t count = header.step.load(std::memory_order_acquire);
    const std::string failed =
        step(header.time_ns.load(std::memory_order_relaxed), header.step_ns.load(std::memory_order_relaxed));
    if (!failed.empty()) return refuse(failed);
    header.done.store(count, std::memory_order_release);
    if (!answer()) return 0;
  }
}

}  // namespace stepwright::stepped
