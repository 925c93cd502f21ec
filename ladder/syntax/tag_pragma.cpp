#include "ladder/syntax/tag_pragma.h"

#include <algorithm>
#include <array>

#include "ladder/source/suggestion.h"
#include "ladder/syntax/blank.h"
#include "ladder/syntax/number.h"
#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::syntax {

namespace {

constexpr std::array<std::string_view, 6> kTagKeys = {"unit",     "description", "group",
                                                      "decimals", "range",       "values"};

// In small letters, as the keys are.
std::string folded(std::string_view word) {
  std::string result(word);
  for (char& c : result) c = naming::to_lower(c);
  return result;
}

bool is_key_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

bool is_number_letter(char c) {
  return (c >= '0' && c <= '9') || c == '_';
}

class TagPragmaReader {
 public:
  TagPragmaReader(std::string_view text, TagPragmaMistake& mistake) : text_(text), mistake_(mistake) {}

  // Up to the end, or to a mistake.
  bool read(TagPragma& said) {
    do {
      const std::size_t begin = skip_blanks();
      const std::string key = folded(word());
      if (!is_known(key, begin) || !is_new(key, begin)) return false;
      if (!accept(":="))
        return fail(at_, "':=' and a value stand behind '" + key + "'", "{" + key + " := ...}");
      if (!value(key, said)) return false;
    } while (accept(","));
    if (skip_blanks() == text_.size()) return true;
    return fail(at_, "',' or the end of the pragma stands behind a value",
                text_[at_] == ';' ? "what is said is separated by commas: {unit := 'l', decimals := 1}" : "");
  }

 private:
  std::size_t skip_blanks() {
    for (Blank blank = blank_at(text_, at_); blank.kind == BlankKind::Space; blank = blank_at(text_, at_))
      at_ = blank.end;
    return at_;
  }

  bool fail(std::size_t offset, std::string message, std::string hint = {}) {
    mistake_ = {offset, std::move(message), std::move(hint)};
    return false;
  }

  bool accept(std::string_view symbol) {
    skip_blanks();
    if (text_.substr(at_, symbol.size()) != symbol) return false;
    at_ += symbol.size();
    return true;
  }

