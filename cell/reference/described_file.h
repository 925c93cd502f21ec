#pragma once

// A TOML file whose keys the reference has: the cell's own, and those that it names. What its readers ask for
// is heard while they read samples of it; what people are told stands beside.
//
// Immutable; any thread.

#include <span>
#include <string_view>
#include <vector>

#include "runtime/ground/settings/key_words.h"
#include "runtime/ground/settings/toml_document.h"

namespace stepwright::reference {

struct DescribedFile {
  std::string_view name;   // for the command: "cell", "alarms"
  std::string_view title;  // "Every key of a cell's file"
  std::string_view about;  // what stands above the tables
  std::span<const settings::KeyWords> words;
  // Files that make the readers ask for every key they know (sample_cells.h says how).
  std::span<const std::string_view> samples;
  void (*read)(settings::TomlDocument& document);
};

// "cell" is the first one.
std::span<const DescribedFile> described_files();
// Null: there is none of that name.
const DescribedFile* find_described_file(std::string_view name);

// By file; words of the cell's are in cell/config.
std::span<const settings::KeyWords> alarm_keys();
std::span<const settings::KeyWords> recipe_keys();
std::span<const settings::KeyWords> binding_keys();
std::span<const settings::KeyWords> plant_file_keys();

}  // namespace stepwright::reference
