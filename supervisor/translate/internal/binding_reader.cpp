#include "supervisor/translate/internal/binding_reader.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "ladder/graphic/identifier.h"
#include "supervisor/translate/address.h"
#include "supervisor/translate/sensor_program.h"

namespace stepwright::translate::internal {

namespace {

constexpr settings::Range kDuration{0.0, 86'400.0};
constexpr settings::Range kPositiveDuration{0.001, 86'400.0};
// Tolerances that readings may walk away without a word.
constexpr double kDrift = 1.5;

milliseconds to_ms(double seconds) {
  return milliseconds(std::llround(seconds * 1000.0));
}

// "(level a1)" -> "level of a1"
std::string default_label(const Pattern& atom) {
  std::string label = atom.name;
  const char* link = " of ";
  for (const std::string& argument : atom.arguments) {
    label += link + argument;
    link = " and ";
  }
  return label;
}

}  // namespace

BindingReader::BindingReader(std::string file, const model::Vocabulary* vocabulary)
    : vocabulary_(vocabulary), atoms_(binding_, vocabulary) {
  binding_.file = std::move(file);
}

void BindingReader::read(const TomlTable& root) {
  const TomlTable times = root.table("times");
  binding_.start = to_ms(times.number("start_s", 2.0, kPositiveDuration));
  binding_.settle = to_ms(times.number("settle_s", 3.0, kPositiveDuration));
  read_tags(root.table("tags"));
  read_sensors(root.table("sensors"));
  read_facts(root);
  read_groups(root);
  check_names(root);
  for (const TomlTable& entry : root.tables("actions")) read_action(entry);
  for (const TomlTable& entry : root.tables("devices")) read_device(entry);
  read_believed(root);
  check_every_action_is_bound(root);
}

void BindingReader::read_tags(const TomlTable& tags) {
  for (const std::string& name : tags.keys()) {
    const TomlTable table = tags.table(name);
    Tag tag;
    tag.name = name;
    tag.where = table.where();
    tag.type = table.text("type", "BOOL");
    tag.address = table.required_text("address");
    tag.omron = table.text("omron", "");
    tag.comment = table.text("comment", "");
    if (!graphic::is_identifier(name) || graphic::is_keyword(name)) {
      tags.report(name, "'" + name + "' cannot name a variable",
                  "IEC 61131-3 allows letters, digits and single underscores, and no keyword");
    }
    check_address(table, tag);
    const auto address = parse_address(tag.address);
    tag.output = address && address->area == 'Q';
    binding_.tags.push_back(std::move(tag));
  }
}

void BindingReader::check_address(const TomlTable& table, const Tag& tag) {
  const auto size = address_size_of(tag.type);
  if (!size) {
    table.report("type", "'" + tag.type + "' is not an elementary type", "BOOL for switches, INT for counts");
    return;
  }
  if (tag.address.empty()) return;  // reported as missing
  const auto address = parse_address(tag.address);
  if (!address) {
    table.report("address", "'" + tag.address + "' is not an address",
                 "%IX0.0 is bit 0 of input byte 0, %IW1 the input word of bytes 2 and 3");
    return;
  }
  if (address->size != *size) {
    table.report("address", "'" + tag.address + "' does not fit the type " + tag.type,
                 std::string("its size letter must be ") + *size);
    return;
  }
  for (const Tag& other : binding_.tags) {
    const auto taken = parse_address(other.address);
    if (!taken || !overlap(*address, *taken)) continue;
    atoms_.problem(
        "B0008", table, "address",
        "'" + tag.name + "' at " + tag.address + " overlaps '" + other.name + "' at " + other.address,
        "words are numbered in words: %IW1 covers bytes 2 and 3");
  }
}

void BindingReader::read_sensors(const TomlTable& sensors) {
  for (const std::string& name : sensors.keys()) {
    const TomlTable table = sensors.table(name);
    Sensor sensor;
    sensor.name = name;
    sensor.where = table.where();
    if (!graphic::is_identifier(name)) sensors.report(name, "'" + name + "' cannot name a variable");
    sensor.tag = table.required_text("tag");
    const Tag* tag = sensor.tag.empty() ? nullptr : atoms_.tag(table, "tag", sensor.tag);
    const bool counts = tag == nullptr || tag->type == "INT" || tag->type == "UINT";
    if (tag != nullptr && address_size_of(tag->type) && (tag->output || !counts)) {
      table.report("tag", "'" + sensor.tag + "' cannot be measured: it is no INT or UINT input");
    }
    if (const auto fluent = atoms_.atom(table, "fluent", AtomKind::Fluent, nullptr)) {
      sensor.fluent = to_string(*fluent);
      sensor.label = table.text("label", default_label(*fluent));
      if (binding_.sensor_of(sensor.fluent) != nullptr) {
        table.report("fluent", "another sensor measures " + sensor.fluent + " already");
      }
    }
    std::vector<CalibrationPoint> points;
    for (const std::vector<double>& row : table.number_rows("calibration", 2)) {
      points.push_back({row[0], row[1]});
    }
    if (is_calibration(points)) {
      sensor.calibration = Calibration(std::move(points));
    } else {
      table.report("calibration", "the calibration of '" + name + "' is not strictly monotone",
                   "give two points [value, counts] at least, values rising, counts only rising or falling");
    }
    sensor.tolerance = table.number("tolerance", sensor.tolerance, {1e-6, 1e9});
    sensor.resolution = table.number("resolution", sensor.resolution, {0.0, 1e9});
    sensor.filter = to_ms(table.number("filter_s", 0.5, kPositiveDuration));
    sensor.must_move = table.boolean("must_move", sensor.must_move);
    sensor.tare = table.boolean("tare", sensor.tare);
    if (!sensor.tare && table.has("max_bias_counts")) {
      table.report("max_bias_counts", "it bounds a tare, and '" + name + "' is not tared",
                   "tare = true where the sensor has a bias that is read before a run");
    }
    sensor.max_bias_counts = table.number("max_bias_counts", sensor.max_bias_counts, {0.0, 65'535.0});
    sensor.max_drift = table.number("max_drift", kDrift * sensor.tolerance, {sensor.tolerance, 1e9});
    sensor.max_rate = table.number("max_rate", sensor.max_rate, {0.0, 1e9});
    sensor.unit = table.text("unit", "");
    if (const std::vector<double> range = table.numbers("range"); range.size() == 2 && range[0] < range[1]) {
      sensor.range = {range[0], range[1]};
    } else if (!range.empty()) {
      table.report("range", "the range of '" + name + "' is not a lowest and a highest value",
                   "for example range = [0, 10]");
    }
    sensor.omron = table.text("omron", "");
    binding_.sensors.push_back(std::move(sensor));
  }
}

// Tags and sensors must leave the names of everything that is generated alone.
void BindingReader::check_names(const TomlTable& root) {
  graphic::NameSet names;
  for (const char* taken :
       {kSensorProgram, kPlanProgram, kAveragingVariable, "first", "samples", "main", "sensing", "planned",
        "START", "SETTLE", "DONE", "AT_REST", "AVERAGE", "OBSERVED", "LOST"}) {
    names.insert(taken);
  }
  for (std::size_t g = 0; g < binding_.one_of.size(); ++g) {
    for (std::size_t s = 0; s < binding_.one_of[g].searches.size(); ++s) names.insert(search_step(g, s));
  }
  const TomlTable tags = root.table("tags");
  for (const Tag& tag : binding_.tags) {
    if (!names.insert(tag.name))
      tags.report(tag.name, "the name '" + tag.name + "' is taken", "rename the tag");
  }
  const TomlTable sensors = root.table("sensors");
  for (const Sensor& sensor : binding_.sensors) {
    for (const std::string& name : generated_variables(sensor)) {
      if (names.insert(name)) continue;
      sensors.report(sensor.name,
                     "sensor '" + sensor.name + "' needs the variable '" + name + "', which is taken",
                     "rename the sensor or the tag");
    }
  }
}

void BindingReader::read_facts(const TomlTable& root) {
  for (const TomlTable& entry : root.tables("facts")) {
    ObservedFact observed;
    observed.tag = entry.required_text("tag");
    const Tag* tag = observed.tag.empty() ? nullptr : atoms_.tag(entry, "tag", observed.tag);
    if (tag != nullptr && (tag->output || tag->type != "BOOL")) {
      entry.report("tag", "'" + observed.tag + "' cannot observe a fact: it is no BOOL input");
    }
    observed.inverted = entry.boolean("inverted", false);
    const auto fact = atoms_.atom(entry, "fact", AtomKind::Fact, nullptr);
    observed.label = entry.text("label", fact ? to_string(*fact) : "");
    if (!fact) continue;
    observed.fact = to_string(*fact);
    if (binding_.observed(observed.fact) != nullptr) {
      entry.report("fact", observed.fact + " is observed by another entry already");
    }
    binding_.facts.push_back(std::move(observed));
  }
}

void BindingReader::read_groups(const TomlTable& root) {
  for (const TomlTable& entry : root.tables("one_of")) {
    OneOf group;
    const std::vector<std::string> facts = entry.texts("facts");
    for (const std::string& text : facts) {
      const auto fact = atoms_.observed(entry, "facts", text, AtomKind::Fact, nullptr);
      if (fact) group.facts.push_back(to_string(*fact));
    }
    if (facts.size() < 2) entry.report("facts", "a group needs two facts at least");
    for (const TomlTable& row : entry.tables("search")) {
      Search search;
      search.output = row.required_text("output");
      search.timeout = to_ms(row.required_number("timeout_s", kPositiveDuration));
      if (!search.output.empty()) atoms_.output(row, "output", search.output);
      group.searches.push_back(std::move(search));
    }
    binding_.one_of.push_back(std::move(group));
  }
  for (const TomlTable& entry : root.tables("exclusive")) {
    std::vector<std::string> outputs = entry.texts("outputs");
    for (const std::string& name : outputs) atoms_.output(entry, "outputs", name);
    if (outputs.size() < 2) entry.report("outputs", "two outputs at least exclude each other");
    binding_.exclusive.push_back(std::move(outputs));
  }
}

void BindingReader::read_action(const TomlTable& entry) {
  ActionBinding action;
  action.where = entry.where();
  const auto pattern = atoms_.atom(entry, "action", AtomKind::Action, nullptr);
  if (pattern) action.pattern = *pattern;
  action.outputs = entry.texts("outputs");
  action.names_outputs = entry.has("outputs");
  check_outputs(entry, action);
  action.timeout = to_ms(entry.required_number("timeout_s", kPositiveDuration));
  action.rest = to_ms(entry.number("rest_s", 0.0, kDuration));
  read_completion(entry, action);
  for (const std::string& text : entry.texts("hold")) {
    const auto fact = atoms_.observed(entry, "hold", text, AtomKind::Fact, &action.pattern);
    if (fact) action.hold.push_back(*fact);
  }
  read_transfers(entry, action);
  read_duration(entry, action);
  if (!pattern) return;
  for (const ActionBinding& earlier : binding_.actions) {
    if (!covers(earlier.pattern, *pattern)) continue;
    entry.report("action",
                 to_string(*pattern) + " is never used: " + to_string(earlier.pattern) + " comes first",
                 "put the special entry before the general one");
    break;
  }
  binding_.actions.push_back(std::move(action));
}

void BindingReader::read_device(const TomlTable& entry) {
  Device device;
  device.name = entry.required_text("name");
  device.outputs = entry.texts("outputs");
  for (const std::string& text : entry.texts("actions")) {
    const auto pattern = atoms_.parse(entry, "actions", text, AtomKind::Action, nullptr);
    if (pattern) device.actions.push_back(*pattern);
  }
  if (device.outputs.empty() && !entry.has("actions"))
    entry.report("name", "nothing depends on this device", "give it 'outputs' or 'actions'");
  for (const std::string& name : device.outputs) atoms_.output(entry, "outputs", name);
  for (const Device& other : binding_.devices) {
    if (other.name == device.name) entry.report("name", "another device is called '" + device.name + "'");
    for (const std::string& output : device.outputs) {
      if (std::find(other.outputs.begin(), other.outputs.end(), output) == other.outputs.end()) continue;
      entry.report("outputs", "'" + output + "' is an output of '" + other.name + "' already");
    }
  }
  binding_.devices.push_back(std::move(device));
}

void BindingReader::read_believed(const TomlTable& root) {
  for (const std::string& text : root.texts("believed")) {
    const auto scope = parse_pattern(text);
    const auto is_function = [&](const model::Symbol& symbol) { return scope && symbol.name == scope->name; };
    const bool fluent = vocabulary_ != nullptr && std::ranges::any_of(vocabulary_->functions, is_function);
    const AtomKind kind = fluent ? AtomKind::Fluent : AtomKind::Fact;
    const auto atom = atoms_.parse(root, "believed", text, kind, scope ? &*scope : nullptr);
    if (atom) binding_.believed.push_back(*atom);
  }
}

void BindingReader::check_outputs(const TomlTable& entry, const ActionBinding& action) {
  for (const std::string& name : action.outputs) atoms_.output(entry, "outputs", name);
  for (const std::vector<std::string>& group : binding_.exclusive) {
    const auto driven = [&action](const std::string& name) {
      return std::find(action.outputs.begin(), action.outputs.end(), name) != action.outputs.end();
    };
    if (std::count_if(group.begin(), group.end(), driven) > 1) {
      entry.report("outputs", "this entry drives two outputs that exclude each other");
    }
  }
}

void BindingReader::read_completion(const TomlTable& entry, ActionBinding& action) {
  const TomlTable until = entry.table("until");
  const bool fact = until.has("fact");
  const bool fluent = until.has("fluent");
  action.completion.pre_act = until.number("pre_act", 0.0, {0.0, 1e9});
  if (fact == fluent) {
    atoms_.problem(entry.has("until") ? "B0006" : "B0005", entry, "until",
                   "'until' must name one fact or one fluent",
                   "until = { fact = \"(is-at ?v ?to)\" } or { fluent = \"(lev ?v)\", pre_act = 0.1 }");
    (void)until.text("fact", "");
    (void)until.text("fluent", "");
    return;
  }
  const char* key = fact ? "fact" : "fluent";
  action.completion.kind = fact ? CompletionKind::Fact : CompletionKind::Fluent;
  const AtomKind kind = fact ? AtomKind::Fact : AtomKind::Fluent;
  const auto atom = atoms_.observed(until, key, until.text(key, ""), kind, &action.pattern);
  if (atom) action.completion.atom = *atom;
}

void BindingReader::read_transfers(const TomlTable& entry, ActionBinding& action) {
  for (const TomlTable& row : entry.tables("transfers")) {
    const std::string text = row.required_text("from");
    const auto to = atoms_.atom(row, "to", AtomKind::Fluent, &action.pattern);
    const double ratio = row.number("ratio", 1.0, {1e-9, 1e9});
    if (text.empty()) continue;
    const auto from = atoms_.observed(row, "from", text, AtomKind::Fluent, &action.pattern);
    if (from && to) action.transfers.push_back({*from, *to, ratio});
  }
}

void BindingReader::read_duration(const TomlTable& entry, ActionBinding& action) {
  const TomlTable duration = entry.table("duration");
  action.duration.fixed_s = duration.number("fixed_s", 0.0, kDuration);
  action.duration.per_unit_s = duration.number("per_unit_s", 0.0, kDuration);
  if (duration.has("of")) {
    action.duration.of = atoms_.atom(duration, "of", AtomKind::Fluent, &action.pattern);
  } else {
    (void)duration.text("of", "");
    if (action.duration.per_unit_s > 0.0) {
      duration.report("per_unit_s", "'per_unit_s' needs 'of', the fluent that is counted");
    }
  }
}

void BindingReader::check_every_action_is_bound(const TomlTable& root) {
  if (vocabulary_ == nullptr) return;
  const auto known = [this](const ActionBinding& entry) {
    const auto& actions = vocabulary_->actions;
    return std::any_of(actions.begin(), actions.end(),
                       [&entry](const model::Symbol& s) { return s.name == entry.pattern.name; });
  };
  // A misspelt entry is reported already; that its action is missing would be the same slip again.
  if (!std::all_of(binding_.actions.begin(), binding_.actions.end(), known)) return;
  for (const model::Symbol& symbol : vocabulary_->actions) {
    const auto bound = [&symbol](const ActionBinding& a) { return a.pattern.name == symbol.name; };
    if (std::any_of(binding_.actions.begin(), binding_.actions.end(), bound)) continue;
    Pattern pattern{symbol.name, {}};
    for (std::size_t i = 1; i <= symbol.arity; ++i) pattern.arguments.push_back("?p" + std::to_string(i));
    atoms_.problem("B0009", root, "actions", "the action '" + symbol.name + "' has no entry",
                   "add [[actions]] with action = \"" + to_string(pattern) + "\"");
  }
}

}  // namespace stepwright::translate::internal
