#include "ladder/exchange/plcopen_configurations.h"

#include <algorithm>

#include "ladder/exchange/plcopen_parts.h"
#include "ladder/graphic/identifier.h"

namespace stepwright::exchange::plcopen {

namespace code = source::code;

namespace {

std::vector<pugi::xml_node> configurations_of(pugi::xml_node instances) {
  std::vector<pugi::xml_node> found;
  for (const pugi::xml_node each : child(instances, "configurations").children())
    if (local_name(each) == "configuration") found.push_back(each);
  return found;
}

// Its program instances, with a task or without.
std::vector<pugi::xml_node> instances_of(pugi::xml_node configuration) {
  std::vector<pugi::xml_node> found;
  // A search that goes through all: no recursion, however deep the file is.
  configuration.find_node([&](pugi::xml_node each) {
    if (local_name(each) == "pouInstance") found.push_back(each);
    return false;
  });
  return found;
}

// The type of an instance in all the forms that dialects have.
std::string program_of(pugi::xml_node instance) {
  for (const char* attribute : {"typeName", "type", "name"})
    if (*instance.attribute(attribute).value() != '\0') return instance.attribute(attribute).value();
  return {};
}

std::string quoted_names(const std::vector<pugi::xml_node>& configurations) {
  std::string names;
  for (std::size_t i = 0; i < configurations.size(); ++i) {
    if (i > 0) names += i + 1 == configurations.size() ? " and " : ", ";
    names += "'" + std::string(configurations[i].attribute("name").value()) + "'";
  }
  return names;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::any_of(names, [&](const std::string& each) { return graphic::same_name(each, name); });
}

}  // namespace

pugi::xml_node chosen_configuration(ReadContext& context, pugi::xml_node instances, std::string_view name) {
  const std::vector<pugi::xml_node> all = configurations_of(instances);
  if (all.empty()) return {};
  std::vector<pugi::xml_node> found;
  const auto is_named = [&](pugi::xml_node each) {
    return graphic::same_name(each.attribute("name").value(), name);
  };
  const auto runs_program = [](pugi::xml_node each) { return !instances_of(each).empty(); };
  std::ranges::copy_if(all, std::back_inserter(found), is_named);
  if (!name.empty() && found.empty()) {
    context.error(all.front(), code::kExchangeUnsupported,
                  "there is no configuration '" + std::string(name) + "'",
                  "the file has " + quoted_names(all));
    return {};
  }
  // Devices without a program are configurations, too, where exports of some systems come from.
  std::vector<pugi::xml_node> running;
  std::ranges::copy_if(all, std::back_inserter(running), runs_program);
  if (name.empty()) found = context.dialect().exported_tasks && !running.empty() ? running : all;
  if (found.size() == 1) return found.front();
  std::string hint = "choose one: --configuration NAME (of compile, test, show, new)";
  if (running.size() == 1) hint = source::with_dialects(std::move(hint), &source::Dialect::exported_tasks);
  context.error(found[1], code::kExchangeUnsupported,
                "the project has several configurations: " + quoted_names(found), std::move(hint));
  return {};
}

std::vector<std::string> programs_of_others(pugi::xml_node instances, pugi::xml_node chosen) {
  std::vector<std::string> own;
  for (const pugi::xml_node each : instances_of(chosen)) own.push_back(program_of(each));
  std::vector<std::string> others;
  for (const pugi::xml_node configuration : configurations_of(instances)) {
    if (configuration == chosen) continue;
    for (const pugi::xml_node each : instances_of(configuration)) {
      std::string program = program_of(each);
      if (!contains(own, program)) others.push_back(std::move(program));
    }
  }
  return others;
}

}  // namespace stepwright::exchange::plcopen
