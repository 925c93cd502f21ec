#include "runtime/dds/internal/namesakes.h"

#include "runtime/dds/internal/topics.h"

namespace stepwright::dds::internal {
namespace {

constexpr std::chrono::seconds kForgotten{5};
constexpr std::size_t kMostPlaces = 16;

}  // namespace

Namesakes::Namesakes(Participant& participant)
    : runtime_id_(participant.runtime_id()),
      beacons_(participant, kBeaconTopic, Profile::Picture,
               {.on_message = [this](const service::Beacon& beacon) { on_beacon(beacon); }}, Scope::Domain) {}

std::vector<std::string> Namesakes::places(const std::string& own) const {
  const auto now = Clock::now();
  const std::scoped_lock lock(mutex_);
  std::vector<std::string> places;
  for (const auto& [place, heard] : heard_) {
    if (place != own && now - heard <= kForgotten) places.push_back(place);
  }
  return places;
}

void Namesakes::on_beacon(const service::Beacon& beacon) {
  if (beacon.runtime_id != runtime_id_) return;
  const auto now = Clock::now();
  const std::scoped_lock lock(mutex_);
  std::erase_if(heard_, [&](const auto& each) { return now - each.second > kForgotten; });
  if (heard_.size() < kMostPlaces || heard_.contains(beacon.place)) heard_[beacon.place] = now;
}

}  // namespace stepwright::dds::internal
