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

HoaScanner::HoaScanner(std::string_view text, std::string file) : _text(text), _file(std::move(file)) {
  scan();
}

HoaToken HoaScanner::take() {
  HoaToken token = std::move(_token);
  scan();
  return token;
}

bool HoaScanner::sees(char sign) const {
  return _token.kind == HoaTokenKind::Sign && _token.text[0] == sign;
}

bool HoaScanner::accept(char sign) {
  if (!sees(sign)) return false;
  scan();
  return true;
}

void HoaScanner::fail(const char* code, const HoaToken& at, std::string message, std::string hint) {
  if (!_error)
    _error = result::fail(code, {_file, at.line, at.column}, std::move(message), std::move(hint)).value();
  _at = _text.size();
  _token = {HoaTokenKind::Nothing, "", 0, at.line, at.column};
}

void HoaScanner::fail_here(const std::string& wanted) {
  const HoaToken at = _token;
  const std::string seen = at.kind == HoaTokenKind::Nothing ? "the end of the text" : "'" + at.text + "'";
  fail("L0021", at, "here should stand " + wanted + ", not " + seen, "the format is HOA version 1");
}

void HoaScanner::step() {
  if (_text[_at++] == '\n') {
    ++_line;
    _column = 1;
  } else {
    ++_column;
  }
}

void HoaScanner::skip_blanks() {
  int comments = 0;  // they may stand in each other
  while (_at < _text.size()) {
    const std::string_view two = _text.substr(_at, 2);
    const char c = _text[_at];
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
  if (_error) return;
  skip_blanks();
  _token = {HoaTokenKind::Nothing, "", 0, _line, _column};
  if (_at == _text.size()) return;
  const char c = _text[_at];
  for (const auto& [word, kind] : kMarks) {
    if (_text.substr(_at, word.size()) != word) continue;
    _token.kind = kind;
    _token.text = word;
    for (std::size_t k = 0; k < word.size(); ++k) step();
    return;
  }
  if (c == '"') return scan_text();
  if (is_letter(c) || is_digit(c) || c == '@') return scan_word();
  if (std::string_view("()[]{}&|!").find(c) == std::string_view::npos) {
    fail("L0021", _token, "this character has no meaning here", "the format is HOA version 1");
    return;
  }
  _token.kind = HoaTokenKind::Sign;
  _token.text = c;
  step();
}

void HoaScanner::scan_text() {
  _token.kind = HoaTokenKind::Text;
  step();
  while (_at < _text.size() && _text[_at] != '"') {
    if (_text[_at] == '\\' && _at + 1 < _text.size()) step();
    _token.text += _text[_at];
    step();
  }
  if (_at == _text.size()) {
    fail("L0021", HoaToken(_token), "this text does not end", "close it with \"");
    return;
  }
  step();
}

void HoaScanner::scan_word() {
  const bool alias = _text[_at] == '@', number = is_digit(_text[_at]);
  if (alias) step();
  const std::size_t from = _at;
  while (_at < _text.size() &&
         (is_digit(_text[_at]) ||
          (!number && (is_letter(_text[_at]) || _text[_at] == '-' || (alias && _text[_at] == '.')))))
    step();
  _token.text = _text.substr(from, _at - from);
  if (number) {
    _token.kind = HoaTokenKind::Number;
    const auto [end, error] =
        std::from_chars(_token.text.data(), _token.text.data() + _token.text.size(), _token.number);
    if (error != std::errc() || _token.number > 0x7FFFFFFF)
      fail("L0021", HoaToken(_token), "this number is too large", "numbers are at most 2147483647");
  } else if (!alias && _at < _text.size() && _text[_at] == ':') {
    _token.kind = HoaTokenKind::Header;
    step();
  } else {
    _token.kind = alias ? HoaTokenKind::Alias : HoaTokenKind::Word;
  }
}

}  // namespace stepwright::ltl
