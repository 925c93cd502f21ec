#pragma once

// A component that is a process of its own, which is stepped: of an FMU. It takes part in the exchange of its
// plant (exchange.h); between two exchanges its outputs hold.
//
// Threads: `trouble` belongs to the thread that started it, `failed` to any; the rest as for Component.

#include <cstdint>
#include <string>

#include "plant_models/components/component.h"
#include "runtime/ground/result/result.h"

namespace stepwright::components {

enum class Answer : std::uint8_t {
  Same,     // every output is what it was
  Changed,  // one has another value
  Lost,     // the process is lost; the outputs are what they were
};

class ProcessPart : public Component {
 public:
  ProcessPart* process() final { return this; }

  // Starts the process with what its inputs are in `sampled`, and takes its first outputs. Fails with R0151
  // to R0155.
  [[nodiscard]] virtual result::Result<void> start(const Frame& sampled) = 0;
  // Has it run up to `time_ns` for `step_ns` with what its inputs are in `sampled`, the beginning of the
  // step. False: the process is lost. Nobody waits.
  virtual bool ask(const Frame& sampled, std::int64_t time_ns, std::int64_t step_ns) = 0;
  // Waits for the end of that step and takes the outputs.
  virtual Answer finish() = 0;
  virtual bool failed() const = 0;
  // What has become of the process; empty while it is there.
  virtual std::string trouble() = 0;
};

}  // namespace stepwright::components
