#include "supervisor/pddl/syntax/formula_parser.h"
#include "supervisor/pddl/syntax/parser.h"

namespace stepwright::pddl {
namespace {

class ProblemParser : private lisp::SectionParser {
 public:
  ProblemParser(std::vector<Token> tokens, Reporter& reporter) : SectionParser(std::move(tokens), reporter) {}

  ParsedProblem run() {
    if (define("problem", problem_.name, problem_.at)) {
      sections([this](const std::string& keyword, Place at) { return section(keyword, at); });
      if (!problem_.has_goal && !goal_tried_) {
        tokens_.reporter().error("P0113", problem_.at, "the problem has no goal", "add a ':goal' section");
      }
    }
    return std::move(problem_);
  }

  Formula goal() {
    Formula formula;
    if (formulas_.formula(formula) && !tokens_.at(TokenKind::End)) tokens_.unexpected("the end of the goal");
    return formula;
  }

 private:
  bool section(const std::string& keyword, Place at) {
    if (!once(keyword, at)) return false;
    if (keyword == ":domain")
      return tokens_.expect_name("the domain's name", problem_.domain, problem_.domain_at);
    if (keyword == ":requirements") return requirements(problem_.requirements);
    if (keyword == ":objects") return formulas_.typed_list(TokenKind::Name, problem_.objects);
    if (keyword == ":init") return init();
    if (keyword == ":metric") return metric();
    if (keyword == ":length") return length();
    if (keyword == ":goal") {
      goal_tried_ = true;
      problem_.has_goal = formulas_.formula(problem_.goal);
      return problem_.has_goal;
    }
    return unknown(keyword, at, {":domain", ":requirements", ":objects", ":init", ":goal", ":metric"});
  }

  bool init() {
    return elements([&] { return element(); });
  }

  bool element() {
    const Token& next = tokens_.peek(1);
    if (next.kind == TokenKind::Operator && next.text == "=") return fluent();
    if (next.kind == TokenKind::Name && next.text == "not") return denial();
    if (next.kind == TokenKind::Name && next.text == "and") {
      tokens_.reporter().error("P0008", next.at, "'and' cannot stand in ':init'",
                               "all that is listed there holds together");
      tokens_.take();
      return false;
    }
    if (next.kind == TokenKind::Name && next.text == "at" && tokens_.peek(2).kind == TokenKind::Number) {
      tokens_.reporter().error("P0008", next.at, "timed initial literals are not supported here",
                               "facts and fluents change by actions only");
      tokens_.take();
      return false;
    }
    Call fact;
    if (!formulas_.call(fact)) return false;
    problem_.facts.push_back(std::move(fact));
    return true;
  }

  bool denial() {
    tokens_.take();
    tokens_.take();
    problem_.denied.emplace_back();
    return formulas_.call(problem_.denied.back()) && tokens_.expect(TokenKind::Close, "')'");
  }

  bool fluent() {
    tokens_.take();
    tokens_.take();
    InitialFluent initial;
    if (tokens_.at(TokenKind::Name)) {
      initial.call.at = tokens_.peek().at;
      initial.call.name = tokens_.take().text;
    } else if (!formulas_.call(initial.call)) {
      return false;
    }
    if (!tokens_.at(TokenKind::Number)) return tokens_.unexpected("a number");
    initial.value = tokens_.take().number;
    problem_.fluents.push_back(std::move(initial));
    return tokens_.expect(TokenKind::Close, "')'");
  }

  bool metric() {
    Metric metric;
    metric.maximize = tokens_.at(TokenKind::Name, "maximize");
    if (!metric.maximize && !tokens_.at(TokenKind::Name, "minimize")) {
      return tokens_.unexpected("'minimize' or 'maximize'");
    }
    tokens_.take();
    if (!formulas_.expression(metric.expression)) return false;
    problem_.metric = std::move(metric);
    return true;
  }

  FormulaParser formulas_{tokens_};
  ParsedProblem problem_;
  bool goal_tried_ = false;
};

}  // namespace

ParsedProblem parse_problem(std::vector<Token> tokens, Reporter& reporter) {
  return ProblemParser(std::move(tokens), reporter).run();
}

Formula parse_goal(std::vector<Token> tokens, Reporter& reporter) {
  return ProblemParser(std::move(tokens), reporter).goal();
}

}  // namespace stepwright::pddl
