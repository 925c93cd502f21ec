#include "plant_models/components/exchange.h"

#include <algorithm>

namespace stepwright::components {

result::Result<void> Exchange::start(const std::function<Frame()>& sampled) {
  for (ProcessPart* const part : parts_)
    if (auto started = part->start(sampled()); !started) return result::forward(started);
  running_ = !parts_.empty();
  end_ = step_;
  return {};
}

bool Exchange::ask(const Frame& sampled) {
  asked_ = true;
  for (ProcessPart* const part : parts_)
    if (!part->ask(sampled, end_.count(), step_.count())) return false;
  return true;
}

// All are waited for, so that none is still at work when another one is lost.
Answer Exchange::finish() {
  Answer all = Answer::Same;
  for (ProcessPart* const part : parts_) all = std::max(all, part->finish());
  asked_ = false;
  end_ += step_;
  return all;
}

bool Exchange::failed() const {
  return std::any_of(parts_.begin(), parts_.end(), [](const ProcessPart* part) { return part->failed(); });
}

std::string Exchange::trouble() {
  if (!running_) return {};
  for (ProcessPart* const part : parts_)
    if (std::string said = part->trouble(); !said.empty()) return said;
  return {};
}

}  // namespace stepwright::components
