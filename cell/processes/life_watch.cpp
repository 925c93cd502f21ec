#include "cell/processes/life_watch.h"

namespace stepwright::processes {
namespace {

// Of the longest silence: who asks less often than this was held up.
constexpr int kPartsOfSilence = 4;

}  // namespace

bool LifeWatch::silent(Time now) {
  const auto pause = now - asked_;
  asked_ = now;
  if (!heard_) return false;
  if (pause > longest_ / kPartsOfSilence) heard_ = now;
  return now - *heard_ > longest_;
}

}  // namespace stepwright::processes
