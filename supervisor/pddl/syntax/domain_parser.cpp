#include <set>

#include "supervisor/pddl/syntax/formula_parser.h"
#include "supervisor/pddl/syntax/parser.h"

namespace stepwright::pddl {
namespace {

class DomainParser : private lisp::SectionParser {
 public:
  DomainParser(std::vector<Token> tokens, Reporter& reporter) : SectionParser(std::move(tokens), reporter) {}

  ParsedDomain run() {
    if (define("domain", domain_.name, domain_.at)) {
      sections([this](const std::string& keyword, Place at) { return section(keyword, at); });
    }
    return std::move(domain_);
  }

 private:
  bool section(const std::string& keyword, Place at) {
    if (keyword == ":action") return action(at);
    if (keyword == ":derived") return axiom();
    if (!once(keyword, at)) return false;
    if (keyword == ":requirements") return requirements(domain_.requirements);
    if (keyword == ":types") return formulas_.typed_list(TokenKind::Name, domain_.types);
    if (keyword == ":constants") return formulas_.typed_list(TokenKind::Name, domain_.constants);
    if (keyword == ":predicates") return declarations(domain_.predicates);
    if (keyword == ":functions") return functions();
    return unknown(
        keyword, at,
        {":requirements", ":types", ":constants", ":predicates", ":functions", ":derived", ":action"});
  }

  bool declarations(std::vector<Symbol>& symbols) {
    while (!tokens_.at(TokenKind::Close)) {
      symbols.emplace_back();
      if (!formulas_.declaration(symbols.back())) return false;
    }
    return true;
  }

  bool functions() {
    return numeric_functions([&] {
      domain_.functions.emplace_back();
      return formulas_.declaration(domain_.functions.back());
    });
  }

  bool axiom() {
    Symbol head;
    Axiom axiom;
    if (!formulas_.declaration(head) || !formulas_.formula(axiom.body)) return false;
    axiom.name = head.name;
    axiom.at = head.at;
    axiom.parameters = std::move(head.parameters);
    domain_.axioms.push_back(std::move(axiom));
    return true;
  }

  bool action(Place at) {
    Action action;
    action.at = at;
    if (!tokens_.expect_name("the name of the action", action.name, action.at)) return false;
    std::set<std::string> seen;
    while (tokens_.at(TokenKind::Keyword)) {
      const Place place = tokens_.peek().at;
      const std::string keyword = tokens_.take().text;
      if (!seen.insert(keyword).second) {
        tokens_.reporter().error("P0007", place, "'" + keyword + "' stands twice in this action");
        return false;
      }
      if (!action_part(action, keyword, place)) return false;
    }
    if (!tokens_.at(TokenKind::Close)) return tokens_.unexpected("':precondition', ':effect' or ')'");
    domain_.actions.push_back(std::move(action));
    return true;
  }

  bool action_part(Action& action, const std::string& keyword, Place at) {
    if (keyword == ":parameters") {
      return tokens_.expect(TokenKind::Open, "'('") &&
             formulas_.typed_list(TokenKind::Variable, action.parameters) &&
             tokens_.expect(TokenKind::Close, "')'");
    }
    if (keyword == ":precondition") return formulas_.formula(action.precondition);
    if (keyword == ":effect") return formulas_.effect(action.effect);
    return unknown(keyword, at, {":parameters", ":precondition", ":effect"});
  }

  FormulaParser formulas_{tokens_};
  ParsedDomain domain_;
};

}  // namespace

ParsedDomain parse_domain(std::vector<Token> tokens, Reporter& reporter) {
  return DomainParser(std::move(tokens), reporter).run();
}

}  // namespace stepwright::pddl
