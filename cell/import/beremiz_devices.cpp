#include "cell/import/beremiz_devices.h"

#include <algorithm>
#include <charconv>
#include <map>

#include "ladder/exchange/settings_element.h"
#include "ladder/syntax/direct_address.h"
#include "runtime/ground/files/files.h"

namespace stepwright::cell_import {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMostBytes = 1u << 20;

// One folder NAME@KIND with its channel and settings; nothing for any other.
struct Node {
  fs::path folder;
  std::string name;
  std::string kind;
  std::uint32_t channel = 0;
  exchange::SettingsElement settings;
};

std::optional<exchange::SettingsElement> settings_in(const fs::path& file) {
  auto text = files::read_file(file.string(), kMostBytes);
  if (!text) return std::nullopt;
  auto element = exchange::read_settings_element(file.string(), std::move(*text));
  if (!element) return std::nullopt;
  return std::move(*element);
}

std::uint32_t number_of(const std::string& text, std::uint32_t otherwise) {
  std::uint32_t number = 0;
  const char* const end = text.data() + text.size();
  return std::from_chars(text.data(), end, number).ptr == end && !text.empty() ? number : otherwise;
}

std::vector<Node> nodes_in(const fs::path& folder) {
  std::vector<Node> nodes;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, error)) {
    const std::string name = entry.path().filename().string();
    const std::size_t at = name.find('@');
    if (at == std::string::npos || !entry.is_directory(error)) continue;
    const auto base = settings_in(entry.path() / "baseconfnode.xml");
    if (!base) continue;
    Node node{entry.path(), name.substr(0, at), name.substr(at + 1), 0, {}};
    node.channel = number_of(base->text("IEC_Channel", "0"), 0);
    if (auto settings = settings_in(entry.path() / "confnode.xml")) node.settings = std::move(*settings);
    nodes.push_back(std::move(node));
  }
  std::ranges::sort(nodes, {}, &Node::channel);
  return nodes;
}

// By the number that its name begins with.
bool set_object(const std::string& function, ForeignRequest& request) {
  struct Function {
    const char* number;
    const char* object;
    bool written;
  };
  constexpr Function kFunctions[] = {
      {"01", "coil", false}, {"02", "discrete", false}, {"03", "holding", false}, {"04", "input", false},
      {"05", "coil", true},  {"06", "holding", true},   {"15", "coil", true},     {"16", "holding", true}};
  for (const Function& each : kFunctions) {
    if (!function.starts_with(each.number)) continue;
    request.object = each.object;
    request.written = each.written;
    return true;
  }
  return false;
}

ForeignDevice device_of(const Node& client, const std::string& unit) {
  ForeignDevice device;
  const auto text = [&](const char* attribute, const char* fallback) {
    return client.settings.text(attribute, fallback);
  };
  device.name = client.name + " unit " + unit;
  device.unit = unit;
  device.period_ms = text("Invocation_Rate_in_ms", "100");
  device.timeout_ms = text("Timeout_in_ms", "");
  if (client.kind == "ModbusTCPclient") {
    const std::string host = text("Remote_IP_Address", "localhost");
    device.host = host == "localhost" ? "127.0.0.1" : host;
    device.port = text("Remote_Port_Number", "502");
    return device;
  }
  device.line = text("Serial_Port", "/dev/ttyS0");
  device.baud = text("Baud_Rate", "9600");
  device.parity = text("Parity", "even");
  device.stop_bits = text("Stop_Bits", "1");
  return device;
}

void read_client(const Node& root, const Node& client, ForeignDevices& found) {
  std::map<std::string, std::size_t> units;
  for (const Node& node : nodes_in(client.folder)) {
    ForeignRequest request;
    request.levels = {root.channel, client.channel, node.channel};
    const std::string unit = node.settings.text("SlaveID", "1");
    if (!set_object(node.settings.text("Function", "01 - Read Coils"), request)) {
      found.left.push_back(client.name + "/" + node.name +
                           ": a request of a function that no device has here");
      continue;
    }
    const auto [place, first] = units.try_emplace(unit, found.devices.size());
    if (first) found.devices.push_back(device_of(client, unit));
    request.device = place->second;
    request.first = number_of(node.settings.text("Start_Address", "0"), 0);
    request.count = number_of(node.settings.text("Nr_of_Channels", "1"), 1);
    ForeignDevice& device = found.devices[request.device];
    const std::string timeout = node.settings.text("Timeout_in_ms", "");
    if (number_of(timeout, 0) > number_of(device.timeout_ms, 0)) device.timeout_ms = timeout;
    found.requests.push_back(std::move(request));
  }
}

}  // namespace

ForeignDevices read_beremiz_devices(const fs::path& folder) {
  ForeignDevices found;
  for (const Node& root : nodes_in(folder)) {
    if (root.kind != "modbus") continue;
    for (const Node& client : nodes_in(root.folder)) {
      if (client.kind == "ModbusTCPclient" || client.kind == "ModbusRTUclient") {
        read_client(root, client, found);
      } else {
        found.left.push_back(root.name + "/" + client.name + ": a " + client.kind +
                             "; this cell as a Modbus device is [modbus.server]");
      }
    }
  }
  return found;
}

std::optional<ForeignObject> object_at(const ForeignDevices& devices, const std::string& address) {
  const auto parsed = syntax::parse_hierarchical(address);
  if (!parsed || parsed->levels.size() != 4) return std::nullopt;
  const bool written = parsed->address.area == naming::Area::Output;
  for (const ForeignRequest& each : devices.requests) {
    if (each.written != written ||
        !std::equal(each.levels.begin(), each.levels.end(), parsed->levels.begin()))
      continue;
    const std::uint32_t number = parsed->levels.back();
    if (number >= each.first && number - each.first < each.count) return ForeignObject{&each, number};
  }
  return std::nullopt;
}

}  // namespace stepwright::cell_import
