#include "ladder/graphic/type_text.h"

#include <algorithm>
#include <cctype>

#include "ladder/graphic/identifier.h"

namespace stepwright::graphic {
namespace {

constexpr int kMaxDepth = 64;  // of types in types; more is nothing that anyone wrote

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

// Walks over a text; tells whether a place is outside of everything that keeps its content together.
class Walk {
 public:
  explicit Walk(std::string_view text) : text_(text) {}

  bool at_end() const { return at_ >= text_.size(); }
  bool outside() const { return brackets_ == 0 && structures_ == 0; }
  std::size_t place() const { return at_; }
  char here() const { return text_[at_]; }

  void next() {
    const char c = text_[at_];
    if (c == '\'' || c == '"') return skip_string(c);
    if (is_word(c)) return skip_word();
    if (c == '(' || c == '[') ++brackets_;
    if (c == ')' || c == ']') --brackets_;
    ++at_;
  }

 private:
  void skip_string(char quote) {
    for (++at_; at_ < text_.size() && text_[at_] != quote; ++at_)
      if (text_[at_] == '$') ++at_;
    at_ = std::min(at_ + 1, text_.size());
  }

  void skip_word() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_word(text_[at_])) ++at_;
    const std::string_view word = text_.substr(begin, at_ - begin);
    if (same_name(word, "STRUCT")) ++structures_;
    if (same_name(word, "END_STRUCT")) --structures_;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int brackets_ = 0;
  int structures_ = 0;
};

// `word` as a whole at the beginning.
bool begins_with(std::string_view text, std::string_view word) {
  return text.size() >= word.size() && same_name(text.substr(0, word.size()), word) &&
         (text.size() == word.size() || !is_word(text[word.size()]));
}

bool enclosed(const std::string& text, char open, char close) {
  return text.size() > 1 && text.front() == open && text.back() == close;
}

// 'text', "text", STRING#'text'.
bool is_string_literal(std::string_view text) {
  const std::size_t hash = text.find('#');
  const bool typed = hash != std::string_view::npos && is_string_type(text.substr(0, hash));
  if (typed) text.remove_prefix(hash + 1);
  return text.size() > 1 && (text.front() == '\'' || text.front() == '"') && text.back() == text.front();
}

// Of "$N", "$0D" at the beginning; 0 if there is none.
std::size_t escape_length(std::string_view text) {
  const auto is_hex = [](char c) { return std::isxdigit(static_cast<unsigned char>(c)) != 0; };
  if (text.size() < 2 || text[0] != '$') return 0;
  if (std::string_view("$'\"LNPRTlnprt").find(text[1]) != std::string_view::npos) return 2;
  return text.size() > 2 && is_hex(text[1]) && is_hex(text[2]) ? 3 : 0;
}

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& each : parts) text += (text.empty() ? "" : ", ") + each;
  return text;
}

class Quoting {
 public:
  explicit Quoting(const TypeBehind& behind) : behind_(behind) {}

  std::string value(const std::string& value, const std::string& named, int depth) const {
    const std::string type = behind_(trimmed(named));
    if (value.empty() || depth > kMaxDepth) return value;
    if (is_string_type(type))
      return is_string_literal(value) ? value : string_literal(value, is_wide_string_type(type));
    if (enclosed(value, '[', ']') && !element_type(type).empty()) return array(value, type, depth);
    if (enclosed(value, '(', ')') && is_structure(type)) return structure(value, type, depth);
    return value;
  }

  std::string type(const std::string& type, int depth) const {
    if (depth > kMaxDepth || !is_structure(type)) return type;
    std::vector<StructureMember> members = members_of(type);
    for (StructureMember& each : members) {
      each.initial = value(each.initial, each.type, depth + 1);
      each.type = this->type(each.type, depth + 1);
    }
    return structure_text(members);
  }

 private:
  std::string array(const std::string& text, const std::string& type, int depth) const {
    std::vector<std::string> parts = split_outside(text.substr(1, text.size() - 2), ',');
    for (std::string& each : parts) {
      const auto [count, own] = repetition_of(each);
      const std::string quoted = value(own, element_type(type), depth + 1);
      each = count == "1" ? quoted : count + "(" + quoted + ")";
    }
    return "[" + joined(parts) + "]";
  }

  std::string structure(const std::string& text, const std::string& type, int depth) const {
    const std::vector<StructureMember> members = members_of(type);
    std::vector<std::string> parts = split_outside(text.substr(1, text.size() - 2), ',');
    for (std::string& each : parts) {
      const std::size_t assign = find_outside(each, ":=");
      if (assign == std::string::npos) continue;
      const std::string name = trimmed(each.substr(0, assign));
      for (const StructureMember& member : members)
        if (same_name(member.name, name))
          each = name + " := " + value(trimmed(each.substr(assign + 2)), member.type, depth + 1);
    }
    return "(" + joined(parts) + ")";
  }

