#pragma once

// Files that make their readers ask for every key they know, as sample_cells.h has cells: alarms, recipes,
// bindings, plants of components.
//
// Pure; any thread.

#include <span>
#include <string_view>

namespace stepwright::reference {

std::span<const std::string_view> sample_alarms();
std::span<const std::string_view> sample_recipes();
std::span<const std::string_view> sample_bindings();
std::span<const std::string_view> sample_plants();

}  // namespace stepwright::reference
