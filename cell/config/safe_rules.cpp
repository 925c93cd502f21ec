#include "cell/config/safe_rules.h"

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "runtime/ground/naming/direct_address.h"

namespace stepwright::config {
namespace {

using scan::RampType;
using settings::TomlTable;

struct NumberType {
  const char* name;
  std::uint8_t bits;
  RampType type;
  double low;
  double high;
};

// The first of a width is the one that a number has without a type.
constexpr double kReal = std::numeric_limits<float>::max();
constexpr std::array kTypes = {
    NumberType{"USINT", 8, RampType::U8, 0, 255},
    NumberType{"SINT", 8, RampType::I8, -128, 127},
    NumberType{"INT", 16, RampType::I16, -32'768, 32'767},
    NumberType{"UINT", 16, RampType::U16, 0, 65'535},
    NumberType{"DINT", 32, RampType::I32, -2'147'483'648.0, 2'147'483'647.0},
    NumberType{"UDINT", 32, RampType::U32, 0, 4'294'967'295.0},
    NumberType{"REAL", 32, RampType::F32, -kReal, kReal},
};

// Reads one line.
class RuleReader {
 public:
  RuleReader(const TomlTable& table, const std::string& key, std::uint32_t output_bytes,
             result::Diagnostics& problems)
      : table_(table), key_(key), output_bytes_(output_bytes), problems_(problems) {}

  std::optional<SafeRule> read() {
    const auto address = naming::parse_direct_address(key_);
    if (!address) {
      // Asked for, so that it is not an unknown key as well.
      static_cast<void>(table_.has_table(key_) ? table_.table(key_).has("value")
                                               : table_.text(key_, {}).empty());
      return fail("C0302", "'" + key_ + "' is no output address", "for example %QX0.3, %QB1, %QW2 or %QD3");
    }
    rule_.address = key_;
    rule_.where = table_.where(key_);
    rule_.first_bit = address->byte * 8 + address->bit;
    rule_.bits = address->bits;
    const bool good = table_.has_table(key_) ? read_long(table_.table(key_)) : read_short();
    if (!good) return std::nullopt;
    if (address->area != naming::Area::Output || rule_.end_bit() > output_bytes_ * 8 || address->bits == 64) {
      return fail("C0303", key_ + " is not among the outputs of the cell",
                  "the area has " + std::to_string(output_bytes_) + " bytes, see [image] output_bytes");
    }
    return std::move(rule_);
  }

 private:
  std::nullopt_t fail(const char* code, std::string message, std::string hint) {
    problems_.push_back(
        {code, result::Severity::Error, table_.where(key_), std::move(message), std::move(hint)});
    return std::nullopt;
  }

  // A word, or the value alone.
  bool read_short() {
    if (!table_.is_text(key_)) return read_value(table_.number(key_, 0.0), {});
    const std::string action = table_.choice(key_, "zero", {"zero", "hold", "one"});
    add_bytes(action == "hold"  ? scan::SafeMode::Hold
              : action == "one" ? scan::SafeMode::Value
                                : scan::SafeMode::Zero,
              ~std::uint64_t{0});
    return true;
  }

  // { value = ... } or { ramp_to = ..., per_second = ... }, each with a type.
  bool read_long(const TomlTable& table) {
    const bool fixed = table.has("value");
    const bool ramped = table.has("ramp_to");
    const double value = table.number("value", 0.0);
    const double target = table.number("ramp_to", 0.0);
    const double per_second = table.number("per_second", 0.0);
    const std::string type_name = table.text("type", {});
    if (fixed == ramped || ramped != table.has("per_second")) {
      fail("C0442", "what " + key_ + " does is not said, or said twice",
           "{ value = 500 }, or { ramp_to = 0, per_second = 100 }");
      return false;
    }
    if (fixed) return read_value(value, type_name);
    if (rule_.bits == 1) {
      fail("C0442", key_ + " is one bit: it has no ramp", "\"zero\", \"hold\", \"one\", 0 or 1");
      return false;
    }
    const NumberType* const type = type_of(type_name);
    if (type == nullptr || !fits(*type, target)) return false;
    if (!(per_second > 0.0) || !std::isfinite(per_second)) {
      fail("C0443", "the ramp of " + key_ + " does not move", "per_second must be above 0");
      return false;
    }
    rule_.ramp = scan::SafeRamp{rule_.first_bit / 8, type->type, target, per_second};
    return true;
  }

  bool read_value(double value, const std::string& type_name) {
    if (rule_.bits == 1) return read_bit(value, type_name);
    const NumberType* const type = type_of(type_name);
    if (type == nullptr || !fits(*type, value)) return false;
    add_bytes(scan::SafeMode::Value, bits_of(*type, value));
    return true;
  }

  bool read_bit(double value, const std::string& type_name) {
    if (!type_name.empty()) {
      fail("C0442", key_ + " is one bit: it has no type", "\"zero\", \"hold\", \"one\", 0 or 1");
      return false;
    }
    if (value != 0.0 && value != 1.0) {
      fail("C0443", "the value of " + key_ + " is neither 0 nor 1", "0, 1, \"zero\" or \"one\"");
      return false;
    }
    add_bytes(scan::SafeMode::Value, value != 0.0 ? ~std::uint64_t{0} : 0);
    return true;
  }

  const NumberType* type_of(const std::string& name) {
    std::string possible;
    for (const NumberType& type : kTypes) {
      if (type.bits != rule_.bits) continue;
      if (name.empty() || naming::same_name(name, type.name)) return &type;
      possible += (possible.empty() ? "" : ", ") + std::string(type.name);
    }
    fail("C0443", "'" + name + "' is no type for " + key_, "it may be " + possible);
    return nullptr;
  }

  bool fits(const NumberType& type, double value) {
    const bool whole = type.type == RampType::F32 || value == std::trunc(value);
    if (whole && value >= type.low && value <= type.high) return true;
    std::string other;
    for (const NumberType& candidate : kTypes) {
      const bool better = candidate.bits == type.bits && value >= candidate.low && value <= candidate.high &&
                          (candidate.type == RampType::F32 || value == std::trunc(value));
      if (other.empty() && better) other = candidate.name;
    }
    fail("C0443", "the number for " + key_ + " does not fit " + type.name,
         other.empty() ? "" : "it would fit type = \"" + other + "\"");
    return false;
  }

  static std::uint64_t bits_of(const NumberType& type, double value) {
    if (type.type == RampType::F32) return std::bit_cast<std::uint32_t>(static_cast<float>(value));
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(value));
  }

  void add_bytes(scan::SafeMode mode, std::uint64_t value) {
    const std::uint32_t first = rule_.first_bit / 8;
    if (rule_.bits == 1) {
      rule_.outputs.push_back({first, static_cast<std::uint8_t>(1u << rule_.first_bit % 8), mode,
                               static_cast<std::uint8_t>(value)});
      return;
    }
    for (std::uint32_t i = 0; i < rule_.bits / 8; ++i)
      rule_.outputs.push_back({first + i, 0xFF, mode, static_cast<std::uint8_t>(value >> 8 * i)});
  }

  const TomlTable& table_;
  const std::string& key_;
  std::uint32_t output_bytes_;
  result::Diagnostics& problems_;
  SafeRule rule_;
};

}  // namespace

std::vector<SafeRule> read_safe_rules(const TomlTable& table, std::uint32_t output_bytes,
                                      result::Diagnostics& problems) {
  std::vector<SafeRule> rules;
  for (const std::string& key : table.keys()) {
    std::optional<SafeRule> rule = RuleReader(table, key, output_bytes, problems).read();
    if (!rule) continue;
    for (const SafeRule& other : rules) {
      if (!rule->overlaps(other)) continue;
      problems.push_back({"C0444", result::Severity::Error, rule->where,
                          rule->address + " and " + other.address + " of this table share bits",
                          "say for each output once what it does"});
    }
    rules.push_back(std::move(*rule));
  }
  return rules;
}

}  // namespace stepwright::config
