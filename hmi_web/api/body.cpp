#include "hmi_web/api/body.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "hmi_web/api/internal/known_names.h"

namespace stepwright::api {
namespace {

using nlohmann::json;

// Counts what the parser has read, so that its events have a place.
struct Reading {
  std::string_view text;
  std::size_t at = 0;

  result::Location where() const {
    const std::string_view read = text.substr(0, at);
    const std::size_t line_start = read.rfind('\n');
    const std::size_t start = line_start == std::string_view::npos ? 0 : line_start + 1;
    const auto lines = std::count(read.begin(), read.end(), '\n');
    return {"body", static_cast<std::uint32_t>(lines + 1),
            static_cast<std::uint32_t>(std::max<std::size_t>(at - start, 1))};
  }
};

class Cursor {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  Cursor(Reading* reading, std::size_t at) : reading_(reading), at_(at) {}
  const char& operator*() const { return reading_->text[at_]; }
  Cursor& operator++() {
    reading_->at = ++at_;
    return *this;
  }
  bool operator==(const Cursor& other) const { return at_ == other.at_; }
  bool operator!=(const Cursor& other) const { return at_ != other.at_; }

 private:
  Reading* reading_;
  std::size_t at_;
};

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

// Takes the parser's events; the first fault ends the reading.
class Events : public nlohmann::json_sax<json> {
 public:
  Events(const Reading& reading, const Shape& shape) : reading_(reading), shape_(shape) {}

  bool null() override { return wrong_type("null"); }
  bool boolean(bool value) override { return take(Kind::Boolean, value); }
  bool number_integer(number_integer_t value) override { return number(static_cast<double>(value)); }
  bool number_unsigned(number_unsigned_t value) override { return number(static_cast<double>(value)); }
  bool number_float(number_float_t value, const string_t&) override { return number(value); }
  bool string(string_t& value) override {
    if (in_list_) return take_item(std::move(value));
    return in_texts_ ? take_text(std::move(value)) : take(Kind::Text, std::move(value));
  }
  bool binary(binary_t&) override { return wrong_type("bytes"); }

  bool start_object(std::size_t) override {
    if (depth_ == 0) return ++depth_ > 0;
    if (depth_ > 1 || in_list_) return too_deep();
    if (field_ == nullptr || field_->kind != Kind::Texts) return wrong_type("an object");
    in_texts_ = true;
    texts_.clear();
    return ++depth_ > 0;
  }
  bool end_object() override {
    if (--depth_ == 0) return true;
    in_texts_ = false;
    return take(Kind::Texts, std::exchange(texts_, {}));
  }
  bool start_array(std::size_t) override {
    if (depth_ == 0) return fault("H0030", "the body is no JSON object", "{...}");
    if (in_texts_ || in_list_) return too_deep();
    if (field_ != nullptr && field_->kind == Kind::List) {
      in_list_ = true;
      list_.clear();
      return ++depth_ > 0;
    }
    if (field_ == nullptr || field_->kind != Kind::Points) return wrong_type("a list");
    if (depth_ == 3) return too_deep();
    if (++depth_ == 3) pair_.clear();
    return true;
  }
  bool end_array() override {
    if (in_list_) {
      in_list_ = false;
      --depth_;
      return take(Kind::List, std::exchange(list_, {}));
    }
    if (--depth_ == 1) return take(Kind::Points, std::exchange(points_, {}));
    if (pair_.size() != 2) return wrong_type("something else than pairs of numbers");
    points_.push_back({pair_[0], pair_[1]});
    return static_cast<double>(points_.size()) <= field_->most || out_of_range();
  }
  bool key(string_t& name) override {
    if (in_texts_) return take_key(name);
    const auto found = std::find_if(shape_.fields.begin(), shape_.fields.end(),
                                    [&](const Field& field) { return field.name == name; });
    if (found == shape_.fields.end()) return unknown(name);
    field_ = &*found;
    if (body.has(name)) return fault("H0031", "'" + name + "' is there twice", "leave one of them out");
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
    return fault("H0030", "the body is no JSON from here on", "one object, UTF-8");
  }

  void finish() {
    for (const Field& field : shape_.fields) {
      if (problem || !field.required || body.has(field.name)) continue;
      fault("H0032", "'" + field.name + "' is missing", field.description);
    }
  }

  Body body;
  std::optional<result::Diagnostics> problem;

