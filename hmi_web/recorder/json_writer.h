#pragma once

// JSON as it is written: no tree between, so that a trend of thousands of numbers costs its digits.
//
//   JsonWriter out;
//   out.open('{').key("tag").text(name).key("values").open('[').number(1.5).null().close(']').close('}');
//
// Not thread-safe. The caller opens and closes in pairs.

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace stepwright::recorder {

class JsonWriter {
 public:
  JsonWriter& open(char bracket) {
    separate();
    text_ += bracket;
    first_ = true;
    return *this;
  }
  JsonWriter& close(char bracket) {
    text_ += bracket;
    first_ = false;
    return *this;
  }
  JsonWriter& key(std::string_view name) {
    text(name);
    text_ += ':';
    first_ = true;
    return *this;
  }
  JsonWriter& text(std::string_view value) {
    separate();
    text_ += '"';
    for (const char c : value) append(c);
    text_ += '"';
    return *this;
  }
  JsonWriter& boolean(bool value) { return raw(value ? "true" : "false"); }
  JsonWriter& null() { return raw("null"); }
  JsonWriter& integer(std::int64_t value) {
    std::array<char, 24> digits{};
    return raw({digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr});
  }
  // Numbers that JSON cannot express are null.
  JsonWriter& number(double value) {
    if (!std::isfinite(value)) return null();
    std::array<char, 32> digits{};
    return raw({digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr});
  }
  // Milliseconds with three decimals.
  JsonWriter& milliseconds(std::int64_t time_ns) {
    return number(static_cast<double>(time_ns / 1'000) / 1e3);
  }

  std::string take() { return std::move(text_); }

 private:
  JsonWriter& raw(std::string_view word) {
    separate();
    text_ += word;
    return *this;
  }
  void separate() {
    if (!first_) text_ += ',';
    first_ = false;
  }
  void append(char c) {
    if (c == '"' || c == '\\') text_ += '\\';
    if (static_cast<unsigned char>(c) >= 0x20) {
      text_ += c;
      return;
    }
    constexpr std::string_view kDigits = "0123456789abcdef";
    text_ += "\\u00";
    text_ += kDigits[static_cast<unsigned char>(c) >> 4];
    text_ += kDigits[static_cast<unsigned char>(c) & 15];
  }

  std::string text_;
  bool first_ = true;
};

}  // namespace stepwright::recorder
