#pragma once

// The other end of every RuntimeClient: what the link process publishes for a runtime and receives for it.
//
//   auto endpoint = LinkEndpoint::create({61, "link", "bench"});
//   poll on (*endpoint)->descriptor(), then:
//   (*endpoint)->clear();
//   while (auto request = (*endpoint)->take_request()) connection.pass_on(*request);
//
// Threads: any function from any thread; Fast DDS fills the queue from its own. The queue of requests is
// bounded: what does not fit is dropped, and its sender asks again; a stop goes ahead and finds room.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/dds/health.h"
#include "runtime/dds/types.h"
#include "runtime/ground/result/result.h"
#include "runtime/service/requests.h"

namespace stepwright::dds {

class LinkEndpoint {
 public:
  [[nodiscard]] static result::Result<std::unique_ptr<LinkEndpoint>> create(const ParticipantConfig& config);
  ~LinkEndpoint();

  // Readable when there may be requests or when a supervisor came or went.
  int descriptor() const;
  // Makes it unreadable until something new happens; call it before looking.
  void clear();
  // The next request of one who may ask it: the bytes of its message (runtime/service/codec.h), as they came
  // and found to be one within its bounds.
  std::optional<std::vector<std::byte>> take_request();
  // True while the supervisor that holds the runtime is heard of. Another one is refused (D0009) for as long.
  bool supervisor_alive() const;
  // Where other runtimes of this name live in the domain. They never meet this one's processes.
  std::vector<std::string> namesakes() const;

  // False if the queue towards slow readers is full: then they fetch the event again.
  bool publish_event(const StepEvent& event);
  void publish_reply(const service::Reply& reply);
  // Also the heartbeat of the link: call it at least every 80 ms, or clients take the link for dead.
  void publish_status(RuntimeStatus status, bool runtime_connected);
  void publish_snapshot(Snapshot snapshot);
  // To all of the domain: this runtime is there, and where. Once a second is enough.
  void announce();
  // For people who look closely: once a second is enough. It adds who follows the runtime.
  void publish_health(RuntimeHealth health);
  // False while nobody looks at snapshots.
  bool snapshot_wanted() const;

 private:
  struct State;
  explicit LinkEndpoint(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace stepwright::dds
