#pragma once

// The files of a new cell (programs/new/templates), by plant; "{{name}}" in them stands for the cell's name.
// Pure; any thread.

#include <span>
#include <string_view>

namespace stepwright::new_cell {

struct TemplateText {
  std::string_view name;  // of the file
  std::string_view text;
};

std::span<const TemplateText> none_texts();
std::span<const TemplateText> tanks_texts();
std::span<const TemplateText> conveyor_texts();
std::span<const TemplateText> modbus_texts();
std::span<const TemplateText> plan_texts();
std::span<const TemplateText> plcopen_texts();  // with main.xml beside them, and more placeholders

}  // namespace stepwright::new_cell
