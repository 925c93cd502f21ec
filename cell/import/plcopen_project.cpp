#include "cell/import/plcopen_project.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>
#include <tuple>

#include "cell/import/address_plan.h"
#include "cell/import/address_tokens.h"
#include "cell/import/instruction_lists.h"
#include "cell/import/located_lengths.h"
#include "cell/import/named_bodies.h"
#include "ladder/driver/compile.h"
#include "ladder/exchange/plcopen_reader.h"
#include "ladder/source/codes.h"
#include "runtime/bytecode/reader/program_info.h"
#include "runtime/ground/files/files.h"
#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::cell_import {
namespace {

constexpr const char* kFileName = "main.xml";

result::Result<std::string> read_text(const std::filesystem::path& path, std::filesystem::path& file) {
  std::error_code error;
  file = std::filesystem::is_directory(path, error) ? path / "plc.xml" : path;
  if (std::filesystem::is_directory(path, error) && !std::filesystem::is_regular_file(file, error))
    return result::fail("M0020", {path.string(), 0, 0}, "this folder has no plc.xml",
                        "OpenPLC Editor 4 and CODESYS export one: PLCopen XML");
  auto text = files::read_file(file.string());
  if (!text) return text;
  const std::size_t first = text->find_first_not_of(" \t\r\n");
  if (first != std::string::npos && (*text)[first] == '{')
    return result::fail("M0020", {file.string(), 0, 0}, "this is JSON and no PLCopen project",
                        "have the editor export PLCopen XML, and take that");
  return text;
}

void add_signals(const std::string& prefix, const std::vector<graphic::Variable>& variables,
                 std::vector<Signal>& signals) {
  for (const graphic::Variable& each : variables)
    if (!each.address.empty())
      signals.push_back({prefix + each.name, each.address, {}, each.type, each.comment});
}

std::vector<Signal> signals_of(const graphic::Project& project) {
  std::vector<Signal> signals;
  add_signals("", project.globals, signals);
  for (const graphic::Resource& resource : project.resources) add_signals("", resource.globals, signals);
  for (const graphic::Pou& pou : project.pous) {
    if (pou.kind != graphic::PouKind::Program) continue;
    bool instance = false;
    for (const graphic::ProgramInstance& each : project.instances) {
      if (!naming::same_name(each.program, pou.name)) continue;
      instance = true;
      add_signals(each.name + ".", pou.variables, signals);
    }
    if (!instance) add_signals(pou.name + ".", pou.variables, signals);
  }
  const auto place = [](const Signal& signal) {
    const auto address = naming::parse_direct_address(signal.address);
    return address ? std::make_tuple(static_cast<int>(address->area), address->byte, address->bit)
                   : std::make_tuple(9, 0u, std::uint8_t{0});
  };
  std::ranges::stable_sort(signals, [&](const Signal& a, const Signal& b) { return place(a) < place(b); });
  return signals;
}

// Blocks of Beremiz that can be called and do nothing.
void tell_idle_blocks(const graphic::Project& project, std::vector<std::string>& left) {
  constexpr std::array kIdle = {"LOGGER", "PYTHON_EVAL", "PYTHON_POLL", "PYTHON_GEAR"};
  for (const graphic::Pou& pou : project.pous) {
    for (const graphic::Variable& each : pou.variables) {
      if (std::ranges::any_of(kIdle, [&](const char* idle) { return naming::same_name(each.type, idle); }))
        left.push_back(pou.name + "." + each.name + ": a " + each.type + " does nothing here");
    }
  }
}

bool says_something(const std::string& text) {
  return text.find_first_not_of(" \t\r\n") != std::string::npos;
}

bool has_body(const graphic::Pou& pou) {
  if (const auto* text = std::get_if<graphic::StBody>(&pou.body)) return says_something(text->text);
  const auto* drawn = std::get_if<graphic::DrawnBody>(&pou.body);
  if (drawn == nullptr || says_something(drawn->body.text.text)) return true;
  return std::ranges::any_of(drawn->body.diagram.elements, [](const graphic::Element& each) {
    using enum graphic::ElementKind;
    return each.kind != Comment && each.kind != LeftPowerRail && each.kind != RightPowerRail;
  });
}

void tell_empty_pous(const graphic::Project& project, std::vector<std::string>& left) {
  for (const graphic::Pou& pou : project.pous)
    if (!has_body(pou)) left.push_back(pou.name + ": it has no body, so it does nothing");
}

void tell_vendor_data(const std::string& text, std::vector<std::string>& left) {
  constexpr std::string_view kData = "<data name=";
  std::set<std::string> names;
  for (std::size_t at = text.find(kData); at != std::string::npos; at = text.find(kData, at + 1)) {
    const std::size_t begin = at + kData.size() + 1;
    const std::size_t end = text.find(text[begin - 1], begin);
    if (end != std::string::npos && end - begin < 200) names.insert(text.substr(begin, end - begin));
  }
  for (const std::string& name : names) left.push_back("data of the other system, kept in the file: " + name);
}

// What a project of an editor keeps beside its plc.xml: devices, extensions, pages.
void tell_neighbours(const std::filesystem::path& folder, std::vector<std::string>& left) {
  std::set<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder.empty() ? "." : folder, error)) {
    const std::string name = entry.path().filename().string();
    const bool node = entry.is_directory(error) && name.find('@') != std::string::npos;
    if (node || name == "mbconfig.cfg") names.insert(name);
  }
  for (const std::string& name : names) {
    if (name.ends_with("@modbus")) continue;  // read_beremiz_devices
    left.push_back("devices and extensions in " + name +
                   ": devices over Modbus go into [[modbus.device]] of cell.toml");
  }
}

