// Assemblies that no component is made of. Each is checked by itself: its keys, the types of its parts and
// what its ports are. What needs the values of its parameters is not.

#include <algorithm>

#include "plant_models/components/component_reader.h"

namespace stepwright::components {

using settings::TomlTable;

void ComponentReader::read_unused() {
  for (const std::string& type : assemblies_.keys()) {
    if (find_type(type) != nullptr)
      assemblies_.report(type, "there is a type '" + type + "' already", "choose another name");
    if (!used_assemblies_.contains(type)) read_unused(type);
  }
}

void ComponentReader::read_unused(const std::string& type) {
  const TomlTable assembly = assemblies_.table(type);
  Around inside{.prefix = type + ".", .unused = true};
  const TomlTable parameters = assembly.table("parameters");
  for (const std::string& key : parameters.keys()) {
    static_cast<void>(parameters.text(key, {}));
    inside.replaced[key] = {};
  }
  const std::size_t first = model_.components.size();
  const TomlTable parts = assembly.table("components");
  bool all_read = true;
  for (const std::string& part : parts.keys())
    all_read = read_unused_part(parts.table(part), part, inside) && all_read;
  const TomlTable ports = assembly.table("ports");
  for (const std::string& port : ports.keys()) {
    const std::string of = ports.text(port, {});
    if (all_read && !is_port_of(parts, of))
      ports.report(port, "'" + of + "' is no port of a part", "\"PART.PORT\"", "0343");
  }
  model_.components.erase(model_.components.begin() + static_cast<std::ptrdiff_t>(first),
                          model_.components.end());
}

// Returns whether its ports are known.
bool ComponentReader::read_unused_part(const TomlTable& table, const std::string& name,
                                       const Around& around) {
  if (!is_name(table, name)) return false;
  const std::string type = table.required_text("type");
  const ComponentType* const found = find_type(type);
  if (found != nullptr && !found->of_file) return read_part(table, *found, around.prefix + name, around);
  const bool is_assembly = found == nullptr && assemblies_.has_table(type);
  if (found == nullptr && !is_assembly && !wrong_types_.contains(type) && !type.empty())
    report_no_type(table, type);
  if (!is_assembly) {
    table.accept_all();
    return false;
  }
  const TomlTable inner = assemblies_.table(type);
  for (const char* const kind : {"parameters", "ports"})
    for (const std::string& key : inner.table(kind).keys()) static_cast<void>(table.text(key, {}));
  return true;
}

// Whether "PART.PORT" is one of these parts, whose types are known.
bool ComponentReader::is_port_of(const TomlTable& parts, const std::string& port) const {
  const std::size_t dot = port.rfind('.');
  if (dot == std::string::npos || !parts.has_table(port.substr(0, dot))) return false;
  const std::string type = parts.table(port.substr(0, dot)).text("type", {});
  const std::string name = port.substr(dot + 1);
  const ComponentType* const found = find_type(type);
  if (found == nullptr) return assemblies_.table(type).table("ports").has(name);
  return std::ranges::find(found->ports, name, &PortSpec::name) != found->ports.end();
}

}  // namespace stepwright::components
