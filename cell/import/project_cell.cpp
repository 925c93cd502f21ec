#include "cell/import/project_cell.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "cell/config/cell_config.h"
#include "runtime/ground/naming/ascii_names.h"
#include "runtime/ground/naming/direct_address.h"
#include "runtime/ground/settings/toml_document.h"

namespace stepwright::cell_import {
namespace {

using naming::Area;

// A text of one line, as TOML and tables of Markdown have it between other words.
std::string one_line(const std::string& text) {
  std::string line;
  for (const char c : text) {
    const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
    line += control ? ' ' : c == '"' ? '\'' : c == '|' ? '/' : c;
  }
  const std::size_t first = line.find_first_not_of(' ');
  return first == std::string::npos ? "" : line.substr(first, line.find_last_not_of(' ') - first + 1);
}

std::string safe_state(const TakenProject& project) {
  std::string lines;
  std::set<std::string> told;
  for (const Signal& each : project.signals) {
    const auto address = naming::parse_direct_address(each.address);
    if (!address || address->area != Area::Output || address->bits == 64) continue;
    if (!told.insert(each.address).second) continue;
    lines += "\"" + each.address + "\" = \"zero\"   # " + each.name + "\n";
  }
  return lines.empty() ? "# \"%QX0.0\" = \"hold\"\n" : lines;
}

std::string tags(const TakenProject& project) {
  std::string text;
  for (const Signal& each : project.signals) {
    const std::string comment = one_line(each.comment);
    if (comment.empty()) continue;
    text += "\n[tags.\"" + each.name + "\"]\ndescription = \"";
    for (const char c : comment) text += c == '\\' ? std::string("\\\\") : std::string(1, c);
    text += "\"\n";
  }
  return text;
}

// What the device has there, where it is not the signed number that a tag has without words.
std::string wire_type(const Signal& signal) {
  using Wire = std::pair<const char*, const char*>;
  constexpr std::array kWires = {Wire{"WORD", "uint16"},  Wire{"UINT", "uint16"}, Wire{"DWORD", "uint32"},
                                 Wire{"UDINT", "uint32"}, Wire{"REAL", "real"},   Wire{"LREAL", "lreal"},
                                 Wire{"LWORD", "uint64"}, Wire{"ULINT", "uint64"}};
  for (const auto& [type, wire] : kWires)
    if (naming::same_name(signal.type, type)) return std::string(", type = \"") + wire + "\"";
  return {};
}

bool is_field(const Signal& signal) {
  const auto address = naming::parse_direct_address(signal.address);
  return address && address->area != Area::Marker;
}

// An example to change: each signal, at objects of a device in their order.
std::string example(const TakenProject& project) {
  std::string text =
      "\n# Devices over Modbus: take the signs away, leave [plant] out, and say where the device has each of "
      "these.\n"
      "# [io]\n# kind = \"modbus\"\n# [[modbus.device]]\n# name = \"device\"\n# host = \"192.168.1.10\"\n"
      "# [[modbus.device.group]]\n# period_ms = 100\n# tags = [\n";
  int coil = 0;
  int discrete = 0;
  int input = 0;
  int holding = 0;
  std::set<std::string> told;
  for (const Signal& each : project.signals) {
    if (!is_field(each) || !told.insert(each.address).second) continue;
    const auto address = naming::parse_direct_address(each.address);
    const bool output = address->area == Area::Output;
    const bool bit = address->bits == 1;
    int& next = bit ? (output ? coil : discrete) : (output ? holding : input);
    text += "#   { name = \"" + each.name + "\", address = \"" + each.address + "\", " +
            (bit ? (output ? "coil" : "discrete") : (output ? "holding" : "input")) + " = " +
            std::to_string(next) + wire_type(each) + " },\n";
    next += bit ? 1 : std::max(1, address->bits / 16);
  }
  return text + "# ]\n";
}

std::string quoted(const std::string& text) {
  std::string whole = "\"";
  for (const char c : one_line(text)) whole += c == '\\' ? std::string("\\\\") : std::string(1, c);
  return whole + "\"";
}

// As the editor has it; a text where it is no number, so that whoever reads the file says what is wrong.
std::string number(const std::string& text) {
  const bool is_number = !text.empty() && text.size() < 10 &&
                         std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
  if (!is_number) return quoted(text);
  const std::size_t first = text.find_first_not_of('0');
  return first == std::string::npos ? "0" : text.substr(first);
}

std::string place_of(const ForeignDevice& device) {
  if (device.line.empty()) return "host = " + quoted(device.host) + "\nport = " + number(device.port) + "\n";
  return "line = " + quoted(device.line) + "\n";
}

std::string line_of(const ForeignDevice& device) {
  return "\n[modbus.lines." + quoted(device.line) + "]\nbaud = " + number(device.baud) +
         "\nparity = " + quoted(device.parity) + "\nstop_bits = " + number(device.stop_bits) + "\n";
}

// A device with what the program has of it; empty if that is nothing.
std::string device_of(const TakenProject& project, std::size_t index) {
  const ForeignDevice& device = project.devices.devices[index];
  std::string tags;
  std::set<std::string> told;
  for (const Signal& each : project.signals) {
    const auto object = object_at(project.devices, each.before);
    if (!object || object->request->device != index || !told.insert(each.address).second) continue;
    tags += "  { name = \"" + each.name + "\", address = \"" + each.address + "\", " +
            object->request->object + " = " + std::to_string(object->number) + wire_type(each) + " },\n";
  }
  if (tags.empty()) return "";
  return "\n[[modbus.device]]\nname = " + quoted(device.name) + "\n" + place_of(device) +
         "unit = " + number(device.unit) +
         (device.timeout_ms.empty() ? "" : "\ntimeout_ms = " + number(device.timeout_ms)) +
         "\n[[modbus.device.group]]\nperiod_ms = " + number(device.period_ms) + "\ntags = [\n" + tags + "]\n";
}

constexpr const char* kDevices =
    "[io]\nkind = \"modbus\"              # the devices at the end of this file\n"
    "restart = \"auto\"             # when a device that was lost is back, the program starts again\n";

std::uint32_t image_bytes(std::uint32_t needed) {
  return std::max<std::uint32_t>(needed, 8);
}

// What a cell that has this device alone says of it.
std::string wrong_with(const TakenProject& project, const ForeignDevice& device, const std::string& text) {
  const std::string cell =
      "[clock]\nmode = \"real\"\n[image]\ninput_bytes = " + std::to_string(image_bytes(project.input_bytes)) +
      "\noutput_bytes = " + std::to_string(image_bytes(project.output_bytes)) + "\n" + kDevices +
      (device.line.empty() ? "" : line_of(device)) + text;
  result::Diagnostics problems;
  if (auto document = settings::TomlDocument::parse(cell, "cell.toml"))
    problems = config::read_cell_document(**document, "cell.toml").problems;
  else
    problems = document.error();
  std::string wrong;
  for (const result::Diagnostic& each : problems)
    if (each.severity == result::Severity::Error)
      wrong += (wrong.empty() ? "" : "; ") + each.message + (each.hint.empty() ? "" : " (" + each.hint + ")");
  return wrong;
}

// The devices that the editor knows; a line of `left` for each that no cell takes as it is.
std::string devices(const TakenProject& project, std::vector<std::string>& left) {
  std::string text;
  std::set<std::string> lines;
  for (std::size_t i = 0; i < project.devices.devices.size(); ++i) {
    const ForeignDevice& device = project.devices.devices[i];
    const std::string made = device_of(project, i);
    if (made.empty()) continue;
    if (const std::string wrong = wrong_with(project, device, made); !wrong.empty()) {
      left.push_back("the device '" + device.name + "' is not in cell.toml: " + wrong);
      continue;
    }
    if (!device.line.empty() && lines.insert(device.line).second) text += line_of(device);
    text += made;
  }
  return text;
}

// What is at inputs and outputs, the devices at the end of the file, and what the README says of them.
struct Field {
  std::string io;
  std::string devices;
  std::string where;
};

Field field_of(TakenProject& project) {
  std::string known = devices(project, project.left);
  if (!known.empty())
    return {kDevices, std::move(known), "`cell.toml` ends with the devices that the project has them from."};
  return {
      "[plant]\nkind = \"none\"                # inputs stay 0, outputs go nowhere, until there are devices: "
      "see below\n",
      example(project),
      project.signals.empty()
          ? ""
          : "They are 0 and go nowhere until `cell.toml` says what is there: it ends with an example for "
            "Modbus."};
}

std::string table_of_signals(const TakenProject& project) {
  if (project.signals.empty()) return "The project has no variable with an address.\n";
  std::string table = "| variable | address | type | |\n|---|---|---|---|\n";
  for (const Signal& each : project.signals)
    table += "| `" + each.name + "` | `" + each.address + "` | " + one_line(each.type) + " | " +
             one_line(each.comment) + " |\n";
  return table;
}

std::string table_of_tasks(const TakenProject& project) {
  if (project.model.tasks.empty()) return "The project has no task: its one program runs every 10 ms.\n";
  std::string table = "| task | every | priority | programs |\n|---|---|---|---|\n";
  for (const graphic::Task& task : project.model.tasks) {
    std::string programs;
    for (const graphic::ProgramInstance& each : project.model.instances)
      if (each.task == task.name)
        programs += (programs.empty() ? "" : ", ") + each.name + " (" + each.program + ")";
    const std::string when = !task.single.empty()    ? "rising edge of " + task.single
                             : task.interval_us == 0 ? "whenever there is time"
                                                     : std::to_string(task.interval_us) + " µs";
    table +=
        "| " + task.name + " | " + when + " | " + std::to_string(task.priority) + " | " + programs + " |\n";
  }
  return table;
}

std::string moved(const TakenProject& project) {
  if (project.moved.empty()) return "";
  std::string text =
      "\n## Addresses that are others here\nHere an area is bytes: `%QW0` has the bits of `%QX0.0` to "
      "`%QX1.7`. These were told "
      "apart, in programs and declarations (not in comments and texts):\n\n| there | here |\n|---|---|\n";
  for (const auto& [before, now] : project.moved) text += "| `" + before + "` | `" + now + "` |\n";
  return text;
}

}  // namespace

Fillings fillings_of(TakenProject& project) {
  Field field = field_of(project);
  const auto bytes = [](std::uint32_t needed) { return std::to_string(image_bytes(needed)); };
  return {{"project", project.name.empty() ? "the project" : one_line(project.name)},
          {"dialect", project.dialect},
          {"input_bytes", bytes(project.input_bytes)},
          {"output_bytes", bytes(project.output_bytes)},
          {"safe_state", safe_state(project)},
          {"tags", tags(project)},
          {"io", std::move(field.io)},
          {"devices", std::move(field.devices)},
          {"where", std::move(field.where)},
          {"signals", table_of_signals(project)},
          {"tasks", table_of_tasks(project)},
          {"moved", moved(project)}};
}

std::string left_of(const TakenProject& project) {
  if (project.left.empty() && project.problems.empty()) return "Nothing: all of it was taken.\n";
  std::string text;
  for (const std::string& each : project.left) text += "- " + one_line(each) + "\n";
  if (!project.problems.empty()) text += "\nThe cell does not run until this is mended:\n\n";
  for (const result::Diagnostic& each : project.problems) text += "- " + one_line(line_of(each)) + "\n";
  return text;
}

}  // namespace stepwright::cell_import