// Where devices are known, what none of them has, or not all of.
void tell_signals_without_device(TakenProject& taken, const std::map<std::string, std::uint32_t>& lengths) {
  taken.left.insert(taken.left.end(), taken.devices.left.begin(), taken.devices.left.end());
  if (taken.devices.devices.empty()) return;
  for (const Signal& each : taken.signals) {
    const auto address = naming::parse_direct_address(each.address);
    if (!address || address->area == naming::Area::Marker) continue;
    const auto length = lengths.find(each.before);
    if (!object_at(taken.devices, each.before))
      taken.left.push_back(each.name + " at " + each.before + ": no request of a device reads or writes it");
    else if (length != lengths.end() && length->second > address->bits)
      taken.left.push_back(each.name + " at " + each.before + ": " + each.type +
                           ", of which only the first value has a tag in cell.toml");
  }
}

std::string before_of(const AddressPlan& plan, const std::string& now) {
  for (const auto& [before, after] : plan.moved())
    if (after == now) return before;
  return now;
}

// The program as the cell will have it: what keeps it from running, and what of it is code of others.
void try_program(TakenProject& taken, const source::Dialect& dialect) {
  driver::CompileInput input;
  input.projects = {&taken.model};
  input.dialect = &dialect;
  const auto output = driver::compile(input);
  if (!output) {
    for (const result::Diagnostic& each : output.error())
      if (each.severity == result::Severity::Error) taken.problems.push_back(each);
    return;
  }
  // Whatever the plan of the addresses has missed.
  if (const auto info = reader::ProgramInfo::read(output->container)) {
    taken.input_bytes = std::max(taken.input_bytes, info->sizes().input_bytes);
    taken.output_bytes = std::max(taken.output_bytes, info->sizes().output_bytes);
  }
  for (const result::Diagnostic& each : output->warnings)
    if (each.code == source::code::kForeignCode || each.code == source::code::kLooseEnd)
      taken.left.push_back(line_of(each));
}

}  // namespace

std::string line_of(const result::Diagnostic& problem) {
  return problem.where.file + ":" + std::to_string(problem.where.line) + ":" +
         std::to_string(problem.where.column) + ": " + problem.code + ": " + problem.message;
}

result::Result<TakenProject> read_project(const std::filesystem::path& path, const ProjectOptions& options) {
  std::filesystem::path file;
  auto text = read_text(path, file);
  if (!text) return result::forward(text);
  const source::Dialect* const dialect = source::find_dialect(options.dialect);
  // Once as it is, so that whatever is wrong is told at its place in the file that somebody has.
  auto read = exchange::read_plcopen(file.string(), *text, *dialect, options.configuration);
  if (!read) return result::forward(read);
  TakenProject taken;
  const std::string kept = without_instruction_lists(*read, taken.left);
  const auto lengths = located_lengths(*read, *dialect, taken.left);
  const AddressPlan plan(addresses_in(kept), lengths);
  taken.name = read->name;
  taken.dialect = options.dialect;
  taken.xml = with_addresses(kept, [&](const std::string& each) { return plan.address(each); });
  auto model = exchange::read_plcopen(kFileName, taken.xml, *dialect, options.configuration);
  if (!model) return result::forward(model);
  taken.model = std::move(*model);
  taken.signals = signals_of(taken.model);
  for (Signal& each : taken.signals) each.before = before_of(plan, each.address);
  taken.devices = read_beremiz_devices(file.parent_path());
  taken.input_bytes = plan.bytes(naming::Area::Input);
  taken.output_bytes = plan.bytes(naming::Area::Output);
  taken.moved = plan.moved();
  for (const std::string& each : plan.unknown()) taken.left.push_back("an address that no cell has: " + each);
  try_program(taken, *dialect);
  tell_idle_blocks(taken.model, taken.left);
  tell_named_bodies(*read, taken.left);
  tell_empty_pous(taken.model, taken.left);
  tell_vendor_data(*text, taken.left);
  tell_neighbours(file.parent_path(), taken.left);
  tell_signals_without_device(taken, lengths);
  return taken;
}

}  // namespace stepwright::cell_import
