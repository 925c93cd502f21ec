#include "runtime/dds/internal/namesakes.h"

#include "runtime/dds/internal/topics.h"

namespace stepwright::dds::internal {
namespace {

constexpr std::chrono::seconds kForgotten{5};
constexpr std::size_t kMostPlaces = 16;
constexpr std::size_t kMostBytes = 4'096;  // of a path

}  // namespace

Namesakes::Namesakes(Participant& participant)
    : runtime_id_(participant.runtime_id()),
      beacons_(
          participant, kBeaconTopic, Profile::Picture, [this](idl::Beacon& sample) { on_beacon(sample); }, {},
          Scope::Domain) {}

std::vector<std::string> Namesakes::places(const std::string& own) const {
  const auto now = Clock::now();
  const std::scoped_lock lock(mutex_);
  std::vector<std::string> places;
  for (const auto& [place, heard] : heard_) {
    if (place != own && now - heard <= kForgotten) places.push_back(place);
  }
  return places;
}

void Namesakes::on_beacon(const idl::Beacon& sample) {
  if (sample.runtime_id() != runtime_id_ || sample.place().size() > kMostBytes) return;
  const auto now = Clock::now();
  const std::scoped_lock lock(mutex_);
  std::erase_if(heard_, [&](const auto& each) { return now - each.second > kForgotten; });
  if (heard_.size() < kMostPlaces || heard_.contains(sample.place())) heard_[sample.place()] = now;
}

}  // namespace stepwright::dds::internal
