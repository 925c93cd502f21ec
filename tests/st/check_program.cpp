#include "tests/st/check_program.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <stdexcept>

#include "ladder/syntax/number.h"
#include "tests/support/compiled_program.h"

namespace stepwright::st_test {

namespace {

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\n");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\n") - first + 1);
}

Directive parse_directive(const std::string& body, std::uint32_t line) {
  Directive directive;
  directive.line = line;
  std::istringstream in(body);
  std::string word;
  in >> word;
  if (word == "SET") directive.kind = DirectiveKind::Set;
  in >> word;
  if (word == "trap") {
    directive.kind = DirectiveKind::Trap;
    in >> word;
  }
  char colon = 0;
  in >> directive.scan >> colon;
  std::string rest;
  std::getline(in, rest);
  const bool is_trap = directive.kind == DirectiveKind::Trap;
  const std::size_t at = is_trap ? rest.rfind(" at ") : rest.find('=');
  if (word != "scan" || colon != ':' || at == std::string::npos)
    throw std::runtime_error("line " + std::to_string(line) + ": not a directive: " + body);
  directive.variable = trimmed(rest.substr(0, at));
  directive.value = trimmed(rest.substr(at + (is_trap ? 4 : 1)));
  return directive;
}

std::string shown(const reader::Value& value) {
  std::ostringstream out;
  out.precision(17);
  out << std::boolalpha;
  std::visit([&](const auto& plain) { out << plain; }, value);
  return out.str();
}

bool equals(const reader::Value& value, const std::string& expected) {
  if (const auto* text = std::get_if<std::string>(&value)) return "'" + *text + "'" == expected;
  if (const bool* flag = std::get_if<bool>(&value)) return expected == (*flag ? "TRUE" : "FALSE");
  if (const double* real = std::get_if<double>(&value)) return *real == std::stod(expected);
  if (const auto* whole = std::get_if<std::uint64_t>(&value)) return *whole == std::stoull(expected);
  if (expected.rfind("T#", 0) == 0)
    return std::get<std::int64_t>(value) == syntax::parse_duration(expected.substr(2));
  return std::get<std::int64_t>(value) == std::stoll(expected);
}

driver::CompileInput input_of(const std::string& name, const std::string& text) {
  driver::CompileInput input;
  input.texts.push_back({name, text});
  return input;
}

// A program that is being run.
class Run {
 public:
  Run(const std::string& name, const std::string& text) : name_(name), program_(input_of(name, text)) {}

  std::vector<std::string> check(const std::vector<Directive>& directives) {
    std::uint64_t last = 0;
    for (const Directive& each : directives) last = std::max(last, each.scan);
    for (std::uint64_t scan = 1; scan <= last; ++scan) {
      for (const Directive& each : directives)
        if (each.kind == DirectiveKind::Set && each.scan == scan) set(each);
      const scan::ScanReport report = program_.scan();
      bool trap_expected = false;
      for (const Directive& each : directives) {
        if (each.kind == DirectiveKind::Set || each.scan != scan) continue;
        trap_expected = trap_expected || each.kind == DirectiveKind::Trap;
        compare(each, report);
      }
      if (report.trap && !trap_expected) {
        const result::Diagnostic trap = reader::describe(program_.loaded().program(), report.trap);
        failures_.push_back("unexpected trap: " + result::to_string(trap));
        break;
      }
    }
    return std::move(failures_);
  }

 private:
  void fail(const Directive& directive, const std::string& message) {
    failures_.push_back(name_ + ":" + std::to_string(directive.line) + ": " + message);
  }

  void compare(const Directive& directive, const scan::ScanReport& report) {
    if (directive.kind == DirectiveKind::Trap) {
      const result::Location where =
          reader::source_location(program_.loaded().program(), report.trap.function, report.trap.pc);
      const std::string found =
          std::string(bytecode::name_of(report.trap.code)) + " at " + std::to_string(where.line);
      if (found != directive.variable + " at " + directive.value || where.file != name_)
        fail(directive, "found trap '" + found + "' in " + where.file);
      return;
    }
    const std::string text = program_.text(directive.variable);
    if (text == directive.value) return;
    const reader::Value value = program_.value(directive.variable);
    const bool is_word = std::isalpha(static_cast<unsigned char>(directive.value.front())) != 0;
    const bool is_plain = !is_word || directive.value == "TRUE" || directive.value == "FALSE";
    if (!is_plain && directive.value.rfind("T#", 0) != 0)
      return fail(directive, directive.variable + " is " + text + ", not " + directive.value);
    if (!equals(value, directive.value))
      fail(directive, directive.variable + " is " + shown(value) + ", not " + directive.value);
  }

  void set(const Directive& directive) {
    const bool is_time = directive.value.rfind("T#", 0) == 0;
    const bool is_bool = directive.value == "TRUE" || directive.value == "FALSE";
    program_.set(directive.variable, is_bool   ? directive.value == "TRUE"
                                     : is_time ? syntax::parse_duration(directive.value.substr(2)).value()
                                               : std::stoll(directive.value));
  }

  std::string name_;
  support::CompiledProgram program_;
  std::vector<std::string> failures_;
};

}  // namespace

std::vector<Directive> directives_of(const std::string& text) {
  std::vector<Directive> directives;
  std::uint32_t line = 1;
  std::size_t seen = 0;
  for (std::size_t at = text.find("(* "); at != std::string::npos; at = text.find("(* ", at + 1)) {
    line += static_cast<std::uint32_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(seen),
                                                  text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
    seen = at;
    const std::string body = text.substr(at + 3, text.find("*)", at) - at - 3);
    if (body.rfind("CHECK ", 0) == 0 || body.rfind("SET ", 0) == 0)
      directives.push_back(parse_directive(body, line));
  }
  return directives;
}

std::vector<std::string> run_checks(const std::string& name, const std::string& text) {
  return Run(name, text).check(directives_of(text));
}

}  // namespace stepwright::st_test
