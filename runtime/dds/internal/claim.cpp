#include "runtime/dds/internal/claim.h"

namespace stepwright::dds::internal {

bool Claim::admits(std::uint64_t client, Clock::time_point now) {
  if (held(now) && client != client_) return false;
  if (client != client_) process_.clear();
  client_ = client;
  heard_ = now;
  return true;
}

void Claim::heard(std::uint64_t client, const std::string& process, Clock::time_point now) {
  if (admits(client, now)) process_ = process;
}

}  // namespace stepwright::dds::internal
