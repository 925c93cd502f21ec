#pragma once

// A file of settings that is one XML element with attributes, as editors keep beside their PLCopen project:
// the nodes of Beremiz (confnode.xml, baseconfnode.xml). Pure.

#include <map>
#include <string>

#include "runtime/ground/result/result.h"

namespace stepwright::exchange {

struct SettingsElement {
  std::string name;  // of the element, without its prefix
  std::map<std::string, std::string, std::less<>> attributes;

  std::string text(std::string_view attribute, std::string fallback) const;
};

// Fails with E0801, as read_plcopen.
[[nodiscard]] result::Result<SettingsElement> read_settings_element(std::string name, std::string text);

}  // namespace stepwright::exchange
