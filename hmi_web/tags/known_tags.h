#pragma once

// Notes on the tags of a program from both the cell and the declarations: what the cell leaves open, the
// declaration says (hmi_web/doc/tags.md). The page puts both together itself (client/src/lib/tag_notes.ts);
// this is for tables and messages that are made without one.
//
//   const KnownTags tags(tags::tag_notes(config.tags), {info.instances(), reader::document_text(container)});
//   tags.of("Main.levels[3]").unit;
//
// Immutable once made; any thread.

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "hmi_web/protocol/tag_note.h"
#include "hmi_web/tags/declared_notes.h"

namespace stepwright::tags {

// "Main.pumps.speed" of "Main.pumps[3].speed": what is said of an array is said of its elements.
std::string without_indices(std::string_view name);

class KnownTags {
 public:
  KnownTags(std::vector<protocol::TagNote> said, DeclaredNotes declared);

  // With the tag's name; of an element of an array also what is said of the array.
  protocol::TagNote of(std::string_view tag) const;

 private:
  std::unordered_map<std::string, protocol::TagNote> said_;  // by name in upper case
  DeclaredNotes declared_;
};

}  // namespace stepwright::tags
