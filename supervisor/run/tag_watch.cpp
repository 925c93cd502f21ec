#include "supervisor/run/tag_watch.h"

namespace stepwright::run {

void TagWatch::begin(std::span<const std::byte> container, bool carried_on) {
  if (tags_.empty()) return;
  places_.resize(tags_.size());
  const auto info = reader::ProgramInfo::read(container);
  for (std::size_t k = 0; k < tags_.size(); ++k) {
    const reader::Variable* found = info ? info->find(tags_[k].tag) : nullptr;
    // Only what both programs have keeps its value.
    told_[k] = told_[k] && carried_on && places_[k] && found != nullptr;
    places_[k] = found != nullptr ? std::optional(*found) : std::nullopt;
  }
}

std::optional<Cause> TagWatch::news(std::span<const std::byte> image) {
  Cause cause{IncidentKind::Monitor, {}};
  for (std::size_t k = 0; k < places_.size(); ++k) {
    if (!places_[k] || told_[k] || places_[k]->address >= image.size()) continue;
    if (reader::read_number(*places_[k], image) == 0.0) continue;
    told_[k] = true;
    cause.evidence.push_back(tags_[k].sentence);
    cause.signature += (cause.signature.empty() ? "" : " ") + tags_[k].tag;
  }
  if (cause.evidence.empty()) return std::nullopt;
  return cause;
}

}  // namespace stepwright::run
