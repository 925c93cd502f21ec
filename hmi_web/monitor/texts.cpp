#include "hmi_web/monitor/texts.h"

#include <utility>

#include "ladder/syntax/expression_text.h"

namespace stepwright::monitor {

Texts::Texts() : sink_(sources_), context_{sources_, names_, sink_} {
  syntax::intern_keywords(names_);
}

// The sink tells places apart by the names of their files.
source::FileId Texts::add(const std::string& text) {
  return sources_.add(std::to_string(sources_.size()), text);
}

const syntax::Expression* Texts::expression(const std::string& text) {
  auto parsed = syntax::parse_expression(context_, add(text), syntax::TextKind::Piece);
  if (!parsed) return nullptr;
  expressions_.push_back(std::move(parsed));
  return expressions_.back().get();
}

const syntax::Statements& Texts::statements(const std::string& text) {
  bodies_.push_back(syntax::parse_statements(context_, add(text), syntax::TextKind::Written));
  return bodies_.back();
}

}  // namespace stepwright::monitor
