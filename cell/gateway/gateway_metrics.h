#pragma once

// The figures of a gateway for Prometheus: those of the controller as of any runtime (runtime/metrics), and
// those of its line.
//
//   GatewayFigures figures("bench");
//   figures.publish(runtime.figures());            // the service's thread
//   const std::string text = figures.text();       // any other

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "cell/gateway/follow_plan.h"
#include "runtime/host/messages.h"
#include "runtime/remote/line_queues.h"

namespace stepwright::gateway {

class GatewayFigures {
 public:
  explicit GatewayFigures(std::string runtime) : runtime_(std::move(runtime)) {}

  // Service's thread. As the service tells it, with the figures of the process.
  void publish(const host::RuntimeStatus& status);
  void publish(const remote::RemoteFigures& line);
  // Of a plan that is followed on a controller whose program was loaded by hand, which is no runtime.
  void publish(const FollowStatus& follow, std::size_t actions);
  // Text exposition format 0.0.4; any thread. runtime/doc/gateway.md lists what is not of a runtime.
  std::string text() const;

 private:
  struct Line {
    bool contact = false;
    std::uint64_t repeated = 0;
    std::uint64_t losses = 0;
  };
  struct Plan {
    std::size_t actions = 0;
    std::size_t started = 0;
  };
  const std::string runtime_;
  mutable std::mutex mutex_;
  std::optional<host::RuntimeStatus> status_;  // none before a controller was found
  Line line_;
  std::optional<Plan> plan_;
};

}  // namespace stepwright::gateway