 private:
  bool fault(const char* code, std::string message, std::string hint = {}) {
    if (!problem) problem = result::fail(code, reading_.where(), std::move(message), std::move(hint)).value();
    return false;
  }
  bool too_deep() { return fault("H0033", "the body is nested too deeply", "flat members only"); }
  bool unknown(const std::string& name) {
    std::vector<std::string> names;
    for (const Field& field : shape_.fields) names.push_back(field.name);
    const std::string shown = name.substr(0, kMostNameBytes);
    return fault("H0031", "there is no member '" + shown + "'", names_hint(shown, names));
  }
  bool wrong_type(const std::string& found) {
    if (depth_ == 0) return fault("H0030", "the body is no JSON object", "{...}");
    const std::string name = in_texts_ ? key_ : field_ != nullptr ? field_->name : "";
    return fault("H0033", "'" + name + "' is " + found, expected());
  }
  std::string expected() const {
    if (field_ == nullptr) return {};
    switch (field_->kind) {
      case Kind::Text:
        return "a text: " + field_->description;
      case Kind::Number:
        return (field_->whole ? "a whole number: " : "a number: ") + field_->description;
      case Kind::Boolean:
        return "true or false: " + field_->description;
      case Kind::Points:
        return "a list of pairs [x, y]: " + field_->description;
      case Kind::Texts:
        return "an object whose members are texts: " + field_->description;
      case Kind::List:
        return "a list of texts: " + field_->description;
    }
    return {};
  }
  bool out_of_range() {
    const std::string range = number_text(field_->least) + " to " + number_text(field_->most);
    const char* unit = field_->kind == Kind::Text     ? " bytes"
                       : field_->kind == Kind::Points ? " points"
                       : field_->kind == Kind::Texts  ? " members"
                       : field_->kind == Kind::List   ? " texts"
                                                      : "";
    return fault("H0033", "'" + field_->name + "' is out of range", range + unit);
  }
  bool number(double value) {
    if (in_texts_ || in_list_) return wrong_type("a number");
    if (depth_ == 3) {
      pair_.push_back(value);
      return (std::isfinite(value) && pair_.size() <= 2) ||
             wrong_type("something else than pairs of numbers");
    }
    return take(Kind::Number, value);
  }
  bool take(Kind kind, Body::Value value) {
    constexpr const char* kNames[] = {"a text", "a number", "a truth value", "a list", "an object", "a list"};
    if (depth_ != 1 || field_ == nullptr || field_->kind != kind)
      return wrong_type(kNames[static_cast<std::size_t>(kind)]);
    const double size = kind == Kind::Text     ? static_cast<double>(std::get<std::string>(value).size())
                        : kind == Kind::Number ? std::get<double>(value)
                        : kind == Kind::Points
                            ? static_cast<double>(std::get<std::vector<Point>>(value).size())
                        : kind == Kind::Texts ? static_cast<double>(std::get<Body::Texts>(value).size())
                        : kind == Kind::List  ? static_cast<double>(std::get<Body::List>(value).size())
                                              : field_->least;
    if (kind == Kind::Text && size == 0 && field_->least > 0)
      return fault("H0033", "'" + field_->name + "' is empty", field_->description);
    if (!(size >= field_->least && size <= field_->most)) return out_of_range();
    if (kind == Kind::Number && field_->whole && size != std::floor(size))
      return wrong_type("no whole number");
    if (kind == Kind::Text && !field_->choices.empty() && !is_choice(std::get<std::string>(value)))
      return false;
    body.set(field_->name, std::move(value));
    return true;
  }
  bool take_key(const std::string& name) {
    if (name.empty() || name.size() > kLongestKey)
      return fault("H0033", "a name in '" + field_->name + "' is out of range",
                   "1 to " + std::to_string(kLongestKey) + " bytes");
    if (texts_.contains(name))
      return fault("H0031", "'" + name + "' is there twice", "leave one of them out");
    if (static_cast<double>(texts_.size()) >= field_->most) return out_of_range();
    key_ = name;
    return true;
  }
  bool take_text(std::string value) {
    if (value.size() > field_->longest)
      return fault("H0033", "'" + key_ + "' is out of range",
                   "0 to " + std::to_string(field_->longest) + " bytes");
    texts_.emplace(key_, std::move(value));
    return true;
  }
  bool take_item(std::string value) {
    if (value.size() > field_->longest)
      return fault("H0033", "a text in '" + field_->name + "' is out of range",
                   "0 to " + std::to_string(field_->longest) + " bytes");
    list_.push_back(std::move(value));
    return static_cast<double>(list_.size()) <= field_->most || out_of_range();
  }
  bool is_choice(const std::string& text) {
    const auto& choices = field_->choices;
    if (std::find(choices.begin(), choices.end(), text) != choices.end()) return true;
    std::string all;
    for (const std::string& choice : choices) all += (all.empty() ? "" : ", ") + choice;
    return fault("H0033", "'" + field_->name + "' is none of its choices", all);
  }

  const Reading& reading_;
  const Shape& shape_;
  const Field* field_ = nullptr;
  int depth_ = 0;  // 1 in the object, 2 in a list of points or an object of texts, 3 in a point
  std::vector<double> pair_;
  std::vector<Point> points_;
  bool in_texts_ = false;
  std::string key_;  // in an object of texts
  Body::Texts texts_;
  bool in_list_ = false;
  Body::List list_;
};

}  // namespace

template <typename T>
const T* Body::find(std::string_view name) const {
  const auto found = values_.find(name);
  return found == values_.end() ? nullptr : std::get_if<T>(&found->second);
}

const std::string& Body::text(std::string_view name) const {
  static const std::string kNone;
  const auto* found = find<std::string>(name);
  return found != nullptr ? *found : kNone;
}

double Body::number(std::string_view name, double otherwise) const {
  const auto* found = find<double>(name);
  return found != nullptr ? *found : otherwise;
}

bool Body::boolean(std::string_view name, bool otherwise) const {
  const auto* found = find<bool>(name);
  return found != nullptr ? *found : otherwise;
}

const std::vector<Point>& Body::points(std::string_view name) const {
  static const std::vector<Point> kNone;
  const auto* found = find<std::vector<Point>>(name);
  return found != nullptr ? *found : kNone;
}

const Body::Texts& Body::texts(std::string_view name) const {
  static const Texts kNone;
  const auto* found = find<Texts>(name);
  return found != nullptr ? *found : kNone;
}

const Body::List& Body::list(std::string_view name) const {
  static const List kNone;
  const auto* found = find<List>(name);
  return found != nullptr ? *found : kNone;
}

result::Result<Body> read_body(std::string_view text, const Shape& shape) {
  Reading reading{text};
  Events events(reading, shape);
  const bool read = json::sax_parse(Cursor(&reading, 0), Cursor(&reading, text.size()), &events);
  if (read) events.finish();
  if (events.problem) return tl::unexpected(*std::move(events.problem));
  if (!read) return result::fail("H0030", reading.where(), "the body is no JSON");
  return std::move(events.body);
}

}  // namespace stepwright::api
