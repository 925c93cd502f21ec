#pragma once

// The reference of a file, a cell's or one that it names, made from the code that reads it: what its readers
// ask for (type, default, range: runtime/ground/settings/asked_key.h) beside what people are told
// (described_file.h).
//
//   const KeyReference reference = key_reference(*find_described_file("alarms"));
//   std::fputs(markdown_of(reference).c_str(), stdout);
//
// Thread-safe: pure, apart from looking whether files of sample cells are there.

#include <string>
#include <vector>

#include "cell/reference/described_file.h"
#include "runtime/ground/settings/asked_key.h"

namespace stepwright::reference {

// One key. Texts are in words of the document, "" where there is nothing to say.
struct KeyEntry {
  std::string key{};   // without its table; of a table: its own last name
  std::string type{};  // "whole number", "true or false", "text"
  std::string unit{};
  std::string otherwise{};  // the default; "needed" where there is none
  std::string range{};      // or the choices
  std::string text{};
};

struct TableEntry {
  std::string name{};  // dotted: "plant.vehicles"
  bool array = false;  // [[plant.vehicles]]
  std::string text{};
  std::vector<KeyEntry> keys{};
};

struct KeyReference {
  std::string title{};
  std::string about{};
  std::vector<TableEntry> tables{};        // in the order of the words
  std::vector<std::string> undescribed{};  // keys that a reader asks for, and nobody has words for
  std::vector<std::string> unasked{};      // keys with words that no reader asks for
};

KeyReference key_reference(const DescribedFile& file);

std::string markdown_of(const KeyReference& reference);
// {"tables": [{"name", "array", "text", "keys": [{"key", "type", "unit", "default", "range", "text"}]}]}
std::string json_of(const KeyReference& reference);

}  // namespace stepwright::reference
