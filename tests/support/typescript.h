#pragma once

// The interfaces of a file of the page, for tests that hold what the server writes against them: the names
// and the types of their members, each on a line of its own.
//
//   const Interfaces page = read_interfaces(STEPWRIGHT_SOURCE_DIR "/hmi_web/client/src/scan/figures.ts");
//   EXPECT_EQ(difference(report, page, "Runtime"), "");
//
// Pure but for reading; any thread.

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>

namespace stepwright::support {

using Members = std::map<std::string, std::string>;  // type by name; of an optional one "name?"
using Interfaces = std::map<std::string, Members>;

inline Interfaces read_interfaces(const std::string& file) {
  static const std::regex kBegin(R"(^export interface (\w+)( extends (Partial<)?(\w+)>?)? \{$)");
  static const std::regex kMember(R"(^  (\w+\??): ([^;]+);.*$)");
  Interfaces found;
  Members* open = nullptr;
  std::ifstream in(file);
  std::smatch match;
  for (std::string line; std::getline(in, line);) {
    if (std::regex_match(line, match, kBegin)) {
      open = &found[match[1].str()];
      for (const auto& [name, member] : found[match[4].str()])
        (*open)[match[3].matched && !name.ends_with('?') ? name + "?" : name] = member;
    } else if (line == "}") {
      open = nullptr;
    } else if (open != nullptr && std::regex_match(line, match, kMember)) {
      (*open)[match[1].str()] = match[2].str();
    }
  }
  return found;
}

// Where `value` differs from the interface of that name, with all objects in it; empty: nowhere.
inline std::string difference(const nlohmann::json& value, const Interfaces& page, const std::string& type) {
  if (type.ends_with(" | null")) {
    return value.is_null() ? "" : difference(value, page, type.substr(0, type.size() - 7));
  }
  if (type.ends_with("[]")) {
    if (!value.is_array()) return type + " is no list; ";
    std::string all;
    for (const nlohmann::json& each : value) all += difference(each, page, type.substr(0, type.size() - 2));
    return all;
  }
  const auto is = [&](const char* name, bool holds) {
    return type == name && !holds ? "no " + type + "; " : "";
  };
  std::string wrong =
      is("number", value.is_number()) + is("boolean", value.is_boolean()) + is("string", value.is_string());
  const auto interface = page.find(type);
  if (interface == page.end()) return wrong;
  if (!value.is_object()) return type + " is no object; ";
  for (const auto& [name, member] : interface->second) {
    const bool optional = name.ends_with('?');
    const std::string key = optional ? name.substr(0, name.size() - 1) : name;
    if (!value.contains(key)) {
      if (!optional) wrong += type + "." + key + " is not written; ";
      continue;
    }
    const std::string inside = difference(value[key], page, member);
    if (!inside.empty()) wrong += type + "." + key + ": " + inside;
  }
  for (const auto& [key, unused] : value.items()) {
    if (!interface->second.contains(key) && !interface->second.contains(key + "?"))
      wrong += type + "." + key + " is not known to the page; ";
  }
  return wrong;
}

}  // namespace stepwright::support
