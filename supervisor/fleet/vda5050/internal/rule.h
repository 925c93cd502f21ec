#pragma once

// Rules for single members of a message, as tables, and how they are applied.
//
// Tables are constant; functions are pure.
//
//   Findings findings(source);
//   apply(rule_of(Topic::State), root, {}, findings);

#include <cstdint>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>

#include "runtime/ground/result/diagnostic.h"
#include "supervisor/fleet/vda5050/topic.h"

namespace stepwright::fleet::vda5050 {

enum class Kind : std::uint8_t { Object, List, Text, Whole, Number, Boolean, NotNull };

enum class Form : std::uint8_t {
  Any,
  Time,     // timestamp_of
  Version,  // 2.1.0
};

struct Member;

struct Rule {
  Kind kind = Kind::Object;
  std::span<const Member> members{};          // Object: others may be there, too
  const Rule* items = nullptr;                // List
  std::size_t fewest = 0;                     // List
  std::span<const std::string_view> words{};  // Text: one of these; none: any
  Form form = Form::Any;                      // Text
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
};

struct Member {
  std::string_view name;
  bool required = false;
  const Rule* rule = nullptr;
};

// Where in the message, without a copy of it.
struct Place {
  const Place* parent = nullptr;
  std::string_view name{};
  std::size_t index = 0;  // of a list, where the name is empty

  Place at(std::string_view member) const { return {this, member, 0}; }
  Place at(std::size_t item) const { return {this, {}, item}; }
};

// As a JSON pointer (RFC 6901); empty for the whole message.
std::string to_pointer(const Place& place);

// Gathers the first twenty.
class Findings {
 public:
  explicit Findings(const std::string& source) : source_(source) {}

  bool none() const { return found_.empty(); }
  bool full() const { return found_.size() >= 20; }
  void add(const char* code, const Place& place, const std::string& what, const std::string& hint = {});
  result::Diagnostics take() { return std::move(found_); }

 private:
  const std::string& source_;
  result::Diagnostics found_;
};

// F0902 and F0903.
void apply(const Rule& rule, const nlohmann::json& value, const Place& place, Findings& findings);

const Rule& rule_of(Topic topic);

// The parts that several tables need.
namespace rules {
inline constexpr double kMostWhole = 4294967295.0;
inline constexpr double kPi = 3.14159265359;  // as the schemas round it, upwards
inline constexpr Rule kText{.kind = Kind::Text};
inline constexpr Rule kNumber{.kind = Kind::Number};
inline constexpr Rule kNotNegative{.kind = Kind::Number, .least = 0.0};
inline constexpr Rule kFraction{.kind = Kind::Number, .least = 0.0, .most = 1.0};
inline constexpr Rule kAngle{.kind = Kind::Number, .least = -kPi, .most = kPi};
inline constexpr Rule kBoolean{.kind = Kind::Boolean};
inline constexpr Rule kCount{.kind = Kind::Whole, .least = 0.0, .most = kMostWhole};
inline constexpr Rule kTimestamp{.kind = Kind::Text, .form = Form::Time};
inline constexpr Rule kVersion{.kind = Kind::Text, .form = Form::Version};
inline constexpr Rule kTexts{.kind = Kind::List, .items = &kText};

extern const Rule kOrder;
extern const Rule kInstantActions;
extern const Rule kState;
extern const Rule kVisualization;
extern const Rule kConnection;
extern const Rule kFactsheet;
}  // namespace rules

}  // namespace stepwright::fleet::vda5050
