#include "supervisor/lisp/section_parser.h"

#include "supervisor/lisp/name_hints.h"

namespace stepwright::lisp {

bool SectionParser::define(const std::string& kind, std::string& name, Place& at) {
  if (!tokens_.expect(TokenKind::Open, "'(define'")) return false;
  if (!tokens_.at(TokenKind::Name, "define")) return tokens_.unexpected("'define'");
  tokens_.take();
  if (!tokens_.expect(TokenKind::Open, "'(" + kind + " NAME)'")) return false;
  if (!tokens_.at(TokenKind::Name, kind)) {
    return tokens_.unexpected("'" + kind + "'", "are the domain and the problem given in this order?");
  }
  tokens_.take();
  return tokens_.expect_name("the name of the " + kind, name, at) && tokens_.expect(TokenKind::Close, "')'");
}

void SectionParser::sections(const Handler& handler) {
  while (tokens_.at(TokenKind::Open)) {
    const std::size_t depth = tokens_.depth();
    tokens_.take();
    const Place at = tokens_.peek().at;
    bool good = false;
    if (tokens_.at(TokenKind::Keyword)) {
      const std::string keyword = tokens_.take().text;
      good = handler(keyword, at) && tokens_.expect(TokenKind::Close, "')'");
    } else {
      tokens_.unexpected("a section such as ':init'");
    }
    if (!good) tokens_.recover(depth);
  }
  if (!tokens_.expect(TokenKind::Close, "')' or a section")) return;
  if (!tokens_.at(TokenKind::End)) tokens_.unexpected("nothing more", "is there a ')' too many above?");
}

bool SectionParser::once(const std::string& keyword, Place at) {
  if (seen_.insert(keyword).second) return true;
  tokens_.reporter().error("P0007", at, "the section '" + keyword + "' stands twice");
  return false;
}

bool SectionParser::unknown(const std::string& keyword, Place at, const std::vector<std::string>& known) {
  std::string hint = did_you_mean(keyword, known);
  if (keyword == ":durative-action") hint = "actions have no duration here: use ':action'";
  tokens_.reporter().error("P0008", at, "'" + keyword + "' is not supported here", hint);
  return false;
}

bool SectionParser::requirements(std::vector<RequirementFlag>& list) {
  while (tokens_.at(TokenKind::Keyword)) {
    const Place at = tokens_.peek().at;
    list.push_back({tokens_.take().text, at});
  }
  return tokens_.at(TokenKind::Close) || tokens_.unexpected("a requirement such as ':typing'");
}

bool SectionParser::length() {
  while (tokens_.accept(TokenKind::Open)) {
    if (!tokens_.expect(TokenKind::Keyword, "':serial' or ':parallel'")) return false;
    if (!tokens_.expect(TokenKind::Number, "a number") || !tokens_.expect(TokenKind::Close, "')'"))
      return false;
  }
  return true;
}

}  // namespace stepwright::lisp
