#include "tests/st/directive.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace stepwright::st_test {

namespace {

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

[[noreturn]] void refuse(const std::string& body, std::uint32_t line) {
  throw std::runtime_error("line " + std::to_string(line) + ": not a directive: " + body);
}

// "division by zero at 7" or "E0301 at 7:12": cuts the place off.
void take_place(std::string& text, Directive& directive) {
  directive.at_line = directive.line;
  const std::size_t at = text.rfind(" at ");
  if (at != std::string::npos) {
    std::istringstream place(text.substr(at + 4));
    char colon = 0;
    place >> directive.at_line >> colon >> directive.at_column;
    text.resize(at);
  }
  directive.subject = trimmed(text);
}

// "scan 3:" at the beginning, if it is there.
void take_scan(std::string& rest, Directive& directive) {
  if (rest.rfind("scan ", 0) != 0) return;
  const std::size_t colon = rest.find(':');
  if (colon == std::string::npos) refuse(rest, directive.line);
  directive.scan = std::stoull(rest.substr(5, colon - 5));
  rest = trimmed(rest.substr(colon + 1));
}

Directive run_directive(DirectiveKind kind, std::string rest, std::uint32_t line) {
  Directive directive{.kind = kind, .line = line};
  if (kind == DirectiveKind::Check && rest.rfind("trap ", 0) == 0) {
    directive.kind = DirectiveKind::Trap;
    rest = trimmed(rest.substr(5));
    take_scan(rest, directive);
    take_place(rest, directive);
    return directive;
  }
  take_scan(rest, directive);
  const std::size_t equals = rest.find('=');
  if (equals == std::string::npos) refuse(rest, line);
  directive.subject = trimmed(rest.substr(0, equals));
  directive.value = trimmed(rest.substr(equals + 1));
  return directive;
}

void parse(const std::string& body, std::uint32_t line, std::vector<Directive>& out) {
  const std::size_t space = std::min(body.find_first_of(" \n"), body.size());
  const std::string word = body.substr(0, space);
  std::string rest = trimmed(body.substr(space));
  if (word == "SET") return out.push_back(run_directive(DirectiveKind::Set, rest, line));
  if (word == "CHECK") return out.push_back(run_directive(DirectiveKind::Check, rest, line));
  if (word == "ERROR" || word == "WARNING") {
    Directive directive{.kind = DirectiveKind::Diagnostic, .line = line};
    take_place(rest, directive);
    return out.push_back(directive);
  }
  if (word != "REQ") return;
  std::istringstream ids(rest);
  for (std::string id; ids >> id;)
    out.push_back({.kind = DirectiveKind::Requirement, .subject = id, .line = line});
}

}  // namespace

std::vector<Directive> directives_of(const std::string& text) {
  std::vector<Directive> directives;
  std::uint32_t line = 1;
  std::size_t seen = 0;
  for (std::size_t at = text.find("(* "); at != std::string::npos; at = text.find("(* ", at + 1)) {
    line += static_cast<std::uint32_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(seen),
                                                  text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
    seen = at;
    const std::size_t end = std::min(text.find("*)", at), text.size());
    parse(trimmed(text.substr(at + 3, end - at - 3)), line, directives);
  }
  return directives;
}

}  // namespace stepwright::st_test
