#include "ladder/driver/declaration_notes.h"

#include "ladder/syntax/blank.h"

namespace stepwright::driver {

namespace {

using syntax::Blank;
using syntax::BlankKind;

std::string_view inside_of(std::string_view text, std::size_t at, const Blank& blank) {
  const std::size_t begin = at + blank.open.size();
  const std::size_t end = blank.closed ? blank.end - blank.close.size() : blank.end;
  return text.substr(begin, end - begin);
}

}  // namespace

// The first end of a line outside of comments, or where the next token stands.
std::size_t DeclarationNotes::line_end(std::size_t at) const {
  for (Blank blank = syntax::blank_at(text_, at); blank.kind != BlankKind::None;
       blank = syntax::blank_at(text_, at)) {
    const bool breaks = blank.kind == BlankKind::Space &&
                        text_.substr(at, blank.end - at).find('\n') != std::string_view::npos;
    if (breaks) return at;
    at = blank.end;
  }
  return at;
}

void DeclarationNotes::before(std::size_t begin, std::size_t end, bool follows_declaration) {
  between(follows_declaration ? line_end(begin) : begin, end);
}

void DeclarationNotes::between(std::size_t begin, std::size_t end) {
  std::size_t at = begin;
  for (Blank blank = syntax::blank_at(text_, at); at < end && blank.kind != BlankKind::None;
       blank = syntax::blank_at(text_, at)) {
    const std::string_view inside = inside_of(text_, at, blank);
    at = blank.end;
    if (blank.kind != BlankKind::Pragma || !syntax::is_tag_pragma(inside)) continue;
    syntax::TagPragmaMistake mistake;
    syntax::read_tag_pragma(inside, said_, mistake);
  }
}

void DeclarationNotes::behind(std::size_t begin) {
  const std::size_t end = line_end(begin);
  between(begin, end);
  std::size_t at = begin;
  while (at < end && comment_.empty()) {
    const Blank blank = syntax::blank_at(text_, at);
    if (blank.kind == BlankKind::Comment) comment_ = inside_of(text_, at, blank);
    at = blank.end;
  }
}

std::optional<graphic::TagNote> DeclarationNotes::note() const {
  if (said_.empty()) return std::nullopt;
  return graphic::TagNote{said_.unit,     said_.description, said_.group,
                          said_.decimals, said_.range,       said_.values};
}

}  // namespace stepwright::driver
