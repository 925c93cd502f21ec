#pragma once

// Co-simulation of a plant's own equations with those of its parts that are processes (FMUs), explicit and
// parallel ("Jacobi"; Kuebler, Schiehlen, "Two Methods of Simulator Coupling", 2000): at the beginning of
// each communication step every part is given what its inputs are then, all run to its end at the same time,
// and all outputs change there at once. So the result depends on no order of the parts, and what goes through
// a part arrives one step later.
//
//   if (exchange.due()) exchange.ask(sampled_now);
//   ... the plant's own equations up to exchange.end() ...
//   exchange.finish();
//
// Thread rule: as ModelPlant. Nothing allocates after start().

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "plant_models/components/process_part.h"

namespace stepwright::components {

class Exchange {
 public:
  Exchange(std::vector<ProcessPart*> parts, std::chrono::nanoseconds step)
      : parts_(std::move(parts)), step_(step) {}

  // Starts the processes in the order of the file; each is given what `sampled` says after the ones before.
  [[nodiscard]] result::Result<void> start(const std::function<Frame()>& sampled);

  // Its processes run.
  bool running() const { return running_; }
  // The step up to end() has to be asked for.
  bool due() const { return running_ && !asked_; }
  // Where the step ends that is under way, or comes next.
  std::chrono::nanoseconds end() const { return end_; }
  // Requires due(). False: a process is lost.
  bool ask(const Frame& sampled);
  // Requires that the step was asked for.
  Answer finish();

  bool failed() const;
  std::string trouble();

 private:
  std::vector<ProcessPart*> parts_;
  std::chrono::nanoseconds step_;
  std::chrono::nanoseconds end_{0};
  bool running_ = false;
  bool asked_ = false;
};

}  // namespace stepwright::components
