#include "supervisor/pddl/plan/plan_file.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>

#include "supervisor/pddl/syntax/lexer.h"

namespace stepwright::pddl {
namespace {

// What stands between the actions of a line: time stamps ("12:", "0.00:") and durations ("[1.0]").
struct Stamp {
  std::uint32_t column = 0;  // from 1
  double time = 0.0;
};

// The number and the colon behind it that begin at `at`; nothing if they do not.
std::optional<Stamp> stamp_at(const std::string& line, std::size_t at, std::size_t& end) {
  double time = 0.0;
  const auto [rest, status] = std::from_chars(line.data() + at, line.data() + line.size(), time);
  if (status != std::errc() || !std::isfinite(time)) return std::nullopt;
  end = line.find_first_not_of(" \t", static_cast<std::size_t>(rest - line.data()));
  if (end == std::string::npos || line[end] != ':') return std::nullopt;
  ++end;
  return Stamp{static_cast<std::uint32_t>(at + 1), time};
}

// Takes them and the comment out of the line: blanks take their place, columns stay.
std::vector<Stamp> take_stamps(std::string& line) {
  if (const std::size_t comment = line.find(';'); comment != std::string::npos) line.resize(comment);
  std::vector<Stamp> stamps;
  bool inside = false;
  for (std::size_t at = 0; at < line.size(); ++at) {
    if (line[at] == '(' || line[at] == ')') inside = line[at] == '(';
    if (inside) continue;
    std::size_t end = at;
    if (line[at] == '[') {
      end = std::min(line.find(']', at), line.size() - 1) + 1;
    } else if (const auto stamp = stamp_at(line, at, end)) {
      stamps.push_back(*stamp);
    } else {
      continue;
    }
    std::fill(line.begin() + static_cast<std::ptrdiff_t>(at), line.begin() + static_cast<std::ptrdiff_t>(end),
              ' ');
    at = end - 1;
  }
  return stamps;
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
  return true;
}

// An action, its line and its time.
struct Step {
  model::GroundAction action;
  std::uint32_t line = 0;
  double time = 0.0;
};

// The actions of a line. One without a time stamp comes when the one before it does.
void line_of_actions(TokenStream& tokens, const std::vector<Stamp>& stamps, std::vector<Step>& steps) {
  auto next = stamps.begin();
  while (!tokens.at(TokenKind::End)) {
    const Place at = tokens.peek().at;
    Step step{{}, at.line, steps.empty() ? 0.0 : steps.back().time};
    for (; next != stamps.end() && next->column < at.column; ++next) step.time = next->time;
    if (!action(tokens, step.action)) return;
    steps.push_back(std::move(step));
  }
}

}  // namespace

result::Result<PlanText> parse_plan(const Source& source) {
  PlanText plan;
  plan.file = source.file;
  Reporter reporter({source.file});
  std::istringstream lines(source.text);
  std::string line;
  std::vector<Step> steps;
  for (std::uint32_t number = 1; std::getline(lines, line); ++number) {
    const std::vector<Stamp> stamps = take_stamps(line);
    TokenStream tokens(tokenize(line, 0, reporter, number), reporter);
    if (std::any_of(line.begin(), line.end(), is_no_text) && reporter.failed()) break;
    line_of_actions(tokens, stamps, steps);
  }
  if (reporter.failed()) {
    result::Diagnostics diagnostics = reporter.take();
    for (result::Diagnostic& d : diagnostics) d.code.replace(0, 3, "P04");
    return tl::unexpected<result::Diagnostics>(std::move(diagnostics));
  }
  std::stable_sort(steps.begin(), steps.end(), [](const Step& a, const Step& b) { return a.time < b.time; });
  for (Step& step : steps) {
    plan.actions.push_back(std::move(step.action));
    plan.lines.push_back(step.line);
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
