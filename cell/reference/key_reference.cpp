#include "cell/reference/key_reference.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <set>

namespace stepwright::reference {
namespace {

using settings::AskedKey;
using settings::KeyWords;
using settings::ValueKind;

// What all readers together ask for, by the dotted key.
using AskedKeys = std::map<std::string, AskedKey, std::less<>>;

std::string dotted(const AskedKey& asked) {
  return asked.table.empty() ? asked.key : asked.table + "." + asked.key;
}

// What knows more of the value wins: whoever asks for a choice asks for a text on the way.
void add(const AskedKey& asked, AskedKeys& all) {
  auto [found, first] = all.try_emplace(dotted(asked), asked);
  if (first) return;
  AskedKey& known = found->second;
  const bool required = known.required || asked.required;
  const std::vector<std::string> choices = known.choices.empty() ? asked.choices : known.choices;
  if (asked.kind > known.kind) known = asked;
  known.required = required;
  known.choices = choices;
}

AskedKeys ask(const DescribedFile& file) {
  AskedKeys all;
  for (const std::string_view text : file.samples) {
    auto document = settings::TomlDocument::parse(text, "sample.toml");
    if (!document) continue;  // the test says so
    (*document)->listen([&](const AskedKey& asked) { add(asked, all); });
    file.read(**document);
  }
  return all;
}

std::string number_text(double value) {
  std::array<char, 32> digits{};
  const bool whole = value == std::trunc(value) && std::fabs(value) < 1e15;
  const auto end =
      whole
          ? std::to_chars(digits.data(), digits.data() + digits.size(), static_cast<std::int64_t>(value)).ptr
          : std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  return {digits.data(), end};
}

std::string range_text(const AskedKey& asked) {
  std::string text;
  for (const std::string& choice : asked.choices) text += (text.empty() ? "`" : ", `") + choice + "`";
  if (!text.empty()) return text;
  const settings::Range& range = asked.range;
  const bool low = std::isfinite(range.low);
  const bool high = std::isfinite(range.high);
  if (low && high) return number_text(range.low) + " to " + number_text(range.high);
  if (low) return "at least " + number_text(range.low);
  return high ? "at most " + number_text(range.high) : "";
}

const char* type_text(ValueKind kind) {
  switch (kind) {
    case ValueKind::Presence:
      return "";
    case ValueKind::Text:
      return "text";
    case ValueKind::Choice:
      return "choice";
    case ValueKind::Number:
      return "number";
    case ValueKind::Integer:
      return "whole number";
    case ValueKind::Boolean:
      return "true or false";
    case ValueKind::Texts:
      return "list of texts";
    case ValueKind::Numbers:
      return "list of numbers";
    case ValueKind::NumberRows:
      return "list of lists of numbers";
    case ValueKind::Table:
      return "table";
    case ValueKind::Tables:
      return "list of tables";
  }
  return "";
}

std::string default_text(const AskedKey& asked, const KeyWords& words) {
  if (asked.required) return "needed";
  if (!words.otherwise.empty()) return std::string(words.otherwise);
  const bool list = asked.kind >= ValueKind::Texts && asked.kind <= ValueKind::NumberRows;
  if (asked.fallback.empty()) return list ? "empty" : "none";
  return "`" + asked.fallback + "`";
}

bool is_table(const AskedKey& asked) {
  return asked.kind == ValueKind::Table || asked.kind == ValueKind::Tables;
}

KeyEntry entry_of(const AskedKey& asked, const KeyWords& words) {
  KeyEntry entry;
  entry.key = asked.key;
  entry.type = type_text(asked.kind);
  entry.unit = words.unit.empty() ? settings::unit_of(asked.key) : words.unit;
  entry.otherwise = default_text(asked, words);
  entry.range = words.range.empty() ? range_text(asked) : std::string(words.range);
  entry.text = words.text;
  return entry;
}

}  // namespace

KeyReference key_reference(const DescribedFile& file) {
  const AskedKeys asked = ask(file);
  KeyReference reference;
  reference.title = file.title;
  reference.about = file.about;
  std::set<std::string, std::less<>> described;
  std::map<std::string, std::size_t, std::less<>> place;
  for (const KeyWords& words : file.words) {
    const auto found = asked.find(words.key);
    const bool twice = !described.emplace(words.key).second;
    if (twice || found == asked.end() || found->second.kind == ValueKind::Presence) {
      reference.unasked.emplace_back(words.key);
      continue;
    }
    const AskedKey& key = found->second;
    if (is_table(key)) {
      place[std::string(words.key)] = reference.tables.size();
      reference.tables.push_back(
          {std::string(words.key), key.kind == ValueKind::Tables, std::string(words.text), {}});
      continue;
    }
    auto table = place.find(key.table);
    if (table == place.end() && key.table.empty()) {
      table = place.emplace("", reference.tables.size()).first;
      reference.tables.push_back({"", false, "Before the first table.", {}});
    }
    if (table == place.end()) {
      reference.undescribed.push_back(key.table);
      continue;
    }
    reference.tables[table->second].keys.push_back(entry_of(key, words));
  }
  // Whether a name is there is asked of names that the file chooses, too; who reads a key asks for its value.
  for (const auto& [name, key] : asked)
    if (!described.contains(name) && key.kind != ValueKind::Presence) reference.undescribed.push_back(name);
  return reference;
}

}  // namespace stepwright::reference
