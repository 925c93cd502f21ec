#include "runtime/dds/internal/trouble.h"

namespace stepwright::dds::internal {

void Trouble::add(const result::Diagnostic& refused, std::uint32_t version, Clock::time_point now) {
  if (!tell_) return;
  const std::string kind = refused.where.file + " " + refused.code + " " + std::to_string(version);
  {
    const std::scoped_lock lock(mutex_);
    std::erase_if(told_, [&](const auto& each) { return now - each.second >= kPause; });
    if (told_.size() >= kMostKinds || !told_.emplace(kind, now).second) return;
  }
  tell_(refused);
}

}  // namespace stepwright::dds::internal
