#include "cell/trial/sample.h"

namespace stepwright::trial {
namespace {

// An object may be out of reach in one combination and within reach in the next.
constexpr int kMostInVain = 2;
// A search that proves that no plan leads there takes as long as many that find one.
constexpr int kMostInVainOfAll = 3;

}  // namespace

bool Sample::wants(const model::GroundAction& action) const {
  if (seen_.empty()) return true;
  if (!any_tried_ && in_vain_ >= kMostInVainOfAll) return false;
  for (std::size_t place = 0; place < action.arguments.size(); ++place) {
    const auto found = seen_.find({place, action.arguments[place]});
    if (found == seen_.end()) return true;
    if (!found->second.tried && found->second.in_vain < kMostInVain) return true;
  }
  return false;
}

void Sample::note_tried(const model::GroundAction& action) {
  any_tried_ = true;
  for (std::size_t place = 0; place < action.arguments.size(); ++place)
    seen_[{place, action.arguments[place]}].tried = true;
}

void Sample::note_unreachable(const model::GroundAction& action) {
  ++in_vain_;
  for (std::size_t place = 0; place < action.arguments.size(); ++place)
    ++seen_[{place, action.arguments[place]}].in_vain;
}

}  // namespace stepwright::trial
