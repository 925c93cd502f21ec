#pragma once

// Comments of declarations in the sources of a program, by the tags of the program.
//
//   const DeclaredComments comments(info->instances(), layout.document);
//   comments.of("Main.levels[3]");      // "litres in each tank", of `levels` in the program of the instance
//   Main
//
// The document comes from outside and is read with doubt (hmi_web/doc/program.md): what has another shape has
// no comments. Immutable once made; any thread.

#include <span>
#include <string>
#include <string_view>
#include <unordered_map>

#include "runtime/bytecode/reader/program_info.h"

namespace stepwright::server {

inline constexpr std::size_t kMostCommentBytes = 200;  // what is longer is no description

class DeclaredComments {
 public:
  DeclaredComments(std::span<const reader::InstanceInfo> instances, std::string_view document);

  // Of the variable that the tag is, or of the array that it is an element of; empty if it has none. A member
  // of a structure has none of its own.
  std::string of(std::string_view tag) const;

 private:
  std::unordered_map<std::string, std::string> pous_;      // of instances, by their path
  std::unordered_map<std::string, std::string> comments_;  // "POU.VARIABLE"; of globals ".VARIABLE"
};

}  // namespace stepwright::server
