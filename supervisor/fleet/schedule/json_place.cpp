#include "supervisor/fleet/schedule/json_place.h"

#include <algorithm>
#include <charconv>
#include <set>
#include <vector>

namespace stepwright::fleet {

namespace {

// Reads JSON that is known to be right. No recursion: lists may be nested as deeply as the text is long.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  std::size_t at() const { return at_; }
  bool done() const { return at_ >= text_.size(); }
  char peek() {
    while (!done() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos) ++at_;
    return done() ? '\0' : text_[at_];
  }
  void take() { ++at_; }

  // With the escapes as they are written: equal texts may be written differently, which nobody does.
  std::string_view string() {
    const std::size_t begin = ++at_;
    while (!done() && text_[at_] != '"') at_ += text_[at_] == '\\' ? 2 : 1;
    at_ = std::min(at_, text_.size());
    const auto found = text_.substr(begin, at_ - begin);
    take();
    return found;
  }

  void skip_value() {
    std::size_t depth = 0;
    do {
      const char c = peek();
      if (done()) return;
      if (c == '"') {
        string();
      } else if (c == '{' || c == '[') {
        ++depth;
        take();
      } else if (c == '}' || c == ']') {
        --depth;
        take();
      } else if (c == ',' || c == ':') {
        take();
      } else {
        while (!done() && std::string_view(" \t\r\n,]}").find(text_[at_]) == std::string_view::npos) ++at_;
      }
    } while (depth > 0);
  }

  // To the member's value; where its name stands. The last one of that name counts, as for the JSON library.
  std::optional<std::size_t> member(std::string_view name) {
    if (peek() != '{') return std::nullopt;
    std::optional<std::size_t> key;
    std::size_t value = at_;
    for (take(); peek() == '"';) {
      const std::size_t begin = at_;
      const bool meant = string() == name;
      if (peek() == ':') take();
      if (meant) {
        key = begin;
        value = at_;
      }
      skip_value();
      if (peek() == ',') take();
    }
    at_ = value;
    return key;
  }

  std::optional<std::size_t> item(std::size_t index) {
    if (peek() != '[') return std::nullopt;
    for (take(); peek() != ']' && !done();) {
      if (index-- == 0) return at_;
      skip_value();
      if (peek() == ',') take();
    }
    return std::nullopt;
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

result::Location place_of_byte(std::string_view text, std::size_t byte, const std::string& file) {
  result::Location place{file, 1, 1};
  for (const char c : text.substr(0, std::min(byte, text.size()))) {
    ++place.column;
    if (c != '\n') continue;
    ++place.line;
    place.column = 1;
  }
  return place;
}

result::Location place_of_key(std::string_view text, std::string_view key, const std::string& file) {
  Scanner scanner(text);
  scanner.peek();
  std::size_t place = scanner.at();
  while (!key.empty()) {
    std::optional<std::size_t> found;
    if (key.front() == '[') {
      const std::size_t end = std::min(key.find(']'), key.size() - 1);
      std::size_t index = 0;
      std::from_chars(key.data() + 1, key.data() + end, index);
      found = scanner.item(index);
      key.remove_prefix(end + 1);
    } else {
      const std::size_t end = std::min(key.find_first_of(".["), key.size());
      found = scanner.member(key.substr(0, end));
      key.remove_prefix(end);
    }
    if (!found) break;
    place = *found;
    if (!key.empty() && key.front() == '.') key.remove_prefix(1);
  }
  return place_of_byte(text, place, file);
}

std::optional<DoubleMember> double_member(std::string_view text, const std::string& file) {
  struct Open {
    bool list = false;
    std::set<std::string_view> names;
  };
  Scanner scanner(text);
  std::vector<Open> open;
  bool name_next = false;
  for (char c = scanner.peek(); !scanner.done(); c = scanner.peek()) {
    if (c == '{' || c == '[') {
      open.push_back({c == '[', {}});
      name_next = c == '{';
      scanner.take();
    } else if (c == '}' || c == ']') {
      if (!open.empty()) open.pop_back();
      name_next = false;
      scanner.take();
    } else if (c == ':' || c == ',') {
      name_next = c == ',' && !open.empty() && !open.back().list;
      scanner.take();
    } else if (c == '"' && name_next) {
      const std::size_t begin = scanner.at();
      const std::string_view name = scanner.string();
      if (!open.back().names.insert(name).second) {
        return DoubleMember{std::string(name), place_of_byte(text, begin, file)};
      }
      name_next = false;
    } else {
      scanner.skip_value();
    }
  }
  return std::nullopt;
}

}  // namespace stepwright::fleet
