#include "supervisor/fleet/mission/internal/json_item.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "runtime/ground/result/closest.h"
#include "supervisor/fleet/schedule/json_place.h"

namespace stepwright::fleet::internal {

result::Location JsonComplaints::where(const std::string& key) const {
  return place_of_key(text, key, file);
}

void JsonComplaints::add(std::string code, const std::string& key, const std::string& what,
                         std::string hint) {
  found.push_back({std::move(code), result::Severity::Error, where(key),
                   key.empty() ? what : key + ": " + what, std::move(hint)});
}

std::string JsonItem::key_of(std::string_view name) const {
  return key_.empty() ? std::string(name) : key_ + "." + std::string(name);
}

void JsonItem::refuse(const char* code, const std::string& what, std::string hint) const {
  complaints_->add(code, key_, what, std::move(hint));
}

bool JsonItem::object(std::initializer_list<const char*> names) const {
  if (!value_->is_object()) {
    refuse("F0702", "is no object");
    return false;
  }
  const std::vector<std::string> known(names.begin(), names.end());
  for (const auto& [name, value] : value_->items()) {
    bool is_known = false;
    for (const std::string& one : known) is_known = is_known || one == name;
    if (is_known) continue;
    const std::string* meant = result::closest(name, known, 2);
    complaints_->add("F0702", key_of(name), "is not known here",
                     meant != nullptr ? fmt::format("did you mean '{}'?", *meant)
                                      : fmt::format("known are {}", fmt::join(known, ", ")));
  }
  return true;
}

bool JsonItem::has(const char* name) const {
  return value_->is_object() && value_->contains(name);
}

std::optional<JsonItem> JsonItem::maybe(const char* name) const {
  if (!has(name)) return std::nullopt;
  return JsonItem((*value_)[name], key_of(name), *complaints_);
}

std::optional<JsonItem> JsonItem::member(const char* name) const {
  auto found = maybe(name);
  if (!found) refuse("F0702", fmt::format("lacks '{}'", name));
  return found;
}

std::optional<std::string> JsonItem::text(const char* name, bool required) const {
  const auto found = required ? member(name) : maybe(name);
  return found ? found->as_text() : std::nullopt;
}

std::optional<double> JsonItem::number(const char* name, double least, double most, bool required) const {
  const auto found = required ? member(name) : maybe(name);
  return found ? found->as_number(least, most) : std::nullopt;
}

std::optional<std::int64_t> JsonItem::whole(const char* name, std::int64_t least, std::int64_t most,
                                            bool required) const {
  const auto found = required ? member(name) : maybe(name);
  return found ? found->as_whole(least, most) : std::nullopt;
}

std::optional<bool> JsonItem::truth(const char* name) const {
  const auto found = maybe(name);
  if (!found) return std::nullopt;
  if (found->value_->is_boolean()) return found->value_->get<bool>();
  found->refuse("F0702", "is neither true nor false");
  return std::nullopt;
}

std::vector<JsonItem> JsonItem::items(const char* name, bool required) const {
  const auto found = required ? member(name) : maybe(name);
  return found ? found->as_items() : std::vector<JsonItem>();
}

std::optional<std::string> JsonItem::as_text() const {
  if (value_->is_string() && !value_->get_ref<const std::string&>().empty())
    return value_->get<std::string>();
  refuse("F0702", "is no text, or an empty one");
  return std::nullopt;
}

std::optional<double> JsonItem::as_number(double least, double most) const {
  if (!value_->is_number()) {
    refuse("F0702", "is no number");
    return std::nullopt;
  }
  const double number = value_->get<double>();
  if (number >= least && number <= most) return number;
  refuse("F0703", fmt::format("is {}, outside {} to {}", number, least, most));
  return std::nullopt;
}

std::optional<std::int64_t> JsonItem::as_whole(std::int64_t least, std::int64_t most) const {
  const bool whole = value_->is_number_integer();
  const bool small = !value_->is_number_unsigned() || value_->get<std::uint64_t>() <= INT64_MAX;
  if (!whole) {
    refuse("F0702", "is no whole number");
    return std::nullopt;
  }
  if (small && value_->get<std::int64_t>() >= least && value_->get<std::int64_t>() <= most) {
    return value_->get<std::int64_t>();
  }
  refuse("F0703", fmt::format("is {}, outside {} to {}", value_->dump(), least, most));
  return std::nullopt;
}

std::vector<JsonItem> JsonItem::as_items() const {
  std::vector<JsonItem> all;
  if (!value_->is_array()) {
    refuse("F0702", "is no list");
    return all;
  }
  for (std::size_t k = 0; k < value_->size(); ++k) {
    all.emplace_back((*value_)[k], fmt::format("{}[{}]", key_, k), *complaints_);
  }
  return all;
}

}  // namespace stepwright::fleet::internal
