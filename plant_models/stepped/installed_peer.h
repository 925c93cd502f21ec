#pragma once

// The programs of this installation that are plants: of an FMU, of a program in ST. Thread-safe: pure.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace stepwright::stepped {

// How `stepwright-plant-KIND` is called, with numbers by name at the start, up to the options of its own.
// `programs`: the folder with it; empty: that of the program that asks.
std::vector<std::string> installed_peer(const std::string& kind,
                                        const std::vector<std::pair<std::string, double>>& parameters,
                                        std::filesystem::path programs = {});

}  // namespace stepwright::stepped
