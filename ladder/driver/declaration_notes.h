#pragma once

// Collector of the notes on a variable between the tokens of its declaration, for people: the comment behind
// it on its line, and pragmas (syntax/tag_pragma.h) before it, in it, or behind it on its line.
//
//   {group := 'buffer'}
//   level : REAL {decimals := 1}; {unit := 'l'} // how full it is
//
// Mistakes in pragmas were reported when the text was read; such a pragma says nothing here. Pure; use from
// any thread.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "ladder/graphic/tag_note.h"
#include "ladder/syntax/tag_pragma.h"

namespace stepwright::driver {

class DeclarationNotes {
 public:
  explicit DeclarationNotes(std::string_view text) : text_(text) {}

  // Blanks up to the first token of the declaration. What stands on the line of a declaration before belongs
  // to that one.
  void before(std::size_t begin, std::size_t end, bool follows_declaration);
  // Blanks between two of its tokens.
  void between(std::size_t begin, std::size_t end);
  // The rest of its line.
  void behind(std::size_t begin);

  const std::string& comment() const { return comment_; }  // as it stands between its marks
  std::optional<graphic::TagNote> note() const;

 private:
  std::size_t line_end(std::size_t at) const;

  std::string_view text_;
  std::string comment_;
  syntax::TagPragma said_;
};

}  // namespace stepwright::driver
