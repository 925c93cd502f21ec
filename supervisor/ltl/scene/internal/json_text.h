#pragma once

// JSON as a reader of scenes and problems needs it: text to values with the place of an error, members by
// name without copies, numbers within bounds, and the errors of one file, each with the member that it is
// about.
//
// Functions without state; any thread.

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/ground/result/result.h"

namespace stepwright::ltl::internal {

inline constexpr double kFarthest_m = 1e6;  // of a coordinate from the origin

class Complaints {
 public:
  explicit Complaints(std::string file) : file_(std::move(file)) {}

  // `key` names the member: "features[3].geometry".
  void add(const char* code, const std::string& key, const std::string& message, std::string hint = {});
  // Those of another reader; what does not say its file is of this one.
  void take(result::Diagnostics&& more);
  const std::string& file() const { return file_; }

  result::Diagnostics found;

 private:
  std::string file_;
};

// L0401: no JSON; L0405: two members of one name in an object; both with line and column.
[[nodiscard]] result::Result<nlohmann::json> parse(std::string_view text, const std::string& file);

// null where there is no such member, or `object` is none.
const nlohmann::json& member(const nlohmann::json& object, const char* name);

// L0402: no number; L0403: out of range.
std::optional<double> number(const nlohmann::json& value, const std::string& key, double least, double most,
                             Complaints& wrong);

// L0402: no object, or members of other names.
bool is_object(const nlohmann::json& value, const std::string& key, std::initializer_list<const char*> names,
               Complaints& wrong);

}  // namespace stepwright::ltl::internal
