#pragma once

// Text -> tokens. Comments ((* *), /* */ and //) and pragmas ({ }) are skipped; what is not ST is reported
// once and becomes a Bad token, so that the parser can go on.
//
// In a generated text (TextKind::Generated) a pragma {@F:O} says that what follows was copied from offset O
// of file F, and {@} ends that: diagnostics and traps then name the place the user wrote. {@F:O!} says that
// all of what follows stands for that one place.

#include <vector>

#include "ladder/source/diagnostic_sink.h"
#include "ladder/syntax/token.h"

namespace stepwright::syntax {

// A Piece is a text that will stand inside of a generated one: generated names may stand in it, marks say
// nothing yet.
enum class TextKind : std::uint8_t { Written, Generated, Piece };

// Characters of a name.
inline constexpr std::size_t kMaxName = 255;

// A part of a text, in bytes.
struct Extent {
  std::uint32_t begin = 0;
  std::uint32_t end = 0xFFFFFFFF;  // cut to the text
};

// All tokens of a text or of a part of it, closed by one End token. `names` begins with the keywords
// (intern_keywords).
std::vector<Token> lex(const source::SourceSet& sources, source::FileId file, TextKind kind,
                       source::NameTable& names, source::DiagnosticSink& sink, Extent extent = {});

// All tokens of a piece that stands in no SourceSet, closed by one End token. They view `text`, and places
// are bytes of it. Nothing is reported: what is not ST is a Bad token.
std::vector<Token> lex(std::string_view text, source::NameTable& names);

}  // namespace stepwright::syntax
