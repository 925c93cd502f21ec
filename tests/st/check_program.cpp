#include "tests/st/check_program.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "ladder/driver/compile.h"
#include "tests/st/machine.h"

namespace stepwright::st_test {

namespace {

std::string place(std::uint32_t line) {
  return std::to_string(line);
}

class Check {
 public:
  Check(const std::string& name, const std::string& text)
      : name_(name), text_(text), directives_(directives_of(text)) {}

  std::vector<std::string> run() {
    driver::CompileInput input;
    input.texts.push_back({name_, text_});
    auto output = driver::compile(input);
    compare(output ? output->warnings : output.error());
    if (!output) return failures_;
    auto loaded = reader::LoadedProgram::load(std::move(output->container), name_);
    if (!loaded) {
      failures_.push_back(result::to_string(loaded.error()));
      return failures_;
    }
    for (const EngineKind each : engines()) machines_.push_back(std::make_unique<Machine>(*loaded, each));
    run_scans(loaded->program());
    return failures_;
  }

 private:
  void fail(std::uint32_t line, const std::string& message) {
    failures_.push_back(name_ + ":" + place(line) + ": " + message);
  }

  // Every diagnostic is expected, and every expected one is there.
  void compare(const result::Diagnostics& found) {
    std::vector<bool> expected(found.size(), false);
    for (const Directive& each : directives_) {
      if (each.kind != DirectiveKind::Diagnostic) continue;
      bool met = false;
      for (std::size_t i = 0; i < found.size() && !met; ++i) {
        const result::Location& where = found[i].where;
        met = !expected[i] && found[i].code == each.subject && where.line == each.at_line &&
              (each.at_column == 0 || where.column == each.at_column);
        if (met) expected[i] = true;
      }
      if (!met)
        fail(each.line, "no " + each.subject + " at " + place(each.at_line) + ":" + place(each.at_column));
    }
    for (std::size_t i = 0; i < found.size(); ++i)
      if (!expected[i] && (found[i].severity == result::Severity::Error || checks_warnings()))
        failures_.push_back("unexpected: " + result::to_string(found[i]));
  }

  // A program that names a warning names all of them.
  bool checks_warnings() const {
    return std::ranges::any_of(directives_, [](const Directive& each) {
      return each.kind == DirectiveKind::Diagnostic && each.subject.front() == 'W';
    });
  }

  void run_scans(const bytecode::Program& program) {
    std::uint64_t last = 0;
    for (const Directive& each : directives_)
      if (each.kind == DirectiveKind::Check || each.kind == DirectiveKind::Trap)
        last = std::max(last, each.scan);
    for (std::uint64_t scan = 1; scan <= last; ++scan) {
      for (auto& machine : machines_) prepare(*machine, scan);
      const scan::ScanReport report = machines_.front()->scan();
      for (std::size_t i = 1; i < machines_.size(); ++i) compare_engines(report, machines_[i]->scan(), i);
      if (!compare(program, report)) return;
    }
  }

  void prepare(Machine& machine, std::uint64_t scan) {
    machine.restart_after_trap();
    for (const Directive& each : directives_)
      if (each.kind == DirectiveKind::Set && each.scan == scan) machine.set(each.subject, each.value);
  }

  void compare_engines(const scan::ScanReport& first, const scan::ScanReport& other, std::size_t index) {
    const std::string where =
        std::string("scan ") + std::to_string(first.scan) + ": engine " + name_of(engines()[index]);
    if (first.image_hash != other.image_hash)
      failures_.push_back(name_ + ": " + where + " leaves another image");
    if (first.trap != other.trap)
      failures_.push_back(name_ + ": " + where + " traps otherwise: " + bytecode::name_of(other.trap.code));
  }

  // False if it cannot go on.
  bool compare(const bytecode::Program& program, const scan::ScanReport& report) {
    bool trap_expected = false;
    for (const Directive& each : directives_) {
      if (each.scan != report.scan) continue;
      if (each.kind == DirectiveKind::Check) {
        if (!machines_.front()->equals(each.subject, each.value))
          fail(each.line,
               each.subject + " is " + machines_.front()->shown(each.subject) + ", not " + each.value);
      } else if (each.kind == DirectiveKind::Trap) {
        trap_expected = true;
        compare_trap(program, report.trap, each);
      }
    }
    if (!report.trap || trap_expected) return true;
    failures_.push_back("unexpected trap: " + result::to_string(reader::describe(program, report.trap)));
    return false;
  }

  void compare_trap(const bytecode::Program& program, const bytecode::Trap& trap, const Directive& expected) {
    if (!trap) return fail(expected.line, "no trap");
    const result::Location where = reader::trap_location(program, trap);
    const bool column = expected.at_column == 0 || where.column == expected.at_column;
    if (bytecode::name_of(trap.code) != expected.subject || where.line != expected.at_line || !column ||
        where.file != name_)
      fail(expected.line, std::string("found trap '") + bytecode::name_of(trap.code) + "' at " + where.file +
                              ":" + place(where.line) + ":" + place(where.column) + ", not '" +
                              expected.subject + "' at " + place(expected.at_line) + ":" +
                              place(expected.at_column));
  }

  std::string name_;
  std::string text_;
  std::vector<Directive> directives_;
  std::vector<std::unique_ptr<Machine>> machines_;
  std::vector<std::string> failures_;
};

}  // namespace

std::vector<std::string> run_checks(const std::string& name, const std::string& text) {
  try {
    return Check(name, text).run();
  } catch (const std::runtime_error& error) {
    return {name + ": " + error.what()};
  }
}

std::vector<std::string> programs_below(const std::string& root) {
  namespace fs = std::filesystem;
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(root))
    if (entry.path().extension() == ".st") names.push_back(fs::relative(entry.path(), root).generic_string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace stepwright::st_test
