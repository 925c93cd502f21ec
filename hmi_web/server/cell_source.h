#pragma once

// Interface of the server to the cell that it shows. The program implements it over Fast DDS, tests with a
// cell of their own; the server knows neither.
//
// Thread rule: one thread calls, always the same one. `observe` may block for a moment (a request for a new
// program), never for ever.

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "hmi_web/protocol/cell_state.h"
#include "hmi_web/server/program_layout.h"
#include "runtime/host/messages.h"

namespace stepwright::server {

// One consistent copy of the image, taken between two scans.
struct ImageSnapshot {
  std::uint64_t scan = 0;
  double time_s = 0;
  std::vector<std::byte> image;
  std::vector<std::pair<std::string, double>> plant;  // truth of a simulated plant, by name
};

// The bias of each sensor in raw counts, by the sensor's name.
using Tare = std::map<std::string, double>;

// Inputs that a device does not give: what stands in the image there was never read, or is old.
struct UnreadInputs {
  std::string device;
  protocol::Unread why = protocol::Unread::Untold;
  std::vector<reader::Variable> inputs;  // in the image

  friend bool operator==(const UnreadInputs& one, const UnreadInputs& other) {
    const auto place = [](const reader::Variable& input) {
      return std::tuple(input.type, input.address, input.bit);
    };
    return one.device == other.device && one.why == other.why &&
           std::ranges::equal(one.inputs, other.inputs, {}, place, place);
  }
};

struct Observation {
  bool runtime_alive = false;
  bool runtime_unlinked = false;  // it runs on this machine, and nothing carries it here
  bool supervisor_alive = false;
  std::optional<host::RuntimeStatus> status;
  // Both of one program, the one that `layout` describes; without a layout the image cannot be read.
  std::optional<ImageSnapshot> snapshot;
  // How many images have come here so far, and how many were sent and never came; 0: the source cannot tell.
  std::uint64_t images = 0;
  std::uint64_t images_lost = 0;
  std::vector<UnreadInputs> unread;             // of each device that does not answer (yet)
  std::shared_ptr<const ProgramLayout> layout;  // shared: it stays the same for thousands of observations
  std::optional<std::string> plan;              // the supervisor's newest plan document, JSON text
  std::optional<std::string> pictures;          // and what is drawn of it
  Tare tare;                                    // empty while no supervisor has identified it
};

class CellSource {
 public:
  virtual ~CellSource() = default;
  // The newest of everything, at once.
  virtual Observation observe() = 0;
  // Returns when an image has come since it was called last, after `timeout` at the latest. A source that
  // cannot tell waits for so long.
  virtual void wait_for_image(std::chrono::milliseconds timeout) { std::this_thread::sleep_for(timeout); }
};

}  // namespace stepwright::server
