#pragma once

// Notes on the tags of a program from the declarations in its sources: comments, and pragmas with unit,
// group, decimals, range and names of values (hmi_web/doc/tags.md).
//
//   const DeclaredNotes notes(info->instances(), layout.document);
//   notes.of("Main.levels[3]").description;   // "litres in each tank", of `levels` in the program of Main
//
// The document comes from outside and is read with doubt (hmi_web/doc/program.md): what has another shape
// says nothing, and texts, lists and numbers have bounds. Immutable once made; any thread.

#include <span>
#include <string>
#include <string_view>
#include <unordered_map>

#include "hmi_web/protocol/tag_note.h"
#include "runtime/bytecode/reader/program_info.h"

namespace stepwright::tags {

inline constexpr std::size_t kMostNoteBytes = 200;  // what is longer is no description
inline constexpr std::size_t kMostNamedValues = 64;

class DeclaredNotes {
 public:
  DeclaredNotes(std::span<const reader::InstanceInfo> instances, std::string_view document);

  // Of the variable that the tag is, or of the array that it is an element of, without a name; empty if
  // nothing is said. A description is that of the pragma, or else the comment. A member of a structure has
  // none of its own.
  protocol::TagNote of(std::string_view tag) const;

 private:
  std::unordered_map<std::string, std::string> pous_;         // of instances, by their path
  std::unordered_map<std::string, protocol::TagNote> notes_;  // "POU.VARIABLE"; of globals ".VARIABLE"
};

}  // namespace stepwright::tags
