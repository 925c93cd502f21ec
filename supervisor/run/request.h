#pragma once

// Request of people to a run: a word, and what goes with it. The text comes over Fast DDS from anywhere:
// whatever it is, it is a request or it is refused. What a word means is the mission's (Mission::obey).
//
//   auto request = Request::parse(R"({"request": "change", "fluent": "(demand c1)", "value": 8})");
//   request->word()            // "change"
//   request->text("fluent")    // "(demand c1)"
//   request->number("value")   // 8
//
// A value; any thread.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "runtime/ground/result/result.h"

namespace stepwright::run {

class Request {
 public:
  using Rows = std::vector<std::vector<double>>;
  // Of what goes with a word. Nothing: of another type.
  using Value = std::variant<std::monostate, std::string, double, std::uint64_t, Rows>;

  // Fails with X0005 for a text that is no JSON object with a word.
  [[nodiscard]] static result::Result<Request> parse(const std::string& text);

  const std::string& word() const { return word_; }
  // Of any type.
  bool has(std::string_view key) const { return values_.contains(key); }
  // Nothing where it is missing or of another type.
  std::optional<std::string> text(std::string_view key) const;
  std::optional<double> number(std::string_view key) const;
  // Up to `most` rows of `width` numbers each.
  std::optional<Rows> rows(std::string_view key, std::size_t width, std::size_t most) const;
  // The same, of what may be left out. A count is a whole number up to `most`.
  std::optional<std::string> text_or(std::string_view key, const char* fallback) const;
  std::optional<std::uint64_t> count_or(std::string_view key, std::uint64_t fallback,
                                        std::uint64_t most) const;

 private:
  std::string word_;
  std::map<std::string, Value, std::less<>> values_;
};

// X0005: a known word without what has to go with it.
[[nodiscard]] result::Result<void> no_request(const char* hint);
// X0003: a word that this mission does not know.
[[nodiscard]] result::Result<void> not_of_this_mission(const char* hint);

}  // namespace stepwright::run