  const TypeBehind& behind_;
};

}  // namespace

std::string trimmed(std::string_view text) {
  const char* blank = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(blank);
  if (begin == std::string_view::npos) return {};
  return std::string(text.substr(begin, text.find_last_not_of(blank) + 1 - begin));
}

std::vector<std::string> split_outside(std::string_view text, char separator) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  Walk walk(text);
  for (; !walk.at_end(); walk.next()) {
    if (walk.here() != separator || !walk.outside()) continue;
    parts.push_back(trimmed(text.substr(begin, walk.place() - begin)));
    begin = walk.place() + 1;
  }
  parts.push_back(trimmed(text.substr(begin)));
  if (parts.back().empty()) parts.pop_back();
  return parts;
}

std::size_t find_outside(std::string_view text, std::string_view what) {
  for (Walk walk(text); !walk.at_end(); walk.next())
    if (walk.outside() && text.substr(walk.place(), what.size()) == what) return walk.place();
  return std::string_view::npos;
}

bool is_string_type(std::string_view type) {
  return begins_with(type, "STRING") || begins_with(type, "WSTRING");
}

bool is_wide_string_type(std::string_view type) {
  return begins_with(type, "WSTRING");
}

std::string element_type(const std::string& type) {
  const std::size_t open = type.find('[');
  if (!begins_with(type, "ARRAY") || open == std::string::npos) return {};
  Walk walk(std::string_view(type).substr(open));
  while (!walk.at_end() && (walk.place() == 0 || !walk.outside())) walk.next();
  const std::string rest = trimmed(type.substr(open + walk.place()));
  return begins_with(rest, "OF") ? trimmed(rest.substr(2)) : std::string();
}

bool is_structure(const std::string& type) {
  return begins_with(type, "STRUCT");
}

std::vector<StructureMember> members_of(const std::string& structure) {
  std::vector<StructureMember> members;
  if (!is_structure(structure)) return members;
  std::string_view inside = std::string_view(structure).substr(6);
  inside = inside.substr(0, upper(inside).rfind("END_STRUCT"));
  for (const std::string& line : split_outside(inside, ';')) {
    const std::size_t colon = std::min(find_outside(line, ":"), line.size());
    StructureMember& member = members.emplace_back();
    member.name = trimmed(line.substr(0, colon));
    const std::size_t at = upper(member.name).find(" AT ");
    if (at != std::string::npos) {
      member.address = trimmed(member.name.substr(at + 4));
      member.name = trimmed(member.name.substr(0, at));
    }
    const std::string rest = colon < line.size() ? line.substr(colon + 1) : std::string();
    const std::size_t assign = find_outside(rest, ":=");
    member.type = trimmed(rest.substr(0, assign));
    if (assign != std::string::npos) member.initial = trimmed(rest.substr(assign + 2));
  }
  return members;
}

std::string structure_text(const std::vector<StructureMember>& members) {
  std::string text = "STRUCT ";
  for (const StructureMember& each : members) {
    text += each.name;
    if (!each.address.empty()) text += " AT " + each.address;
    text += " : " + each.type;
    if (!each.initial.empty()) text += " := " + each.initial;
    text += "; ";
  }
  return text + "END_STRUCT";
}

std::pair<std::string, std::string> repetition_of(const std::string& value) {
  const std::size_t open = value.find('(');
  const bool counted = open != std::string::npos && open > 0 && value.back() == ')' &&
                       value.find_first_not_of("0123456789_") == open;
  if (!counted) return {"1", value};
  return {value.substr(0, open), value.substr(open + 1, value.size() - open - 2)};
}

std::string with_quotes(const std::string& value, const std::string& type, const TypeBehind& behind) {
  return Quoting(behind).value(value, type, 0);
}

std::string with_quotes_inside(const std::string& type, const TypeBehind& behind) {
  return Quoting(behind).type(type, 0);
}

std::string string_literal(const std::string& content, bool wide) {
  const char quote = wide ? '"' : '\'';
  std::string text(1, quote);
  for (std::size_t i = 0; i < content.size(); ++i) {
    const std::string_view rest = std::string_view(content).substr(i);
    const std::size_t escape = escape_length(rest);
    if (escape == 0 && (rest[0] == '$' || rest[0] == quote)) text += '$';
    text += rest.substr(0, std::max<std::size_t>(escape, 1));
    i += std::max<std::size_t>(escape, 1) - 1;
  }
  return text + quote;
}

}  // namespace stepwright::graphic
