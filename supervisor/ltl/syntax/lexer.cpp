#include "supervisor/ltl/syntax/lexer.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace stepwright::ltl {

namespace {

constexpr std::array kReserved = {
    "true",   "false", "xor",     "and",      "or",         "not",    "implies", "iff",      "then",
    "visit",  "avoid", "never",   "always",   "eventually", "next",   "until",   "unless",   "release",
    "before", "after", "between", "globally", "absent",     "exists", "holds",   "precedes", "responds"};

struct Spelling {
  std::string_view written, meant;
};
constexpr std::array<Spelling, 17> kSigns = {{{"<->", "<->"},
                                              {"<=>", "<->"},
                                              {"-->", "->"},
                                              {"->", "->"},
                                              {"=>", "->"},
                                              {"&&", "&"},
                                              {"||", "|"},
                                              {"&", "&"},
                                              {"|", "|"},
                                              {"!", "!"},
                                              {"~", "!"},
                                              {"^", "xor"},
                                              {"(", "("},
                                              {")", ")"},
                                              {",", ","},
                                              {":", ":"},
                                              {";", ","}}};

bool begins_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || (c >= '0' && c <= '9');
}
bool in_word(char c) {
  return begins_word(c) || c == '.';
}

bool is_unary_run(std::string_view word) {
  return word.find_first_not_of("FGX") == std::string_view::npos;
}
bool is_binary_letter(std::string_view word) {
  return word == "U" || word == "R" || word == "W" || word == "M";
}

std::string shown(char c) {
  const auto byte = static_cast<unsigned char>(c);
  if (byte >= 0x20 && byte < 0x7F) return std::string("'") + c + "'";
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "byte 0x%02X", byte);
  return text.data();
}

class Lexer {
 public:
  Lexer(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  result::Result<std::vector<Token>> run() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == ' ' || c == '\t' || c == '\r' || c == '\n') {
        step();
      } else if (c == '#') {
        while (at_ < text_.size() && text_[at_] != '\n') step();
      } else if (begins_word(c)) {
        word();
      } else if (c == '"') {
        const Place begin = place_;
        if (!quoted()) {
          return result::fail("L0003", {file_, begin.line, begin.column}, "this quote does not end",
                              "close the name with \" in the same line");
        }
      } else if (!sign()) {
        return result::fail("L0001", {file_, place_.line, place_.column}, shown(c) + " has no meaning here",
                            "names with other characters than letters, digits, _ and . stand in quotes");
      }
    }
    add(TokenKind::End, "", place_);
    return std::move(tokens_);
  }

 private:
  void step() {
    if (text_[at_++] == '\n') {
      ++place_.line;
      place_.column = 1;
    } else {
      ++place_.column;
    }
  }

  void add(TokenKind kind, std::string text, Place at) { tokens_.push_back({kind, std::move(text), at}); }

  void word() {
    const Place begin = place_;
    const std::size_t from = at_;
    if (begins_duration()) {
      step();
      step();
      while (at_ < text_.size() && in_word(text_[at_])) step();
      return add(TokenKind::Duration, std::string(text_.substr(from, at_ - from)), begin);
    }
    while (at_ < text_.size() && in_word(text_[at_])) step();
    const std::string_view word = text_.substr(from, at_ - from);
    if (is_unary_run(word)) {  // GF a
      for (std::uint32_t k = 0; k < word.size(); ++k)
        add(TokenKind::Sign, std::string(1, word[k]), {begin.line, begin.column + k});
    } else {
      const bool is_sign = is_binary_letter(word) || word == "0" || word == "1";
      add(is_sign ? TokenKind::Sign : TokenKind::Word, std::string(word), begin);
    }
  }

  // T#5s: a '#' that is no comment.
  bool begins_duration() const {
    return at_ + 2 < text_.size() && (text_[at_] == 'T' || text_[at_] == 't') && text_[at_ + 1] == '#' &&
           text_[at_ + 2] >= '0' && text_[at_ + 2] <= '9';
  }

  bool quoted() {
    const Place begin = place_;
    std::string name;
    step();
    while (at_ < text_.size() && text_[at_] != '"' && text_[at_] != '\n') {
      if (text_[at_] == '\\' && at_ + 1 < text_.size() && text_[at_ + 1] != '\n') step();
      name += text_[at_];
      step();
    }
    if (at_ == text_.size() || text_[at_] != '"') return false;
    step();
    add(TokenKind::Quoted, std::move(name), begin);
    return true;
  }

  bool sign() {
    for (const Spelling& each : kSigns) {
      if (text_.substr(at_, each.written.size()) != each.written) continue;
      add(TokenKind::Sign, std::string(each.meant), place_);
      for (std::size_t k = 0; k < each.written.size(); ++k) step();
      return true;
    }
    return false;
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0;
  Place place_;
  std::vector<Token> tokens_;
};

}  // namespace

result::Result<std::vector<Token>> tokenize(std::string_view text, const std::string& file) {
  return Lexer(text, file).run();
}

bool is_reserved(std::string_view word) {
  return std::ranges::any_of(kReserved, [&](const char* each) { return word == each; });
}

bool is_plain_name(std::string_view name) {
  return !name.empty() && begins_word(name.front()) && std::ranges::all_of(name, in_word) &&
         !is_unary_run(name) && !is_binary_letter(name) && name != "0" && name != "1" && !is_reserved(name);
}

}  // namespace stepwright::ltl
