#include "ladder/exchange/settings_element.h"

#include <utility>

#include "ladder/exchange/xml_file.h"

namespace stepwright::exchange {

std::string SettingsElement::text(std::string_view attribute, std::string fallback) const {
  const auto found = attributes.find(attribute);
  return found == attributes.end() ? std::move(fallback) : found->second;
}

result::Result<SettingsElement> read_settings_element(std::string name, std::string text) {
  auto file = XmlFile::parse(std::move(name), std::move(text));
  if (!file) return result::forward(file);
  SettingsElement element;
  element.name = local_name(file->root());
  for (const pugi::xml_attribute& each : file->root().attributes())
    element.attributes.emplace(each.name(), each.value());
  return element;
}

}  // namespace stepwright::exchange
