#pragma once

// Values as JSON. Pure; any thread.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace stepwright::protocol {

// Places, figures and times of the cell: three decimals.
nlohmann::json number(double value);

// Measured: six digits, but never fewer than three decimals. No sensor of a cell is finer, and a value that
// only trembles behind them is no change.
nlohmann::json measured(const std::optional<double>& value);
nlohmann::json measured(const std::vector<std::optional<double>>& values);
std::string measured_text(const std::optional<double>& value);

// A value of the program: the shortest text that means the same LREAL or, of a REAL, the same REAL.
std::string value_text(const std::optional<double>& value, bool is_real);
nlohmann::json value_json(const std::optional<double>& value, bool is_real);

// Serialises; bytes that are not UTF-8 are replaced instead of throwing.
std::string text(const nlohmann::json& value);

}  // namespace stepwright::protocol
