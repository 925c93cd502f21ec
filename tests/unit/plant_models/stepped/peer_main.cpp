// A plant for tests: it integrates its actuator, or does at step N what it is told to.
//   stepped_peer [HOW [N]]

#include <signal.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "plant_models/stepped/step_peer.h"

using stepwright::stepped::StepPeer;

int main(int argc, char** argv) {
  const std::string how = argc > 1 ? argv[1] : "well";
  const int when = argc > 2 ? std::atoi(argv[2]) : 1;
  if (how == "ends_at_once") return 7;
  if (how == "never_ready") pause();
  if (how == "closes_at_once") {
    close(stepwright::stepped::kPeerSocket);
    pause();
  }
  auto peer = StepPeer::open();
  if (!peer) return 1;
  if (how == "refuses") return peer->refuse("the water is cut off");
  if (how == "other_version") {
    peer->area().header().peer_version = 2;
    if (write(stepwright::stepped::kPeerSocket, "r", 1) != 1) return 1;
    pause();
  }
  auto& area = peer->area();
  double level = 0.0;
  int steps = 0;
  return peer->serve([&](std::int64_t, std::int64_t step_ns) -> std::string {
    const bool now = ++steps == when;
    if (now && how == "crashes") abort();
    if (now && how == "closes") {
      close(stepwright::stepped::kPeerSocket);
      pause();
    }
    if (now && how == "crashes_with_a_child") {
      if (fork() == 0) {  // it has the socket, too
        setsid();
        for (;;) pause();
      }
      abort();
    }
    if (now && how == "hangs") pause();
    if (now && how == "ignores_signals") {
      signal(SIGTERM, SIG_IGN);
      for (;;) pause();
    }
    if (now && how == "says_no") return "the pump is dry";
    if (now && how == "no_number") level = std::numeric_limits<double>::quiet_NaN();
    if (now && how == "shrinks" && ftruncate(stepwright::stepped::kPeerArea, 64) == 0)
      return "it could be made smaller";
    if (now && how == "answers_early") {
      if (write(stepwright::stepped::kPeerSocket, "rr", 2) != 2) return "no socket";
      pause();  // however late somebody reads it, the step is not done
    }
    if (now && how == "scribbles") {
      auto& header = area.header();
      header.magic = 0;
      header.sensors = header.actuators = {0xFFFFFFFF, 0xFFFFFFF8};
      header.area_bytes = 0;
      header.message[255] = 'x';
    }
    level += (area.actuator(0) + area.fault(0)) * static_cast<double>(step_ns) * 1e-9;
    area.set_sensor(0, level);
    area.set_sensor(1, level > 0.5 ? 1.0 : 0.0);
    area.set_value(0, 10.0 * level);
    return {};
  });
}
