#include "tests/st/check_program.h"

#include <algorithm>
#include <cstring>
#include <sstream>
#include <stdexcept>

#include "ladder/driver/compile.h"
#include "ladder/syntax/number.h"
#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/bytecode/reader/program_info.h"
#include "runtime/bytecode/reader/read_value.h"
#include "runtime/image/process_image.h"
#include "runtime/scan/scan_cycle.h"
#include "runtime/vm/interpreter.h"

namespace stepwright::st_test {

namespace {

class NoIo final : public image::IoDriver {
 public:
  image::IoStatus read_inputs(std::int64_t, std::span<std::byte>) override { return image::IoStatus::Good; }
  image::IoStatus write_outputs(std::int64_t, std::span<const std::byte>) override { return image::IoStatus::Good; }
};

class NoClock final : public scan::Clock {
 public:
  std::int64_t now_ns() override { return 0; }
};

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
  std::visit([&](auto plain) { out << plain; }, value);
  return out.str();
}

bool equals(const reader::Value& value, const std::string& expected) {
  if (const bool* flag = std::get_if<bool>(&value)) return expected == (*flag ? "TRUE" : "FALSE");
  if (const double* real = std::get_if<double>(&value)) return *real == std::stod(expected);
  if (const auto* whole = std::get_if<std::uint64_t>(&value)) return *whole == std::stoull(expected);
  if (expected.rfind("T#", 0) == 0) return std::get<std::int64_t>(value) == syntax::parse_duration(expected.substr(2));
  return std::get<std::int64_t>(value) == std::stoll(expected);
}

// A program that is being run.
class Run {
 public:
  Run(const std::string& name, const std::string& text) : name_(name), loaded_(compile(name, text)) {
    auto info = reader::ProgramInfo::read(loaded_.bytes());
    if (!info) throw std::runtime_error(result::to_string(info.error()));
    info_.emplace(std::move(*info));
  }

  std::vector<std::string> check(const std::vector<Directive>& directives) {
    const bytecode::Program& program = loaded_.program();
    const bytecode::SizesRecord& sizes = program.sizes();
    std::vector<std::byte> memory(program.image_size());
    std::vector<std::uint64_t> stack(sizes.stack_slots);
    image::ProcessImage image(memory, {sizes.input_bytes, sizes.output_bytes, sizes.marker_bytes, sizes.data_bytes});
    vm::Interpreter engine(program, stack);
    NoIo io;
    NoClock clock;
    scan::ScanCycle cycle(program, engine, image, io, clock, {});
    cycle.start({});
    std::uint64_t last = 0;
    for (const Directive& each : directives) last = std::max(last, each.scan);
    for (std::uint64_t scan = 1; scan <= last; ++scan) {
      for (const Directive& each : directives)
        if (each.kind == DirectiveKind::Set && each.scan == scan) set(each, memory);
      const scan::ScanReport report = cycle.run_scan();
      for (const Directive& each : directives)
        if (each.kind != DirectiveKind::Set && each.scan == scan) compare(each, report, image.bytes());
      const bool expected =
          std::any_of(directives.begin(), directives.end(), [&](const Directive& each) {
            return each.kind == DirectiveKind::Trap && each.scan == scan;
          });
      if (report.trap && !expected) {
        failures_.push_back("unexpected trap: " + result::to_string(reader::describe(program, report.trap)));
        break;
      }
    }
    return std::move(failures_);
  }

 private:
  static reader::LoadedProgram compile(const std::string& name, const std::string& text) {
    driver::CompileInput input;
    input.texts.push_back({name, text});
    auto output = driver::compile(input);
    if (!output) throw std::runtime_error(result::to_string(output.error()));
    auto loaded = reader::LoadedProgram::load(std::move(output->container), name);
    if (!loaded) throw std::runtime_error(result::to_string(loaded.error()));
    return std::move(*loaded);
  }

  void fail(const Directive& directive, const std::string& message) {
    failures_.push_back(name_ + ":" + std::to_string(directive.line) + ": " + message);
  }

  void compare(const Directive& directive, const scan::ScanReport& report, std::span<const std::byte> image) {
    if (directive.kind == DirectiveKind::Trap) {
      const result::Location where = reader::source_location(loaded_.program(), report.trap.function, report.trap.pc);
      const std::string found = std::string(bytecode::name_of(report.trap.code)) + " at " + std::to_string(where.line);
      if (found != directive.variable + " at " + directive.value || where.file != name_)
        fail(directive, "found trap '" + found + "' in " + where.file);
      return;
    }
    const reader::Variable* variable = info_->find(directive.variable);
    if (variable == nullptr) return fail(directive, "no variable " + directive.variable);
    const reader::Value value = reader::read_value(*variable, image);
    if (!equals(value, directive.value))
      fail(directive, directive.variable + " is " + shown(value) + ", not " + directive.value);
  }

  void set(const Directive& directive, std::vector<std::byte>& memory) {
    const reader::Variable* variable = info_->find(directive.variable);
    if (variable == nullptr) return fail(directive, "no variable " + directive.variable);
    std::byte* target = memory.data() + variable->address;
    if (directive.value == "TRUE" || directive.value == "FALSE") {
      const bool value = directive.value == "TRUE";
      if (variable->bit == bytecode::kNoBit) {
        *target = std::byte{value};
      } else {
        const std::byte mask = std::byte{1} << variable->bit;
        *target = value ? *target | mask : *target & ~mask;
      }
      return;
    }
    if (variable->type == bytecode::ElementaryType::Real) {
      const float real = std::stof(directive.value);
      std::memcpy(target, &real, sizeof(real));
      return;
    }
    const bool is_time = directive.value.rfind("T#", 0) == 0;
    const std::int64_t value =
        is_time ? syntax::parse_duration(directive.value.substr(2)).value() : std::stoll(directive.value);
    std::memcpy(target, &value, bytecode::size_of(bytecode::mem_type(variable->type)));
  }

  std::string name_;
  reader::LoadedProgram loaded_;
  std::optional<reader::ProgramInfo> info_;
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
