#include "plant_models/components/component_reader.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <limits>

#include "plant_models/components/own_type.h"

namespace stepwright::components {
namespace {

using settings::TomlTable;

constexpr std::size_t kDeepest = 8;         // assemblies in assemblies
constexpr std::size_t kMostProcesses = 64;  // of one plant
constexpr std::size_t kMostComponents = 20'000;

std::string short_text(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", value);
  return text.data();
}

std::string example_of(const ParameterSpec& spec) {
  if (parse_quantity(spec.fallback)) return "for example \"" + spec.fallback + "\"";
  return spec.unit.empty() ? "a number" : "a figure with its unit, such as \"1 " + spec.unit + "\"";
}

std::string hint_of(const std::string& text, const ParameterSpec& spec) {
  const std::string meant = unit_hint(text);
  return meant.empty() ? example_of(spec) : meant;
}

// A text as it stands, or what an assembly was given for it.
std::string text_of(const TomlTable& table, const std::string& key, const Replaced& replaced) {
  std::string text = table.text(key, {});
  if (!text.starts_with('$')) return text;
  const auto found = replaced.find(text.substr(1));
  if (found != replaced.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& [name, value] : replaced) known.push_back(name);
  table.report(key, "'" + text + "' is no parameter of the assembly", meant_or(text.substr(1), known));
  return {};
}

}  // namespace

std::string meant_or(const std::string& word, const std::vector<std::string>& known) {
  const std::string meant = settings::closest(word, known);
  if (!meant.empty() && meant != word) return "did you mean '" + meant + "'?";
  std::string text;
  constexpr std::size_t kMost = 40;
  for (std::size_t i = 0; i < known.size() && i < kMost; ++i) text += (i == 0 ? "" : ", ") + known[i];
  return known.empty() ? "there is none" : "known here: " + text + (known.size() > kMost ? ", ..." : "");
}

Quantity read_figure(const TomlTable& table, const ParameterSpec& spec, const Replaced& replaced) {
  const bool any = spec.unit == "any";
  const Unit wanted = any ? Unit{} : parse_unit(spec.unit).value_or(Unit{});
  const double without = spec.fallback.empty() ? 0.0 : std::numeric_limits<double>::quiet_NaN();
  const Quantity fallback = parse_quantity(spec.fallback).value_or(Quantity{without, wanted});
  const std::string& key = spec.name;
  if (!table.has(key)) {
    // Asked for, so that whoever listens hears of the default.
    (void)(spec.fallback.empty() ? table.required_text(key) : table.text(key, spec.fallback));
    return fallback;
  }
  Quantity figure;
  // A pure number may stand without quotes.
  if (wanted.dimension.none() && !any && !table.is_text(key)) {
    figure = {table.number(key, fallback.value), wanted};
  } else {
    const std::string text = text_of(table, key, replaced);
    if (text.empty()) return fallback;
    const auto parsed = parse_quantity(text);
    if (!parsed) {
      table.report(key, "'" + text + "' is no figure with a unit", hint_of(text, spec), "0341");
      return fallback;
    }
    figure = *parsed;
  }
  if (!any && figure.unit.dimension != wanted.dimension) {
    table.report(key,
                 "the unit of '" + key + "' does not fit: " + to_string(figure.unit.dimension) + " where " +
                     to_string(wanted.dimension) + " is wanted",
                 hint_of(figure.unit.text, spec), "0341");
    return fallback;
  }
  if (!(figure.value >= spec.low && figure.value <= spec.high)) {
    const Unit& said = figure.unit;
    table.report(key, "'" + key + "' is out of range",
                 "it must lie between " + short_text(said.from_si(spec.low)) + " and " +
                     short_text(said.from_si(spec.high)) + (said.text.empty() ? "" : " ") + said.text,
                 "0004");
    return fallback;
  }
  return figure;
}

ComponentReader::ComponentReader(Catalogue catalogue, const Parameters& of_plant, const TomlTable& root,
                                 const ModelOptions& options, ModelText& model)
    : catalogue_(catalogue),
      of_plant_(of_plant),
      options_(options),
      assemblies_(root.table("assemblies")),
      model_(model) {
  const TomlTable types = root.table("types");
  for (const std::string& name : types.keys()) {
    if (find_type(name) != nullptr)
      types.report(name, "there is a type '" + name + "' already", "choose another name");
    if (auto type = read_own_type(types.table(name), name))
      model_.own_types.push_back(std::move(*type));
    else
      wrong_types_.insert(name);
  }
}

const ComponentType* ComponentReader::find_type(const std::string& name) const {
  for (const ComponentType& type : model_.own_types)
    if (type.name == name) return &type;
  for (const ComponentType& type : catalogue_)
    if (type.name == name) return &type;
  return nullptr;
}

void ComponentReader::read(const TomlTable& table, const std::string& name) {
  read_in(table, name, {});
}

bool ComponentReader::is_name(const TomlTable& table, const std::string& name) {
  const bool plain =
      std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
  if (plain && !name.empty()) return true;
  table.report("type", "'" + name + "' cannot name a component", "letters, digits and '_'");
  return false;
}

// Told once.
bool ComponentReader::is_too_many(const TomlTable& table) {
  if (read_ < kMostComponents) return false;
  if (read_++ == kMostComponents)
    table.report("type", "there are more than " + std::to_string(kMostComponents) +
                             " components, those in assemblies counted");
  table.accept_all();
  return true;
}

// Returns whether it is there now, with all of its parts.
bool ComponentReader::read_in(const TomlTable& table, const std::string& name, const Around& around) {
  if (is_too_many(table) || !is_name(table, name)) return false;
  ++read_;
  const std::string type = table.required_text("type");
  if (type.empty()) return false;
  if (wrong_types_.contains(type)) {
    table.accept_all();  // what is wrong is told at the type
    return false;
  }
  if (const ComponentType* found = find_type(type))
    return read_part(table, *found, around.prefix + name, around);
  if (assemblies_.has_table(type)) return read_assembly(table, type, around.prefix + name, around);
  report_no_type(table, type);
  return false;
}

void ComponentReader::report_no_type(const TomlTable& table, const std::string& type) const {
  std::vector<std::string> known = assemblies_.keys();
  for (const ComponentType& one : model_.own_types) known.push_back(one.name);
  for (const ComponentType& one : catalogue_) known.push_back(one.name);
  table.report("type", "there is no type '" + type + "'", meant_or(type, known), "0342");
}

bool ComponentReader::read_assembly(const TomlTable& table, const std::string& type, const std::string& name,
                                    const Around& around) {
  if (around.depth >= kDeepest) {
    table.report("type", "assembly '" + type + "' has itself inside, or is too deep",
                 "at most " + std::to_string(kDeepest) + " in each other");
    table.accept_all();
    assemblies_.accept_all();  // those further in are not read
    return false;
  }
  used_assemblies_.insert(type);
  const TomlTable assembly = assemblies_.table(type);
  Around inside{name + ".", {}, around.depth + 1};
  const TomlTable parameters = assembly.table("parameters");
  for (const std::string& key : parameters.keys()) {
    inside.replaced[key] = parameters.text(key, {});
    if (table.has(key)) inside.replaced[key] = text_of(table, key, around.replaced);
  }
  const std::size_t first = model_.components.size();
  const TomlTable parts = assembly.table("components");
  bool all_read = true;
  for (const std::string& part : parts.keys()) {
    all_read = read_in(parts.table(part), part, inside) && all_read;
    if (read_ > kMostComponents) {
      for (const TomlTable& rest : {table, assembly, parts}) rest.accept_all();
      return false;
    }
  }
  const TomlTable ports = assembly.table("ports");
  for (const std::string& port : ports.keys()) {
    const std::string target = part_port(name + "." + ports.text(port, {}));
    model_.port_names[name + "." + port] = target;
    const std::string to = table.has(port) ? text_of(table, port, around.replaced) : std::string();
    if (!connect(target, first, {0, to, around.prefix, table.where(port)}) && all_read)
      ports.report(port, "'" + ports.text(port, {}) + "' is no port of a part", "\"PART.PORT\"", "0343");
  }
  return all_read;
}

// A port of an assembly is one of a part, which may be an assembly, too: its ports are known by then.
std::string ComponentReader::part_port(const std::string& name) const {
  const auto inner = model_.port_names.find(name);
  return inner == model_.port_names.end() ? name : inner->second;
}

// Returns false if none of the components from `first` on has that port.
bool ComponentReader::connect(const std::string& port, std::size_t first, ConnectionText connection) {
  const std::size_t dot = port.rfind('.');
  for (std::size_t i = first; i < model_.components.size(); ++i) {
    ComponentText& part = model_.components[i];
    if (part.name != port.substr(0, dot)) continue;
    const auto& specs = part.type->ports;
    const auto spec = std::ranges::find(specs, port.substr(dot + 1), &PortSpec::name);
    if (spec == specs.end()) return false;
    connection.port = static_cast<std::size_t>(spec - specs.begin());
    if (!connection.to.empty()) part.connections.push_back(std::move(connection));
    return true;
  }
  return false;
}

// The type of one component, which stands in a file of its own.
const ComponentType* ComponentReader::read_file_type(const TomlTable& table, const ComponentType& type,
                                                     const std::string& name, const Around& around) {
  if (model_.file_types.size() >= kMostProcesses) {
    table.report("type", "more than " + std::to_string(kMostProcesses) + " components of type '" + type.name +
                             "', each of which is a process");
    return nullptr;
  }
  auto whole = type.of_file(
      table, {name, model_.file.parent_path(), model_.communication_step_s, around.replaced, options_});
  if (!whole) {
    table.accept_all();
    return nullptr;
  }
  model_.file_types.push_back(std::move(*whole));
  return &model_.file_types.back();
}

bool ComponentReader::read_part(const TomlTable& table, const ComponentType& of_name, const std::string& name,
                                const Around& around) {
  const ComponentType* const found =
      of_name.of_file ? read_file_type(table, of_name, name, around) : &of_name;
  if (found == nullptr) return false;
  const ComponentType& type = *found;
  ComponentText part;
  part.name = name;
  part.type = &type;
  part.parameters = of_plant_;
  part.parameters.stream = model_.components.size();
  part.place = table.where();
  for (const ParameterSpec& spec : type.parameters) {
    part.where[spec.name] = table.where(table.has(spec.name) ? spec.name : "type");
    if (spec.choices.empty()) {
      const Quantity figure = read_figure(table, spec, around.replaced);
      part.parameters.figures[spec.name] = figure.value;
      if (!spec.like.empty()) part.units[spec.name] = figure.unit;
    } else {
      part.parameters.words[spec.name] = table.choice(spec.name, spec.fallback, spec.choices);
    }
  }
  for (std::size_t i = 0; i < type.ports.size(); ++i) {
    const std::string& port = type.ports[i].name;
    if (!table.has(port)) continue;
    if (auto to = text_of(table, port, around.replaced); !to.empty())
      part.connections.push_back({i, std::move(to), around.prefix, table.where(port)});
  }
  if (type.wrong && !around.unused) {
    auto [message, hint] = type.wrong(part.parameters);
    if (!message.empty()) table.report("type", std::move(message), std::move(hint), "0321");
  }
  model_.components.push_back(std::move(part));
  return true;
}

}  // namespace stepwright::components
