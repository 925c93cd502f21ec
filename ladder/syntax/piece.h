#pragma once

// Texts of charts and diagrams that stand inside of a larger text when they are compiled: the name on a
// block, the variable of a coil, the expression on a contact, the statements of an action. A piece is read
// alone, by the lexer and the parser of the language, before it is put anywhere: what is whole means the same
// wherever it stands (an expression that is no operand in parentheses), what is not must not go in.
//
// Not thread-safe; one reader per lowering.
//
//   PieceReader reader;
//   reader.read("a OR b", PieceKind::Expression)   ->  whole, no operand
//   reader.read("a) OR (b", PieceKind::Expression) ->  "expected an expression...": not whole
//   reader.line("a (* left *)\n + b")              ->  "a             + b"

#include <string>
#include <string_view>
#include <vector>

#include "ladder/syntax/parser.h"
#include "ladder/syntax/token.h"

namespace stepwright::syntax {

struct Piece {
  bool is_whole = false;    // the text is one of its kind, and nothing stands before or behind it
  bool is_operand = false;  // an expression without an operator outside of parentheses and brackets
  // Why it is not whole; for a reader.
  std::string fault;
  std::string hint;
  std::uint32_t fault_at = 0;  // byte of the text
};

class PieceReader {
 public:
  PieceReader() { intern_keywords(names_); }
  PieceReader(const PieceReader&) = delete;
  PieceReader& operator=(const PieceReader&) = delete;

  Piece read(std::string_view text, PieceKind kind);
  // Closed by an End token; they view `text`.
  std::vector<Token> tokens(std::string_view text) { return lex(text, names_); }
  // On one line: comments and line ends become blanks, every token stays at its byte. Pragmas stay, because
  // the marks of a generated text (lexer.h) are among them.
  std::string line(std::string_view text);
  // The same of a text that a user wrote, who cannot set marks: pragmas become blanks, too.
  std::string bare_line(std::string_view text);

 private:
  std::string blanked(std::string_view text, bool pragmas);

  source::NameTable names_;
};

// The byte of `text` at which one of its tokens begins, and the one behind it.
std::size_t begin_of(const Token& token, std::string_view text);
std::size_t end_of(const Token& token, std::string_view text);

}  // namespace stepwright::syntax
