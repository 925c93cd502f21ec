#pragma once

// The plant's side of the step protocol in C++, for the processes of this tree that are plants: of an FMU, of
// a program in ST. Other languages do the same after plant_models/doc/shared_plant.md.
//
//   auto peer = StepPeer::open();
//   ... find the terminals by peer->area().names(), set the first sensors ...
//   return peer->serve([&](std::int64_t time_ns, std::int64_t step_ns) { ...; return std::string(); });
//
// Threads: one.

#include <cstdint>
#include <functional>
#include <string>

#include "plant_models/stepped/step_area.h"

namespace stepwright::stepped {

class StepPeer {
 public:
  // The area and the socket that a plant is started with; others for tests. Fails as StepArea::attach.
  [[nodiscard]] static result::Result<StepPeer> open(int socket = kPeerSocket, int area = kPeerArea);

  StepArea& area() { return area_; }
  // One step: simulated time at its end, its length, both in ns. What has failed, or nothing.
  using Step = std::function<std::string(std::int64_t, std::int64_t)>;
  // Says that the plant is ready and makes steps until the runtime ends, or a step fails. The exit code.
  int serve(const Step& step);
  // The plant cannot run at all, and why. The exit code.
  int refuse(std::string_view why);

 private:
  StepPeer(StepArea area, int socket) : area_(std::move(area)), socket_(socket) {}
  bool answer() const;

  StepArea area_;
  int socket_;
};

}  // namespace stepwright::stepped
