#include "supervisor/lisp/lexer.h"

#include <cctype>
#include <charconv>

#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::lisp {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
bool is_word(char c) {
  return is_letter(c) || is_digit(c) || c == '_' || c == '-' || c == '@' || c == '#' || c == '.';
}

class Lexer {
 public:
  Lexer(std::string_view text, std::uint32_t file, std::uint32_t first_line, Reporter& reporter)
      : text_(text), at_{first_line, 1, file}, reporter_(reporter) {}

  std::vector<Token> run() {
    while (skip_blank()) next();
    tokens_.push_back({TokenKind::End, "", at_});
    return std::move(tokens_);
  }

 private:
  char peek(std::size_t ahead = 0) const {
    return position_ + ahead < text_.size() ? text_[position_ + ahead] : '\0';
  }

  char advance() {
    const char c = text_[position_++];
    if (c == '\n') {
      ++at_.line;
      at_.column = 1;
    } else {
      ++at_.column;
    }
    return c;
  }

  // False at the end of the text.
  bool skip_blank() {
    while (position_ < text_.size()) {
      if (peek() == ';') {
        while (position_ < text_.size() && peek() != '\n') advance();
      } else if (std::isspace(static_cast<unsigned char>(peek())) != 0) {
        advance();
      } else {
        return true;
      }
    }
    return false;
  }

  std::string word() {
    std::string text;
    while (position_ < text_.size() && is_word(peek())) text += naming::to_lower(advance());
    return text;
  }

  void push(TokenKind kind, std::string text, Place at, double number = 0.0) {
    tokens_.push_back({kind, std::move(text), at, number});
  }

  void next() {
    const Place at = at_;
    const char c = peek();
    if (c == '(' || c == ')') {
      advance();
      push(c == '(' ? TokenKind::Open : TokenKind::Close, std::string(1, c), at);
    } else if (is_letter(c) || c == '_') {
      push(TokenKind::Name, word(), at);
    } else if (is_digit(c) || (c == '.' && is_digit(peek(1))) || (c == '-' && is_digit(peek(1)))) {
      number(at);
    } else if ((c == '?' || c == ':') && (is_letter(peek(1)) || peek(1) == '_')) {
      const std::string prefix(1, advance());
      push(c == '?' ? TokenKind::Variable : TokenKind::Keyword, prefix + word(), at);
    } else {
      symbol(at);
    }
  }

  void number(Place at) {
    std::string text(1, advance());
    while (position_ < text_.size() &&
           (is_word(peek()) || (peek() == '+' && (text.back() == 'e' || text.back() == 'E')))) {
      text += advance();
    }
    double value = 0.0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (status == std::errc::result_out_of_range && end == text.data() + text.size()) {
      reporter_.error("P0009", at, "'" + text + "' is out of the range of numbers",
                      "numbers are doubles: up to 1.8e308, not smaller than 2.2e-308");
    } else if (status != std::errc() || end != text.data() + text.size()) {
      reporter_.error("P0005", at, "'" + text + "' is not a number",
                      "a number is written 12, -3 or 0.25; a name starts with a letter");
    }
    push(TokenKind::Number, text, at, value);
  }

  void symbol(Place at) {
    const char c = advance();
    std::string text(1, c);
    if ((c == '<' || c == '>') && peek() == '=') text += advance();
    if (std::string_view("+-*/=<>").find(c) != std::string_view::npos) {
      push(TokenKind::Operator, text, at);
      return;
    }
    const auto code = static_cast<unsigned char>(c);
    if (std::iscntrl(code) != 0) {
      reporter_.error("P0002", at, "byte " + std::to_string(code) + " cannot stand in a text",
                      "is this the right file? It is read no further");
      position_ = text_.size();
      return;
    }
    const std::string name =
        std::isprint(code) != 0 ? "character '" + text + "'" : "byte " + std::to_string(code);
    reporter_.error("P0002", at, "unexpected " + name);
  }

  std::string_view text_;
  std::size_t position_ = 0;
  Place at_;
  Reporter& reporter_;
  std::vector<Token> tokens_;
};

}  // namespace

std::vector<Token> tokens_of(std::string_view text, std::uint32_t file, Reporter& reporter,
                             std::uint32_t first_line) {
  return Lexer(text, file, first_line, reporter).run();
}

std::string quoted(const Token& token) {
  return token.kind == TokenKind::End ? "the end of the file" : "'" + token.text + "'";
}

}  // namespace stepwright::lisp
