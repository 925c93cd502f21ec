#pragma once

// Tokens -> syntax tree, by recursive descent. A mistake is reported once, where it stands; the parser then
// skips to a place where a statement, a declaration or a POU begins and goes on, so that one run reports all
// mistakes. What it could not read becomes an Error node, about which later stages say nothing.
//
// One SyntaxContext belongs to one compilation. Not thread-safe.
//
//   SyntaxContext context{sources, names, sink};
//   Unit unit;
//   parse_unit(context, file, unit);

#include "ladder/source/diagnostic_sink.h"
#include "ladder/syntax/declaration.h"
#include "ladder/syntax/lexer.h"

namespace stepwright::syntax {

struct SyntaxContext {
  source::SourceSet& sources;
  source::NameTable& names;  // intern_keywords was called
  source::DiagnosticSink& sink;
};

// Appends everything that a source file, or a part of it, declares to `unit`.
void parse_unit(SyntaxContext& context, source::FileId file, Unit& unit, TextKind kind = TextKind::Written,
                Extent extent = {});

// A whole text that is one statement list. In a Generated text "JMP name;" and "name:" are statements too.
Statements parse_statements(SyntaxContext& context, source::FileId file, TextKind kind);

// A whole text of VAR sections.
std::vector<VariableDeclaration> parse_variables(SyntaxContext& context, source::FileId file, TextKind kind);

}  // namespace stepwright::syntax
