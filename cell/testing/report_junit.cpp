#include <cstdio>
#include <map>
#include <pugixml.hpp>
#include <span>
#include <sstream>

#include "cell/testing/report.h"
#include "runtime/bytecode/utf8.h"

namespace stepwright::cell_testing {

namespace {

// What XML 1.0 can hold: no control characters, no broken UTF-8.
std::string xml_text(const std::string& text) {
  const bool good = bytecode::is_utf8({text.data(), text.size()});
  std::string out;
  for (const char each : text) {
    const auto code = static_cast<unsigned char>(each);
    const bool control = (code < 0x20 && each != '\n' && each != '\t') || code == 0x7F;
    out += control || (!good && code >= 0x80) ? '?' : each;
  }
  return out;
}

std::string seconds(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.6f", value);
  return text;
}

void set(pugi::xml_node node, const char* name, const std::string& value) {
  node.append_attribute(name) = xml_text(value).c_str();
}

void add_counts(pugi::xml_node node, std::size_t tests, std::size_t failures, std::size_t errors,
                double wall_s) {
  node.append_attribute("tests") = static_cast<unsigned long long>(tests);
  node.append_attribute("failures") = static_cast<unsigned long long>(failures);
  node.append_attribute("errors") = static_cast<unsigned long long>(errors);
  node.append_attribute("skipped") = 0;
  set(node, "time", seconds(wall_s));
}

// A failure, or the error of wrong sources.
void add_problem(pugi::xml_node test_case, const char* element, const std::string& type,
                 const std::string& message, const std::string& text) {
  pugi::xml_node node = test_case.append_child(element);
  set(node, "type", type);
  set(node, "message", message);
  node.text() = xml_text(text).c_str();
}

void add_suite(pugi::xml_node root, const std::string& file, const std::vector<const TestResult*>& tests) {
  pugi::xml_node suite = root.append_child("testsuite");
  set(suite, "name", file);
  double wall_s = 0;
  std::size_t failures = 0;
  for (const TestResult* each : tests) {
    wall_s += each->wall_us * 1e-6;
    failures += each->passed() ? 0 : 1;
  }
  add_counts(suite, tests.size(), failures, 0, wall_s);
  for (const TestResult* each : tests) {
    pugi::xml_node test_case = suite.append_child("testcase");
    set(test_case, "name", each->name);
    set(test_case, "classname", file);
    set(test_case, "file", file);
    test_case.append_attribute("line") = each->where.line;
    set(test_case, "time", seconds(each->wall_us * 1e-6));
    if (each->failure) {
      const result::Diagnostic& what = each->failure->diagnostic;
      const std::string type = !what.code.empty() ? what.code : each->failure->statement;
      add_problem(test_case, "failure", type, what.message, result::to_string(what));
    }
    test_case.append_child("system-out").text() =
        ("simulated_s " + seconds(static_cast<double>(each->simulated_ns) * 1e-9) + ", scans " +
         std::to_string(each->scans))
            .c_str();
  }
}

}  // namespace

std::string to_junit(const TestReport& report) {
  pugi::xml_document document;
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "UTF-8";
  pugi::xml_node root = document.append_child("testsuites");
  set(root, "name", "stepwright");
  const bool wrong = result::has_errors(report.diagnostics);
  add_counts(root, report.tests.size() + (wrong ? 1 : 0), report.failed(), wrong ? 1 : 0, report.wall_s);
  std::map<std::string, std::vector<const TestResult*>> files;
  for (const TestResult& each : report.tests) files[each.where.file].push_back(&each);
  for (const auto& [file, tests] : files) add_suite(root, file, tests);
  if (wrong) {
    pugi::xml_node suite = root.append_child("testsuite");
    set(suite, "name", "sources");
    add_counts(suite, 1, 0, 1, report.wall_s);
    pugi::xml_node test_case = suite.append_child("testcase");
    set(test_case, "name", "the sources compile");
    set(test_case, "classname", "sources");
    set(test_case, "time", seconds(report.wall_s));
    const result::Diagnostic& first = report.diagnostics.front();
    add_problem(test_case, "error", first.code, first.message, result::to_string(report.diagnostics));
  }
  std::ostringstream out;
  document.save(out, "  ");
  return out.str();
}

}  // namespace stepwright::cell_testing
