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
  Lexer(std::string_view text, const std::string& file) : _text(text), _file(file) {}

  result::Result<std::vector<Token>> run() {
    while (_at < _text.size()) {
      const char c = _text[_at];
      if (c == ' ' || c == '\t' || c == '\r' || c == '\n') {
        step();
      } else if (c == '#') {
        while (_at < _text.size() && _text[_at] != '\n') step();
      } else if (begins_word(c)) {
        word();
      } else if (c == '"') {
        const Place begin = _place;
        if (!quoted()) {
          return result::fail("L0003", {_file, begin.line, begin.column}, "this quote does not end",
                              "close the name with \" in the same line");
        }
      } else if (!sign()) {
        return result::fail("L0001", {_file, _place.line, _place.column}, shown(c) + " has no meaning here",
                            "names with other characters than letters, digits, _ and . stand in quotes");
      }
    }
    add(TokenKind::End, "", _place);
    return std::move(_tokens);
  }

 private:
  void step() {
    if (_text[_at++] == '\n') {
      ++_place.line;
      _place.column = 1;
    } else {
      ++_place.column;
    }
  }

  void add(TokenKind kind, std::string text, Place at) { _tokens.push_back({kind, std::move(text), at}); }

  void word() {
    const Place begin = _place;
    const std::size_t from = _at;
    while (_at < _text.size() && in_word(_text[_at])) step();
    const std::string_view word = _text.substr(from, _at - from);
    if (is_unary_run(word)) {  // GF a
      for (std::uint32_t k = 0; k < word.size(); ++k)
        add(TokenKind::Sign, std::string(1, word[k]), {begin.line, begin.column + k});
    } else {
      const bool is_sign = is_binary_letter(word) || word == "0" || word == "1";
      add(is_sign ? TokenKind::Sign : TokenKind::Word, std::string(word), begin);
    }
  }

  bool quoted() {
    const Place begin = _place;
    std::string name;
    step();
    while (_at < _text.size() && _text[_at] != '"' && _text[_at] != '\n') {
      if (_text[_at] == '\\' && _at + 1 < _text.size() && _text[_at + 1] != '\n') step();
      name += _text[_at];
      step();
    }
    if (_at == _text.size() || _text[_at] != '"') return false;
    step();
    add(TokenKind::Quoted, std::move(name), begin);
    return true;
  }

  bool sign() {
    for (const Spelling& each : kSigns) {
      if (_text.substr(_at, each.written.size()) != each.written) continue;
      add(TokenKind::Sign, std::string(each.meant), _place);
      for (std::size_t k = 0; k < each.written.size(); ++k) step();
      return true;
    }
    return false;
  }

  std::string_view _text;
  const std::string& _file;
  std::size_t _at = 0;
  Place _place;
  std::vector<Token> _tokens;
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
