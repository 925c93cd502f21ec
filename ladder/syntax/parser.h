#pragma once

// Tokens -> syntax tree, by recursive descent. A mistake is reported once, where it stands; the parser then
// skips to a place where a statement, a declaration or a POU begins and goes on, so that one run reports all
// mistakes. Unreadable parts become Error nodes, which later stages do not report again.
//
// One SyntaxContext belongs to one compilation. Not thread-safe.
//
//   SyntaxContext context{sources, names, sink};
//   Unit unit;
//   parse_unit(context, file, unit);

#include "ladder/source/diagnostic_sink.h"
#include "ladder/source/dialect.h"
#include "ladder/syntax/declaration.h"
#include "ladder/syntax/lexer.h"

namespace stepwright::syntax {

struct SyntaxContext {
  source::SourceSet& sources;
  source::NameTable& names;  // intern_keywords was called
  source::DiagnosticSink& sink;
  const source::Dialect* dialect = &source::standard_dialect();
};

// Appends everything that a source file, or a part of it, declares to `unit`.
void parse_unit(SyntaxContext& context, source::FileId file, Unit& unit, TextKind kind = TextKind::Written,
                Extent extent = {});

// A whole text that is one statement list. In a Generated text "JMP name;" and "name:" are statements too.
Statements parse_statements(SyntaxContext& context, source::FileId file, TextKind kind);

// Kind of a text in a chart or a diagram (piece.h).
enum class PieceKind : std::uint8_t {
  Word,           // a name, or a reserved word
  PouName,        // a name, in a namespace or not, or a reserved word that names a function: "AND", "MOD"
  Variable,       // what can be written: "a", "m.x[2]", "p^", "w.%X3", "%QX0.0"
  Expression,     // whatever has a value
  StatementList,  // with or without ';' behind the last one
};
struct PieceResult {
  Statements statements;    // of a StatementList, also of one with mistakes
  bool is_whole = false;    // the text is that and nothing else; if not, it was reported
  bool is_operand = false;  // a value, and no operator stands outside of its parentheses and brackets
};
PieceResult parse_piece(SyntaxContext& context, source::FileId file, PieceKind piece, TextKind kind);

// A whole text of VAR sections.
std::vector<VariableDeclaration> parse_variables(SyntaxContext& context, source::FileId file, TextKind kind);

}  // namespace stepwright::syntax
