#pragma once

// A whole text that is one expression, as a tree.
//
//   ExpressionPtr condition = parse_expression(context, file, TextKind::Piece);
//
// Not thread-safe, as its context.

#include "ladder/syntax/parser.h"

namespace stepwright::syntax {

// Null if the text is anything else; why is reported to the context's sink.
ExpressionPtr parse_expression(SyntaxContext& context, source::FileId file, TextKind kind);

}  // namespace stepwright::syntax
