#include "supervisor/ltl/hoa/scanner.h"

#include <array>
#include <charconv>
#include <utility>

namespace stepwright::ltl {

namespace {

constexpr std::array<std::pair<std::string_view, HoaTokenKind>, 3> kMarks = {
    {{"--BODY--", HoaTokenKind::Body}, {"--END--", HoaTokenKind::End}, {"--ABORT--", HoaTokenKind::Abort}}};

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

}  // namespace

HoaScanner::HoaScanner(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {
  scan();
}

HoaToken HoaScanner::take() {
  HoaToken token = std::move(token_);
  scan();
  return token;
}

bool HoaScanner::sees(char sign) const {
  return token_.kind == HoaTokenKind::Sign && token_.text[0] == sign;
}

bool HoaScanner::accept(char sign) {
  if (!sees(sign)) return false;
  scan();
  return true;
}

void HoaScanner::fail(const char* code, const HoaToken& at, std::string message, std::string hint) {
  if (!error_)
    error_ = result::fail(code, {file_, at.line, at.column}, std::move(message), std::move(hint)).value();
  at_ = text_.size();
  token_ = {HoaTokenKind::Nothing, "", 0, at.line, at.column};
}

void HoaScanner::fail_here(const std::string& wanted) {
  const HoaToken at = token_;
  const std::string seen = at.kind == HoaTokenKind::Nothing ? "the end of the text" : "'" + at.text + "'";
  fail("L0021", at, "here should stand " + wanted + ", not " + seen, "the format is HOA version 1");
}

void HoaScanner::step() {
  if (text_[at_++] == '\n') {
    ++line_;
    column_ = 1;
  } else {
    ++column_;
  }
}

void HoaScanner::skip_blanks() {
  int comments = 0;  // they may stand in each other
  while (at_ < text_.size()) {
    const std::string_view two = text_.substr(at_, 2);
    const char c = text_[at_];
    if (two == "/*" || (comments > 0 && two == "*/")) {
      comments += two == "/*" ? 1 : -1;
      step();
    } else if (comments == 0 && c != ' ' && c != '\t' && c != '\n' && c != '\r') {
      return;
    }
    step();
  }
}

void HoaScanner::scan() {
  if (error_) return;
  skip_blanks();
  token_ = {HoaTokenKind::Nothing, "", 0, line_, column_};
  if (at_ == text_.size()) return;
  const char c = text_[at_];
  for (const auto& [word, kind] : kMarks) {
    if (text_.substr(at_, word.size()) != word) continue;
    token_.kind = kind;
    token_.text = word;
    for (std::size_t k = 0; k < word.size(); ++k) step();
    return;
  }
  if (c == '"') return scan_text();
  if (is_letter(c) || is_digit(c) || c == '@') return scan_word();
  if (std::string_view("()[]{}&|!").find(c) == std::string_view::npos) {
    fail("L0021", token_, "this character has no meaning here", "the format is HOA version 1");
    return;
  }
  token_.kind = HoaTokenKind::Sign;
  token_.text = c;
  step();
}

void HoaScanner::scan_text() {
  token_.kind = HoaTokenKind::Text;
  step();
  while (at_ < text_.size() && text_[at_] != '"') {
    if (text_[at_] == '\\' && at_ + 1 < text_.size()) step();
    token_.text += text_[at_];
    step();
  }
  if (at_ == text_.size()) {
    fail("L0021", HoaToken(token_), "this text does not end", "close it with \"");
    return;
  }
  step();
}

void HoaScanner::scan_word() {
  const bool alias = text_[at_] == '@', number = is_digit(text_[at_]);
  if (alias) step();
  const std::size_t from = at_;
  while (at_ < text_.size() &&
         (is_digit(text_[at_]) ||
          (!number && (is_letter(text_[at_]) || text_[at_] == '-' || (alias && text_[at_] == '.')))))
    step();
  token_.text = text_.substr(from, at_ - from);
  if (number) {
    token_.kind = HoaTokenKind::Number;
    const auto [end, error] =
        std::from_chars(token_.text.data(), token_.text.data() + token_.text.size(), token_.number);
    if (error != std::errc() || token_.number > 0x7FFFFFFF)
      fail("L0021", HoaToken(token_), "this number is too large", "numbers are at most 2147483647");
  } else if (!alias && at_ < text_.size() && text_[at_] == ':') {
    token_.kind = HoaTokenKind::Header;
    step();
  } else {
    token_.kind = alias ? HoaTokenKind::Alias : HoaTokenKind::Word;
  }
}

}  // namespace stepwright::ltl
