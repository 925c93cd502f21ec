#include "ladder/lowering/st_names.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace stepwright::lowering {
namespace {

bool starts_word(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
}

bool in_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

// Walks over a text from lexeme to lexeme. Every lexeme is reported as (begin, end, is it an identifier).
class Walker {
 public:
  explicit Walker(std::string_view text) : text_(text) {}

  bool next() {
    begin_ = end_;
    if (begin_ >= text_.size()) return false;
    const char c = text_[begin_];
    identifier_ = false;
    if (text_.substr(begin_, 2) == "//") {
      end_ = std::min(text_.find('\n', begin_), text_.size());
    } else if (text_.substr(begin_, 2) == "(*") {
      const std::size_t close = text_.find("*)", begin_ + 2);
      end_ = close == std::string_view::npos ? text_.size() : close + 2;
    } else if (c == '\'' || c == '"') {
      end_string(c);
    } else if (c == '%') {
      end_while([](char d) { return in_word(d) || d == '.' || d == '*'; });
    } else if (std::isdigit(static_cast<unsigned char>(c)) != 0) {
      // A number, also one with a base or an exponent: 16#FF, 1.5E3.
      end_while([](char d) { return in_word(d) || d == '.' || d == '#'; });
    } else if (starts_word(c)) {
      end_while(in_word);
      identifier_ = true;
      if (end_ < text_.size() && text_[end_] == '#') end_literal();
    } else {
      end_ = begin_ + 1;
    }
    return true;
  }

  std::string_view lexeme() const { return text_.substr(begin_, end_ - begin_); }
  bool is_identifier() const { return identifier_; }
  bool is_space() const { return std::isspace(static_cast<unsigned char>(text_[begin_])) != 0; }
  // Space or comment.
  bool is_blank() const {
    return is_space() || text_.substr(begin_, 2) == "(*" || text_.substr(begin_, 2) == "//";
  }

 private:
  template <typename Belongs>
  void end_while(Belongs belongs) {
    end_ = begin_ + 1;
    while (end_ < text_.size() && belongs(text_[end_])) ++end_;
  }

  // T#1h2m, INT#-5, TOD#12:30:00, DT#2020-01-01-00:00:00: no identifier of the program.
  void end_literal() {
    identifier_ = false;
    ++end_;
    if (end_ < text_.size() && (text_[end_] == '-' || text_[end_] == '+')) ++end_;
    while (end_ < text_.size() && (in_word(text_[end_]) || text_[end_] == '.' || text_[end_] == ':')) ++end_;
  }

  void end_string(char quote) {
    end_ = begin_ + 1;
    while (end_ < text_.size() && text_[end_] != quote) end_ += text_[end_] == '$' ? 2 : 1;
    end_ = std::min(end_ + 1, text_.size());
  }

  std::string_view text_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  bool identifier_ = false;
};

// 'X' for "X" and "x"; 0 for what is no flag of a step or an action.
char flag_letter(std::string_view word) {
  if (word.size() != 1) return 0;
  const char letter = static_cast<char>(std::toupper(static_cast<unsigned char>(word[0])));
  return letter == 'X' || letter == 'T' || letter == 'Q' || letter == 'A' ? letter : '\0';
}

}  // namespace

void for_each_identifier(std::string_view text, const std::function<void(std::string_view)>& visit) {
  for (Walker walker(text); walker.next();) {
    if (walker.is_identifier()) visit(walker.lexeme());
  }
}

std::string replace_flags(std::string_view text,
                          const std::function<std::string(std::string_view, char)>& flag) {
  std::string result;
  std::string_view name;        // an identifier that may be the owner of a flag
  std::size_t name_begin = 0;   // where it starts in `result`
  bool dot_after_name = false;  // `name` and a dot have just been copied
  bool after_dot = false;
  for (Walker walker(text); walker.next();) {
    const std::string_view lexeme = walker.lexeme();
    if (dot_after_name && walker.is_identifier()) {
      const char letter = flag_letter(lexeme);
      const std::string replacement = letter == 0 ? "" : flag(name, letter);
      if (!replacement.empty()) {
        result.resize(name_begin);
        result += replacement;
        name = {};
        dot_after_name = after_dot = false;
        continue;
      }
    }
    if (walker.is_identifier() && !after_dot) {
      name = lexeme;
      name_begin = result.size();
      dot_after_name = false;
    } else if (lexeme == ".") {
      dot_after_name = !name.empty();
    } else if (!walker.is_space()) {
      name = {};
      dot_after_name = false;
    }
    if (!walker.is_space()) after_dot = lexeme == ".";
    result += lexeme;
  }
  return result;
}

void for_each_written_flag(std::string_view text, const std::function<void(std::string_view, char)>& visit) {
  std::vector<std::string_view> lexemes;
  for (Walker walker(text); walker.next();) {
    if (!walker.is_blank()) lexemes.push_back(walker.lexeme());
  }
  const auto at = [&](std::size_t i) { return i < lexemes.size() ? lexemes[i] : std::string_view(); };
  for (std::size_t i = 0; i + 2 < lexemes.size(); ++i) {
    if (at(i + 1) != "." || flag_letter(at(i + 2)) == 0) continue;
    const bool assigned = at(i + 3) == ":" && at(i + 4) == "=";
    const bool output = i >= 2 && at(i - 2) == "=" && at(i - 1) == ">";
    if ((assigned || output) && (i == 0 || at(i - 1) != ".")) visit(at(i), flag_letter(at(i + 2)));
  }
}

}  // namespace stepwright::lowering
