#include "supervisor/htn/syntax/network_parser.h"
#include "supervisor/htn/syntax/parser.h"

namespace stepwright::htn {
namespace {

using lisp::TokenKind;

class DomainParser : private lisp::SectionParser {
 public:
  DomainParser(std::vector<lisp::Token> tokens, lisp::Reporter& reporter)
      : SectionParser(std::move(tokens), reporter) {}

  ParsedDomain run() {
    if (define("domain", domain_.name, domain_.at)) {
      sections([this](const std::string& keyword, Place at) { return section(keyword, at); });
    }
    return std::move(domain_);
  }

 private:
  bool section(const std::string& keyword, Place at) {
    if (keyword == ":action") return action();
    if (keyword == ":method") return method();
    if (keyword == ":task") return task();
    if (!once(keyword, at)) return false;
    if (keyword == ":requirements") return requirements(domain_.requirements);
    if (keyword == ":types") return lisp::read_typed_list(tokens_, TokenKind::Name, domain_.types);
    if (keyword == ":constants") return lisp::read_typed_list(tokens_, TokenKind::Name, domain_.constants);
    if (keyword == ":predicates") return predicates();
    if (keyword == ":functions") return functions();
    return unknown(keyword, at,
                   {":requirements", ":types", ":constants", ":predicates", ":functions", ":task", ":method",
                    ":action"});
  }

  bool predicates() {
    while (!tokens_.at(TokenKind::Close)) {
      domain_.predicates.emplace_back();
      if (!formulas_.declaration(domain_.predicates.back())) return false;
    }
    return true;
  }

  bool functions() {
    return numeric_functions([&] {
      domain_.functions.emplace_back();
      return formulas_.declaration(domain_.functions.back());
    });
  }

  // Handles what follows each keyword up to the end of the section.
  template <typename Part>
  bool parts(const char* expected, const Part& part) {
    std::set<std::string> seen;
    while (tokens_.at(TokenKind::Keyword)) {
      const Place at = tokens_.peek().at;
      const std::string keyword = tokens_.take().text;
      if (!seen.insert(keyword).second) {
        tokens_.reporter().error("P0007", at, "'" + keyword + "' stands twice here");
        return false;
      }
      if (!part(keyword, at)) return false;
    }
    return tokens_.at(TokenKind::Close) || tokens_.unexpected(expected);
  }

  bool action() {
    ParsedAction action;
    if (!tokens_.expect_name("the name of the action", action.name, action.at)) return false;
    const bool good = parts("':precondition', ':effect' or ')'", [&](const std::string& keyword, Place at) {
      if (keyword == ":parameters") return formulas_.parameters(action.parameters);
      if (keyword == ":precondition") return formulas_.formula(action.precondition);
      if (keyword == ":effect") return formulas_.effect(action.effect);
      return unknown(keyword, at, {":parameters", ":precondition", ":effect"});
    });
    if (good) domain_.actions.push_back(std::move(action));
    return good;
  }

  // Older files give compound tasks empty conditions and effects.
  bool task() {
    ParsedSymbol task;
    if (!tokens_.expect_name("the name of the task", task.name, task.at)) return false;
    const bool good = parts("':parameters' or ')'", [&](const std::string& keyword, Place at) {
      if (keyword == ":parameters") return formulas_.parameters(task.parameters);
      if (keyword == ":precondition" || keyword == ":effect") return nothing(keyword, at);
      return unknown(keyword, at, {":parameters"});
    });
    if (good) domain_.tasks.push_back(std::move(task));
    return good;
  }

  bool nothing(const std::string& keyword, Place at) {
    ParsedFormula formula;
    if (!formulas_.formula(formula)) return false;
    if (formula.kind == FormulaKind::And && formula.parts.empty()) return true;
    tokens_.reporter().error("P0008", at, "a compound task has no '" + keyword + "' here",
                             "its methods have preconditions");
    return false;
  }

  bool method() {
    ParsedMethod method;
    if (!tokens_.expect_name("the name of the method", method.name, method.at)) return false;
    NetworkParser networks(tokens_, formulas_);
    const bool good = parts("':task', ':ordered-subtasks' or ')'", [&](const std::string& keyword, Place at) {
      if (keyword == ":parameters") return formulas_.parameters(method.parameters);
      if (keyword == ":precondition") return formulas_.formula(method.precondition);
      if (keyword == ":task") {
        method.has_task = true;
        return formulas_.call(method.task);
      }
      if (NetworkParser::knows(keyword)) return networks.part(method.network, keyword, at);
      return unknown(keyword, at,
                     {":parameters", ":task", ":precondition", ":ordered-subtasks", ":subtasks", ":ordering",
                      ":constraints"});
    });
    if (!good) return false;
    if (!method.has_task) {
      tokens_.reporter().error("P0601", method.at, "the method '" + method.name + "' does not say its task",
                               "add ':task (NAME ARGUMENT ...)'");
      return false;
    }
    if (!networks.finish(method.network)) return false;
    domain_.methods.push_back(std::move(method));
    return true;
  }

  FormulaParser formulas_{tokens_};
  ParsedDomain domain_;
};

}  // namespace

ParsedDomain parse_domain(std::vector<lisp::Token> tokens, lisp::Reporter& reporter) {
  return DomainParser(std::move(tokens), reporter).run();
}

}  // namespace stepwright::htn
