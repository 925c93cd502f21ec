#include "cell/config/stepped_config.h"

#include <algorithm>
#include <set>

namespace stepwright::config {
namespace {

using settings::TomlTable;

constexpr std::size_t kMostValues = 1'024;  // as runtime/host/limits.h
constexpr std::size_t kMostNameBytes = 64;  // likewise
constexpr std::size_t kMostTerminals = 4096;

// A word of the process image has 16 bits.
constexpr settings::Range kCounts{-32'768, 32'767};

bool is_bit(const std::string& address) {
  return address.size() > 2 && (address[2] == 'X' || address[2] == 'x');
}

void check_name(const TomlTable& table, const std::string& name) {
  const bool printable =
      std::none_of(name.begin(), name.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; });
  if (!name.empty() && name.size() <= kMostNameBytes && printable) return;
  table.report(name, "'" + name + "' cannot be the name of a terminal, a value or a fault",
               "1 to 64 bytes without control characters");
}

// Two points of a line: the quantity at two counts.
void read_scale(const TomlTable& table, SteppedTerminalConfig& terminal) {
  const std::vector<double> range = table.numbers("range");
  std::vector<double> counts = table.numbers("counts");
  if (!table.has("range")) {
    if (table.has("counts"))
      table.report("counts", "counts without the range that they stand for", "range = [0.0, 2.0]");
    return;
  }
  if (counts.empty()) counts = {0, 27'648};
  if (range.size() != 2 || range[0] == range[1]) {
    table.report("range", "a range is the quantity at two different points", "range = [0.0, 2.0]");
    return;
  }
  const bool words = std::all_of(counts.begin(), counts.end(),
                                 [](double c) { return c >= kCounts.low && c <= kCounts.high; });
  if (counts.size() != 2 || counts[0] == counts[1] || !words) {
    table.report("counts", "counts are two different numbers of 16 bits", "counts = [0, 27_648]");
    return;
  }
  terminal.per_count = (range[1] - range[0]) / (counts[1] - counts[0]);
  terminal.at_zero = range[0] - counts[0] * terminal.per_count;
}

std::vector<SteppedTerminalConfig> read_terminals(const TomlTable& plant, const char* key) {
  std::vector<SteppedTerminalConfig> terminals;
  const TomlTable list = plant.table(key);
  for (const std::string& name : list.keys()) {
    SteppedTerminalConfig terminal{.name = name, .address = {}, .where = list.where(name)};
    check_name(list, name);
    if (list.has_table(name)) {
      const TomlTable table = list.table(name);
      terminal.address = table.required_text("address");
      terminal.unit = table.text("unit", {});
      terminal.meaning = table.text("meaning", {});
      terminal.is_switch = is_bit(terminal.address);
      read_scale(table, terminal);
      if (terminal.is_switch && table.has("range"))
        table.report("range", "one bit has no range", "an address of a word, such as %IW0");
    } else {
      terminal.address = list.text(name, {});
      terminal.is_switch = is_bit(terminal.address);
    }
    terminals.push_back(std::move(terminal));
  }
  if (terminals.size() > kMostTerminals)
    plant.report(key, "more than " + std::to_string(kMostTerminals) + " terminals");
  return terminals;
}

std::vector<SteppedQuantityConfig> read_quantities(const TomlTable& plant, const char* key) {
  std::vector<SteppedQuantityConfig> quantities;
  const TomlTable list = plant.table(key);
  for (const std::string& name : list.keys()) {
    check_name(list, name);
    quantities.push_back({name, list.text(name, {}), list.where(name)});
  }
  return quantities;
}

std::vector<SteppedQuantityConfig> read_faults(const TomlTable& plant) {
  std::vector<SteppedQuantityConfig> faults;
  const TomlTable list = plant.table("faults");
  for (const std::string& name : list.keys()) {
    check_name(list, name);
    SteppedQuantityConfig fault{.name = name, .unit = {}, .where = list.where(name)};
    if (list.has_table(name)) {
      const TomlTable table = list.table(name);
      fault.unit = table.text("unit", {});
      const std::vector<double> range = table.numbers("range");
      if (range.size() == 2 && range[0] < range[1]) {
        fault.low = range[0];
        fault.high = range[1];
      } else if (table.has("range")) {
        table.report("range", "a range is the least and the largest value", "range = [0.0, 0.5]");
      }
    } else {
      fault.unit = list.text(name, {});
    }
    faults.push_back(std::move(fault));
  }
  return faults;
}

// What the page and reports know has one name each.
void check_values(const TomlTable& plant, const SteppedPlantConfig& stepped) {
  std::set<std::string> names;
  std::size_t measured = 0;
  for (const SteppedTerminalConfig& sensor : stepped.sensors) {
    names.insert(sensor.name);
    measured += sensor.is_switch ? 0 : 1;
  }
  for (const SteppedQuantityConfig& value : stepped.values) {
    if (!names.insert(value.name).second)
      plant.table("values").report(value.name, "'" + value.name + "' is a sensor already",
                                   "what a sensor measures is among the values by itself");
  }
  if (stepped.values.size() + measured > kMostValues) {
    plant.report("values", "more than " + std::to_string(kMostValues) + " values and analogue sensors");
  }
  if (stepped.sensors.empty() && stepped.actuators.empty()) {
    plant.report("kind", "a plant without terminals",
                 "[plant.sensors] level = \"%IW0\" and [plant.actuators] valve = \"%QX0.0\"");
  }
}

std::filesystem::path file_of(const TomlTable& plant, const char* key, const std::filesystem::path& folder) {
  const std::string name = plant.required_text(key);
  return name.empty() ? std::filesystem::path() : folder / name;
}

}  // namespace

bool is_stepped(const std::string& kind) {
  return kind == "shared" || kind == "fmu" || kind == "st";
}

SteppedPlantConfig read_stepped_plant(const TomlTable& plant, const std::string& kind,
                                      const std::filesystem::path& folder, std::int64_t interval_us) {
  SteppedPlantConfig stepped;
  stepped.folder = folder;
  if (kind == "shared") {
    stepped.command = plant.texts("command");
    stepped.where = plant.where("command");
    if (stepped.command.empty() || stepped.command.front().empty())
      plant.report("command", "a plant in a process of its own needs its command",
                   "command = [\"python3\", \"tank.py\"]");
  } else if (kind == "fmu") {
    stepped.file = file_of(plant, "file", folder);
    stepped.where = plant.where("file");
  } else {
    for (const std::string& source : plant.texts("sources")) stepped.sources.push_back(folder / source);
    stepped.where = plant.where("sources");
    if (stepped.sources.empty())
      plant.report("sources", "a plant in ST needs its sources", "sources = [\"tank.st\"]");
  }
  stepped.step = std::chrono::microseconds(plant.integer("step_us", interval_us, {1, 60'000'000}));
  stepped.patience = std::chrono::milliseconds(plant.integer("timeout_ms", 1'000, {1, 600'000}));
  stepped.beginning = std::chrono::milliseconds(plant.integer("start_timeout_ms", 30'000, {1, 600'000}));
  stepped.sensors = read_terminals(plant, "sensors");
  stepped.actuators = read_terminals(plant, "actuators");
  stepped.values = read_quantities(plant, "values");
  stepped.faults = read_faults(plant);
  if (kind != "shared") {
    const TomlTable parameters = plant.table("parameters");
    for (const std::string& name : parameters.keys())
      stepped.parameters.push_back({name, parameters.required_number(name), parameters.where(name)});
  }
  check_values(plant, stepped);
  return stepped;
}

}  // namespace stepwright::config
