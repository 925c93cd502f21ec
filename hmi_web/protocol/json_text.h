#pragma once

// How values become JSON.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace stepwright::protocol {

// Three decimals are finer than any sensor of a cell, and a value that only trembles behind them is no
// change.
nlohmann::json number(double value);
nlohmann::json number(const std::optional<double>& value);
nlohmann::json numbers(const std::vector<std::optional<double>>& values);

// The same as JSON text, for those who write thousands of them.
std::string number_text(const std::optional<double>& value);
// With all its digits, for a time that counts nanoseconds.
std::string exact_number_text(const std::optional<double>& value);

// Serialises; bytes that are not UTF-8 are replaced instead of throwing.
std::string text(const nlohmann::json& value);

}  // namespace stepwright::protocol
