#pragma once

// A value of a JSON file with its key and its collector of errors, so that reading goes on after an error and
// all errors are reported at once. Borrows the document. One thread at a time.
//
//   const JsonItem vehicle = ...;
//   if (const auto speed = vehicle.number("max_mps", 0.1, 100.0)) limits.max_mps = *speed;

#include <cstdint>
#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "supervisor/fleet/mission/mission_problem.h"

namespace stepwright::fleet::internal {

// Errors found in one file.
struct JsonComplaints {
  std::string_view text;
  std::string file;
  result::Diagnostics found;

  result::Location where(const std::string& key) const;
  void add(std::string code, const std::string& key, const std::string& what, std::string hint = {});
};

class JsonItem {
 public:
  JsonItem(const nlohmann::json& value, std::string key, JsonComplaints& complaints)
      : value_(&value), key_(std::move(key)), complaints_(&complaints) {}

  const nlohmann::json& value() const { return *value_; }
  const std::string& key() const { return key_; }
  std::string key_of(std::string_view name) const;
  void refuse(const char* code, const std::string& what, std::string hint = {}) const;

  // Whether it is an object; tells members that are none of these, each with what was meant.
  bool object(std::initializer_list<const char*> names) const;
  bool has(const char* name) const;
  // F0702 if it is missing.
  std::optional<JsonItem> member(const char* name) const;
  std::optional<JsonItem> maybe(const char* name) const;

  // Members; nothing where they are missing (which is told if `required`) or wrong (which is always told).
  std::optional<std::string> text(const char* name, bool required = true) const;
  std::optional<double> number(const char* name, double least, double most, bool required = true) const;
  std::optional<std::int64_t> whole(const char* name, std::int64_t least, std::int64_t most,
                                    bool required = true) const;
  std::optional<bool> truth(const char* name) const;
  std::vector<JsonItem> items(const char* name, bool required = false) const;

  // The value itself.
  std::optional<std::string> as_text() const;
  std::optional<double> as_number(double least, double most) const;
  std::optional<std::int64_t> as_whole(std::int64_t least, std::int64_t most) const;
  std::vector<JsonItem> as_items() const;

 private:
  const nlohmann::json* value_;
  std::string key_;
  JsonComplaints* complaints_;
};

}  // namespace stepwright::fleet::internal
