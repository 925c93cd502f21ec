#include "ladder/syntax/piece.h"

#include <algorithm>

#include "ladder/syntax/blank.h"

namespace stepwright::syntax {

namespace {

// Most pieces are one.
bool is_name(const std::vector<Token>& tokens) {
  return tokens.size() == 2 && tokens.front().is(TokenKind::Identifier);
}

// The byte of the character that a place counts to.
std::uint32_t byte_of(const result::Location& where, const source::SourceSet& sources, source::FileId file) {
  const std::string_view text = sources.text(file);
  std::size_t at = where.line > 0 ? sources.line_start(file, where.line) : 0;
  const auto goes_on = [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) == 0x80u; };
  for (std::uint32_t i = 1; i < where.column && at < text.size(); ++i) {
    ++at;
    while (at < text.size() && goes_on(text[at])) ++at;
  }
  return static_cast<std::uint32_t>(at);
}

// Comments, and pragmas if they are to go, of what stands between two tokens.
void blank_out(std::string& line, std::string_view text, std::size_t at, std::size_t end, bool pragmas) {
  while (at < end) {
    const Blank blank = blank_at(text, at);
    const bool goes = blank.kind == BlankKind::Comment || (pragmas && blank.kind == BlankKind::Pragma);
    const std::size_t stop = blank.kind == BlankKind::None ? end : std::min(blank.end, end);
    for (; at < stop; ++at)
      if (goes) line[at] = ' ';
  }
}

}  // namespace

std::size_t begin_of(const Token& token, std::string_view text) {
  return static_cast<std::size_t>(token.text.data() - text.data());
}

std::size_t end_of(const Token& token, std::string_view text) {
  return begin_of(token, text) + token.text.size();
}

Piece PieceReader::read(std::string_view text, PieceKind kind) {
  Piece piece;
  if (kind != PieceKind::StatementList && is_name(tokens(text))) {
    piece.is_whole = piece.is_operand = true;
    return piece;
  }
  source::SourceSet sources;
  source::DiagnosticSink sink(sources);
  SyntaxContext context{sources, names_, sink};
  const source::FileId file = sources.add({}, std::string(text));
  const PieceResult result = parse_piece(context, file, kind, TextKind::Piece);
  piece.is_whole = result.is_whole;
  piece.is_operand = result.is_operand;
  for (result::Diagnostic& each : sink.take()) {
    if (each.severity != result::Severity::Error || !piece.fault.empty()) continue;
    piece.fault = std::move(each.message);
    piece.hint = std::move(each.hint);
    piece.fault_at = byte_of(each.where, sources, file);
  }
  return piece;
}

std::string PieceReader::line(std::string_view text) {
  return blanked(text, false);
}

std::string PieceReader::bare_line(std::string_view text) {
  return blanked(text, true);
}

std::string PieceReader::blanked(std::string_view text, bool pragmas) {
  std::string line(text);
  // Most texts are a name.
  if (text.find_first_of("/*{\r\n") == std::string_view::npos) return line;
  std::size_t at = 0;
  for (const Token& token : tokens(text)) {
    blank_out(line, text, at, begin_of(token, text), pragmas);
    at = end_of(token, text);
  }
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return line;
}

}  // namespace stepwright::syntax
