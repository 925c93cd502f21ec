#include "supervisor/pddl/plan_file.h"

#include <algorithm>
#include <cctype>
#include <sstream>

#include "supervisor/pddl/syntax/token_stream.h"

namespace stepwright::pddl {
namespace {

// "12:", "0.00:" before the action and "[1.0]" behind it say nothing here: blanks take their place, columns
// stay.
std::string strip(std::string line) {
  const std::size_t comment = line.find(';');
  if (comment != std::string::npos) line.resize(comment);
  const std::size_t open = line.find('(');
  const std::size_t colon = line.find(':');
  if (colon != std::string::npos && colon < open) {
    const bool number = line.find_first_not_of("0123456789. \t", 0) == colon;
    if (number) line.replace(0, colon + 1, colon + 1, ' ');
  }
  const std::size_t close = line.rfind(')');
  const std::size_t bracket = line.find('[', close == std::string::npos ? 0 : close);
  if (bracket != std::string::npos) line.resize(bracket);
  return line;
}

// As for the tokenizer: no text has it.
bool is_no_text(char c) {
  return std::iscntrl(static_cast<unsigned char>(c)) != 0 && std::isspace(static_cast<unsigned char>(c)) == 0;
}

bool action(TokenStream& tokens, model::GroundAction& action) {
  Place at;
  if (!tokens.expect(TokenKind::Open, "an action in parentheses") ||
      !tokens.expect_name("the name of an action", action.name, at)) {
    return false;
  }
  while (!tokens.at(TokenKind::Close)) {
    std::string argument;
    if (tokens.at(TokenKind::End)) {
      tokens.reporter().error("P0404", tokens.peek().at, "the parenthesis is not closed");
      return false;
    }
    if (!tokens.expect_name("an object or ')'", argument, at)) return false;
    action.arguments.push_back(std::move(argument));
  }
  tokens.take();
  return tokens.at(TokenKind::End) || tokens.unexpected("one action per line");
}

}  // namespace

result::Result<PlanText> parse_plan(const Source& source) {
  PlanText plan;
  plan.file = source.file;
  Reporter reporter({source.file});
  std::istringstream lines(source.text);
  std::string line;
  for (std::uint32_t number = 1; std::getline(lines, line); ++number) {
    std::vector<Token> tokens = tokenize(strip(line), 0, reporter, number);
    if (std::any_of(line.begin(), line.end(), is_no_text) && reporter.failed()) break;
    if (tokens.front().kind == TokenKind::End) continue;
    TokenStream stream(std::move(tokens), reporter);
    model::GroundAction step;
    if (!action(stream, step)) continue;
    plan.actions.push_back(std::move(step));
    plan.lines.push_back(number);
  }
  if (reporter.failed()) {
    result::Diagnostics diagnostics = reporter.take();
    for (result::Diagnostic& d : diagnostics) d.code.replace(0, 3, "P04");
    return tl::unexpected<result::Diagnostics>(std::move(diagnostics));
  }
  return plan;
}

std::string print_plan(const model::Plan& plan) {
  std::string text;
  for (const model::GroundAction& action : plan.actions) text += model::to_string(action) + "\n";
  text += "; cost = " + number_text(plan.cost) + (plan.proved_optimal ? " (optimal)\n" : "\n");
  return text;
}

}  // namespace stepwright::pddl
