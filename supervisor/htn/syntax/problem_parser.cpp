#include "supervisor/htn/syntax/network_parser.h"
#include "supervisor/htn/syntax/parser.h"

namespace stepwright::htn {
namespace {

using lisp::TokenKind;

class ProblemParser : private lisp::SectionParser {
 public:
  ProblemParser(std::vector<lisp::Token> tokens, lisp::Reporter& reporter)
      : SectionParser(std::move(tokens), reporter) {}

  ParsedProblem run() {
    if (define("problem", problem_.name, problem_.at)) {
      sections([this](const std::string& keyword, Place at) { return section(keyword, at); });
      if (!problem_.has_network) {
        tokens_.reporter().error("P0605", problem_.at, "the problem has no tasks", "add an ':htn' section");
      }
    }
    return std::move(problem_);
  }

 private:
  bool section(const std::string& keyword, Place at) {
    if (!once(keyword, at)) return false;
    if (keyword == ":domain")
      return tokens_.expect_name("the domain's name", problem_.domain, problem_.domain_at);
    if (keyword == ":requirements") return requirements(problem_.requirements);
    if (keyword == ":objects") return lisp::read_typed_list(tokens_, TokenKind::Name, problem_.objects);
    if (keyword == ":init") return init();
    if (keyword == ":goal") return formulas_.formula(problem_.goal);
    if (keyword == ":length") return length();
    if (keyword == ":metric") return metric();
    if (keyword == ":htn" || keyword == ":htn-tihn") return network(keyword, at);
    return unknown(keyword, at,
                   {":domain", ":requirements", ":objects", ":htn", ":init", ":goal", ":metric"});
  }

  bool network(const std::string& form, Place at) {
    problem_.has_network = true;
    if (form != ":htn") {
      tokens_.reporter().error("P0008", at, "task insertion is not supported",
                               "use ':htn': every action comes from a task");
      return false;
    }
    NetworkParser networks(tokens_, formulas_);
    std::set<std::string> seen;
    problem_.network.at = at;
    while (tokens_.at(TokenKind::Keyword)) {
      const Place place = tokens_.peek().at;
      const std::string keyword = tokens_.take().text;
      if (!seen.insert(keyword).second) {
        tokens_.reporter().error("P0007", place, "'" + keyword + "' stands twice here");
        return false;
      }
      const bool good =
          keyword == ":parameters" ? formulas_.parameters(problem_.parameters)
          : NetworkParser::knows(keyword)
              ? networks.part(problem_.network, keyword, place)
              : unknown(keyword, place,
                        {":parameters", ":ordered-subtasks", ":subtasks", ":ordering", ":constraints"});
      if (!good) return false;
    }
    return networks.finish(problem_.network);
  }

  // Costs are added up, and the first plan counts: what is to be minimised says nothing more.
  bool metric() {
    if (!tokens_.at(TokenKind::Name, "minimize")) return tokens_.unexpected("'minimize'");
    tokens_.take();
    if (tokens_.at(TokenKind::Name)) {
      tokens_.take();
      return true;
    }
    ParsedCall function;
    return formulas_.call(function);
  }

  bool init() {
    return elements([&] { return element(); });
  }

  bool element() {
    const lisp::Token& next = tokens_.peek(1);
    if (next.kind == TokenKind::Operator && next.text == "=") return value();
    if (next.kind == TokenKind::Name && next.text == "not") {
      tokens_.take();
      tokens_.take();
      problem_.denied.emplace_back();
      return formulas_.call(problem_.denied.back()) && tokens_.expect(TokenKind::Close, "')'");
    }
    ParsedCall fact;
    if (!formulas_.call(fact)) return false;
    problem_.facts.push_back(std::move(fact));
    return true;
  }

  bool value() {
    tokens_.take();
    tokens_.take();
    ParsedValue value;
    if (tokens_.at(TokenKind::Name)) {
      value.function.at = tokens_.peek().at;
      value.function.name = tokens_.take().text;
    } else if (!formulas_.call(value.function)) {
      return false;
    }
    if (!tokens_.at(TokenKind::Number)) return tokens_.unexpected("a number");
    value.value = tokens_.take().number;
    problem_.values.push_back(std::move(value));
    return tokens_.expect(TokenKind::Close, "')'");
  }

  FormulaParser formulas_{tokens_};
  ParsedProblem problem_;
};

}  // namespace

ParsedProblem parse_problem(std::vector<lisp::Token> tokens, lisp::Reporter& reporter) {
  return ProblemParser(std::move(tokens), reporter).run();
}

}  // namespace stepwright::htn
