#include "cell/tags/tag_notes.h"

namespace stepwright::tags {

std::vector<protocol::TagNote> tag_notes(std::span<const config::TagConfig> tags) {
  std::vector<protocol::TagNote> notes;
  for (const config::TagConfig& tag : tags) {
    protocol::TagNote note{tag.name, tag.unit, tag.description, tag.group, tag.decimals, {}, tag.values};
    if (tag.range) note.normal = {tag.range->low, tag.range->high};
    notes.push_back(std::move(note));
  }
  return notes;
}

}  // namespace stepwright::tags