  std::string_view word() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_key_letter(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  bool is_known(const std::string& key, std::size_t begin) {
    if (std::ranges::find(kTagKeys, key) != kTagKeys.end()) return true;
    const std::string near = source::did_you_mean(key, kTagKeys);
    return fail(begin,
                key.empty() ? "the name of a value stands here" : "'" + key + "' says nothing of a tag",
                near.empty() ? "unit, description, group, decimals, range or values" : near);
  }

  bool is_new(const std::string& key, std::size_t begin) {
    if (std::ranges::find(seen_, key) != seen_.end()) return fail(begin, "'" + key + "' is said twice");
    seen_.push_back(key);
    return true;
  }

  bool value(const std::string& key, TagPragma& said) {
    if (key == "unit") return text(said.unit);
    if (key == "description") return text(said.description);
    if (key == "group") return text(said.group);
    if (key == "decimals") return decimals(said);
    return key == "range" ? range(said) : values(said);
  }

  bool text(std::string& out) {
    const std::size_t begin = skip_blanks();
    if (!accept("'")) return fail(begin, "a text in single quotes stands here", "unit := 'l'");
    std::string read;
    for (; at_ < text_.size() && text_[at_] != '\''; ++at_) {
      if (text_[at_] == '$' && !escape()) return false;
      read += text_[at_];
    }
    if (!accept("'"))
      return fail(begin, "the text has no end in the pragma", "close it with '; no text of a pragma has a }");
    if (read.size() > kMostTagText)
      return fail(begin, "a text about a tag has at most " + std::to_string(kMostTagText) + " bytes");
    out = std::move(read);
    return true;
  }

  // Moves to the character that is meant.
  bool escape() {
    const std::size_t begin = at_++;
    if (at_ < text_.size() && (text_[at_] == '\'' || text_[at_] == '$')) return true;
    return fail(begin, "'$' stands before a quote or a '$' here", "'$'' is a quote, '$$' a dollar");
  }

  bool decimals(TagPragma& said) {
    const std::size_t begin = skip_blanks();
    double number = 0;
    if (!this->number(number)) return false;
    const int whole = number >= 0 && number <= kMostDecimals ? static_cast<int>(number) : -1;
    if (whole < 0 || static_cast<double>(whole) != number)
      return fail(begin, "decimals are a whole number from 0 to " + std::to_string(kMostDecimals));
    said.decimals = whole;
    return true;
  }

  bool range(TagPragma& said) {
    const std::size_t begin = skip_blanks();
    double least = 0;
    double greatest = 0;
    if (!number(least)) return false;
    if (!accept("..")) return fail(at_, "'..' stands between the ends of a range", "range := 0..200");
    if (!number(greatest)) return false;
    if (least >= greatest)
      return fail(begin, "this range has nothing in it", "the least and the greatest normal value: 0..200");
    said.range = {least, greatest};
    return true;
  }

  // "-12.5", "1_000", "1.0E-3"; the dots of a range do not belong to it.
  bool number(double& out) {
    const std::size_t begin = skip_blanks();
    const bool negative = accept("-");
    if (!negative) accept("+");
    const std::size_t first = at_;
    digits();
    if (peek() == '.' && is_number_letter(peek(1))) {
      ++at_;
      digits();
    }
    const bool is_signed = peek(1) == '-' || peek(1) == '+';
    if ((peek() == 'e' || peek() == 'E') && is_number_letter(peek(is_signed ? 2 : 1))) {
      at_ += is_signed ? 2 : 1;
      digits();
    }
    const auto read = parse_real(text_.substr(first, at_ - first));
    if (!read) return fail(begin, "a number stands here", "range := -20..150.5");
    out = negative ? -*read : *read;
    return true;
  }

  char peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }

  void digits() {
    while (is_number_letter(peek())) ++at_;
  }

  bool values(TagPragma& said) {
    const std::size_t begin = skip_blanks();
    if (!accept("[")) return fail(begin, "names of values stand in a list", "values := ['closed', 'open']");
    std::vector<std::string> names;
    do {
      if (!text(names.emplace_back())) return false;
    } while (accept(","));
    if (!accept("]")) return fail(at_, "',' or ']' stands behind a name of a value");
    if (names.size() > kMostTagValues)
      return fail(begin, "at most " + std::to_string(kMostTagValues) + " values have names");
    said.values = std::move(names);
    return true;
  }

  std::string_view text_;
  TagPragmaMistake& mistake_;
  std::size_t at_ = 0;
  std::vector<std::string> seen_;
};

}  // namespace

bool TagPragma::empty() const {
  return unit.empty() && description.empty() && group.empty() && !decimals && !range && values.empty();
}

std::span<const std::string_view> tag_pragma_keys() {
  return kTagKeys;
}

std::string_view first_key(std::string_view inside) {
  std::size_t at = 0;
  const auto skip_space = [&] {
    for (Blank blank = blank_at(inside, at); blank.kind == BlankKind::Space; blank = blank_at(inside, at))
      at = blank.end;
  };
  skip_space();
  const std::size_t begin = at;
  while (at < inside.size() && is_key_letter(inside[at])) ++at;
  const std::string_view word = inside.substr(begin, at - begin);
  skip_space();
  // A mere '=' is a slip that is told.
  return inside.substr(at, 2) == ":=" || inside.substr(at, 1) == "=" ? word : std::string_view();
}

bool is_tag_pragma(std::string_view inside) {
  const std::string_view key = first_key(inside);
  return std::ranges::any_of(kTagKeys, [&](std::string_view each) { return naming::same_name(each, key); });
}

bool read_tag_pragma(std::string_view inside, TagPragma& said, TagPragmaMistake& mistake) {
  TagPragma read = said;
  if (!TagPragmaReader(inside, mistake).read(read)) return false;
  said = std::move(read);
  return true;
}

}  // namespace stepwright::syntax
