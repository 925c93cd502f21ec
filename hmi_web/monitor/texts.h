#pragma once

// The pieces of ST of one sheet as trees. What is no ST has none; nothing is reported.
//
//   Texts texts;
//   const syntax::Expression* condition = texts.expression("level > 5");   // as long as `texts` lives
//
// One thread.

#include <deque>
#include <string>
#include <vector>

#include "ladder/source/diagnostic_sink.h"
#include "ladder/syntax/parser.h"

namespace stepwright::monitor {

class Texts {
 public:
  Texts();
  Texts(const Texts&) = delete;
  Texts& operator=(const Texts&) = delete;

  // Null if it is none.
  const syntax::Expression* expression(const std::string& text);
  // As far as they can be read.
  const syntax::Statements& statements(const std::string& text);
  // In the text that the place belongs to; columns count characters.
  source::LineColumn place(source::Position position) const { return sources_.line_column(position); }

 private:
  source::FileId add(const std::string& text);

  source::SourceSet sources_;
  source::NameTable names_;
  source::DiagnosticSink sink_;
  syntax::SyntaxContext context_;
  std::vector<syntax::ExpressionPtr> expressions_;
  std::deque<syntax::Statements> bodies_;
};

}  // namespace stepwright::monitor
