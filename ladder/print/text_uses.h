#pragma once

// Uses of variables in a piece of ST, by reading and writing. Internal to this folder; one object per print,
// not thread-safe.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ladder/source/name_table.h"

namespace stepwright::print {

struct TextUse {
  std::string name;  // "lamp" of lamp, lamp.x and lamp[3]; "%IX0.0"
  // As far as the text fixes it, without blanks: "a.x[3][1].y" of a.x[3, 1].y, "a" of a[i].y.
  std::string path;
  std::uint32_t line = 1;    // of the text
  std::uint32_t column = 1;  // characters, from 1
  std::uint32_t length = 0;  // bytes of `path` as it is written
  bool write = false;
  bool call = false;  // of an instance: it is written, too
};

class TextUses {
 public:
  TextUses();

  // Statements or an expression, in the order of the text. Names of functions and of members are among them
  // where they look like variables: who asks knows what is declared. A block that is called is written.
  std::vector<TextUse> of(std::string_view text);

 private:
  source::NameTable names_;
};

}  // namespace stepwright::print
