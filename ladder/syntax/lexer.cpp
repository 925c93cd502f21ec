#include "ladder/syntax/lexer.h"

#include <optional>
#include <string>

#include "ladder/source/suggestion.h"
#include "ladder/syntax/blank.h"
#include "ladder/syntax/date_literal.h"
#include "ladder/syntax/number.h"
#include "ladder/syntax/soft_words.h"
#include "ladder/syntax/tag_pragma.h"

namespace stepwright::syntax {

namespace {

namespace code = source::code;
using source::Position;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool starts_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

bool continues_name(char c) {
  return starts_name(c) || is_digit(c);
}

// For a message: what is longer than a line is cut.
std::string shown(std::string_view text) {
  constexpr std::size_t kMost = 60;
  return "'" + std::string(text.substr(0, kMost)) + (text.size() > kMost ? "...'" : "'");
}

// Literals whose value is a time: what stands before '#', how the value is read, what a wrong one is told.
struct TimeLiteral {
  std::string_view prefix;
  TokenKind kind;
  std::optional<std::int64_t> (*parse)(std::string_view);
};
constexpr TimeLiteral kTimeLiterals[] = {
    {"T", TokenKind::Time, parse_duration},
    {"TIME", TokenKind::Time, parse_duration},
    {"LT", TokenKind::Time, parse_duration},
    {"LTIME", TokenKind::Time, parse_duration},
    {"D", TokenKind::Date, parse_date},
    {"DATE", TokenKind::Date, parse_date},
    {"LD", TokenKind::Date, parse_date},
    {"LDATE", TokenKind::Date, parse_date},
    {"TOD", TokenKind::TimeOfDay, parse_time_of_day},
    {"TIME_OF_DAY", TokenKind::TimeOfDay, parse_time_of_day},
    {"LTOD", TokenKind::TimeOfDay, parse_time_of_day},
    {"LTIME_OF_DAY", TokenKind::TimeOfDay, parse_time_of_day},
    {"DT", TokenKind::DateAndTime, parse_date_and_time},
    {"DATE_AND_TIME", TokenKind::DateAndTime, parse_date_and_time},
    {"LDT", TokenKind::DateAndTime, parse_date_and_time},
    {"LDATE_AND_TIME", TokenKind::DateAndTime, parse_date_and_time},
};

const char* hint_of(TokenKind kind) {
  switch (kind) {
    case TokenKind::Date:
      return "write it as D#2026-11-21, from 1678 to 2261";
    case TokenKind::TimeOfDay:
      return "write it as TOD#15:36:55.36";
    case TokenKind::DateAndTime:
      return "write it as DT#2026-11-21-15:36:55.36";
    default:
      return "write it as T#1d2h3m4s5ms, units descending, a fraction only in the last one";
  }
}

// Operators that other languages write so, and what stands for them here.
struct ForeignOperator {
  std::string_view text;
  TokenKind kind;
  Keyword keyword;
  const char* hint;
};
constexpr ForeignOperator kForeignOperators[] = {
    {"==", TokenKind::Equal, Keyword::None, "equal is written '='"},
    {"!=", TokenKind::NotEqual, Keyword::None, "not equal is written '<>'"},
    {"&&", TokenKind::Keyword, Keyword::And, "write AND"},
    {"||", TokenKind::Keyword, Keyword::Or, "write OR"},
    {"!", TokenKind::Keyword, Keyword::Not, "write NOT"},
    {"%", TokenKind::Keyword, Keyword::Mod, "the remainder of a division is written MOD"},
    {"+=", TokenKind::Assign, Keyword::None, "write x := x + ..."},
    {"-=", TokenKind::Assign, Keyword::None, "write x := x - ..."},
    {"*=", TokenKind::Assign, Keyword::None, "write x := x * ..."},
    {"/=", TokenKind::Assign, Keyword::None, "write x := x / ..., or '<>' for not equal"},
};

// Statements of C end with a semicolon, or are a single call of what reads or writes a variable of the block.
bool is_foreign_code(std::string_view pragma) {
  return pragma.find(';') != std::string_view::npos || pragma.find("FbVar(") != std::string_view::npos;
}

class Lexer {
 public:
  // `text` is that of `file`, or stands in no file.
  Lexer(const source::SourceSet& sources, source::FileId file, std::string_view text, TextKind kind,
        source::NameTable& names, source::DiagnosticSink& sink, Extent extent)
      : sources_(sources),
        file_(file),
        text_(text.substr(0, extent.end)),
        kind_(kind),
        names_(names),
        sink_(sink),
        at_(extent.begin),
        mapped_file_(file) {}

  std::vector<Token> run() {
    tokens_.reserve((text_.size() - at_) / 4 + 1);
    while (true) {
      skip_blank();
      start_ = at_;
      if (at_ >= text_.size()) break;
      next();
    }
    push(TokenKind::End);
    soften(tokens_);
    return std::move(tokens_);
  }

 private:
  char peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
  bool at_text(std::string_view what) const { return text_.substr(at_, what.size()) == what; }

  Position place(std::size_t offset) const {
    if (map_fixed_) return {mapped_file_, static_cast<std::uint32_t>(map_to_)};
    return {mapped_file_, static_cast<std::uint32_t>(offset - map_from_ + map_to_)};
  }

  Token& push(TokenKind kind) {
    Token token;
    token.kind = kind;
    token.where = place(start_);
    token.text = text_.substr(start_, at_ - start_);
    return tokens_.emplace_back(token);
  }

  void bad(const char* what, std::string message, std::string hint = {}) {
    sink_.error(what, place(start_), std::move(message), std::move(hint));
    push(TokenKind::Bad);
  }

  void skip_blank() {
    for (Blank blank = blank_at(text_, at_); blank.kind != BlankKind::None; blank = blank_at(text_, at_)) {
      start_ = at_;
      at_ = blank.end;
      if (!blank.closed) return unterminated(blank);
      if (blank.kind == BlankKind::Pragma) pragma(blank);
    }
  }

  void unterminated(const Blank& blank) {
    const bool comment = blank.kind == BlankKind::Comment;
    sink_.error(code::kUnterminated, place(start_),
                comment ? "the comment has no end" : "the pragma has no end",
                "close it with '" + std::string(blank.close) + "'");
    push(TokenKind::Bad);
  }

  // A pragma that means something to the parser becomes a token, any other one is skipped (6.2). Editors
  // that translate to C put C code into pragmas, in doubled braces where it has braces of its own: that it
  // does not run must be said.
  void pragma(const Blank& blank) {
    const bool doubled = blank.open.size() > 1;
    const std::string_view inside = text_.substr(start_ + 1, at_ - blank.close.size() - start_ - 1);
    if (is_tag_pragma(inside)) return tag_pragma(inside);
    if (declares() && misses_a_tag_key(inside)) return;
    if (doubled || is_foreign_code(inside))
      sink_.warning(code::kForeignCode, place(start_),
                    "this pragma holds code of another language, which is skipped",
                    "write in ST what it does");
    if (kind_ == TextKind::Generated && !inside.empty() && inside.front() == '@')
      map_source(inside.substr(1));
    if (source::upper(text_.substr(start_, at_ - start_)) == to_string(Keyword::FinalScan))
      push(TokenKind::Keyword).keyword = Keyword::FinalScan;
  }

  // What is said of a tag is read where the declaration is printed; that it can be read is checked here.
  void tag_pragma(std::string_view inside) {
    TagPragma said;
    TagPragmaMistake mistake;
    if (!read_tag_pragma(inside, said, mistake)) {
      sink_.error(code::kBadTagPragma, place(start_ + 1 + mistake.offset), mistake.message, mistake.hint);
    } else if (!declares()) {
      sink_.warning(code::kLoneTagPragma, place(start_), "what this pragma says belongs to no variable",
                    "it stands in VAR ... END_VAR, at the declaration; [tags] of the cell describes members");
    }
  }

  // Another pragma in all likelihood, which is nobody's mistake: said, and skipped.
  bool misses_a_tag_key(std::string_view inside) {
    const std::string_view key = first_key(inside);
    const std::string near = key.empty() ? std::string() : source::did_you_mean(key, tag_pragma_keys());
    if (near.empty()) return false;
    sink_.warning(code::kLoneTagPragma, place(start_), "'" + std::string(key) + "' says nothing of a tag",
                  near);
    return true;
  }

  void map_source(std::string_view target) {
    mapped_file_ = file_;
    map_from_ = 0;
    map_to_ = 0;
    map_fixed_ = !target.empty() && target.back() == '!';
    if (map_fixed_) target.remove_suffix(1);
    const std::size_t colon = target.find(':');
    if (colon == std::string_view::npos) return;
    const auto file = parse_integer(target.substr(0, colon), 10);
    const auto offset = parse_integer(target.substr(colon + 1), 10);
    if (!file || !offset || *file >= sources_.size()) {
      map_fixed_ = false;
      return;
    }
    mapped_file_ = source::FileId(static_cast<std::uint32_t>(*file));
    map_from_ = at_;
    map_to_ = static_cast<std::size_t>(*offset);
  }

  void next() {
    const char c = peek();
    if (starts_name(c)) return word();
    if (is_digit(c)) return number();
    if (c == '%' && (starts_name(peek(1)) || is_digit(peek(1)))) return direct();
    if (c == '\'' || c == '"') return string(c);
    symbol();
  }

  void word() {
    while (continues_name(peek())) ++at_;
    const std::string_view text = text_.substr(start_, at_ - start_);
    if (kind_ == TextKind::Written && text.size() > kMaxName)
      return bad(code::kLongName, "a name has at most " + std::to_string(kMaxName) + " characters, " +
                                      shown(text) + " has " + std::to_string(text.size()));
    const source::NameId name = names_.intern(text);
    if (peek() == '#') return prefixed(name);
    // The library's own names begin with two.
    const std::size_t doubled = text.find("__", 1);
    if (kind_ == TextKind::Written && doubled != std::string_view::npos)
      sink_.error(code::kBadCharacter, place(start_ + doubled),
                  "a name has no two underscores in a row: '" + std::string(text) + "'", "leave one out");
    const Keyword keyword = keyword_of(name);
    Token& token = push(keyword == Keyword::None ? TokenKind::Identifier : TokenKind::Keyword);
    token.keyword = keyword;
    token.name = name;
    follow_sections(keyword);
  }

  void follow_sections(Keyword keyword) {
    const bool opens = keyword >= Keyword::Var && keyword <= Keyword::VarGlobal;
    if (opens || keyword == Keyword::EndVar) {
      in_section_ = opens;
      structures_ = 0;
    }
    if (keyword == Keyword::Struct) ++structures_;
    if (keyword == Keyword::EndStruct) --structures_;
  }

  // Declarations of variables stand in VAR ... END_VAR; members of a structure there are no variables.
  bool declares() const { return in_section_ && structures_ == 0; }

  void prefixed(source::NameId name) {
    const std::string& folded = names_.folded(name);
    ++at_;
    for (const TimeLiteral& each : kTimeLiterals)
      if (folded == each.prefix) return time_literal(each);
    Token& token = push(TokenKind::TypePrefix);
    token.text.remove_suffix(1);
    token.name = name;
  }

  void time_literal(const TimeLiteral& form) {
    const std::size_t from = at_;
    const bool is_duration = form.kind == TokenKind::Time;
    if (is_duration && (peek() == '-' || peek() == '+')) ++at_;
    // The marks of dates and times of day belong to the literal only between digits.
    while (continues_name(peek()) ||
           (is_digit(peek(1)) && (peek() == '.' || (!is_duration && (peek() == '-' || peek() == ':')))))
      ++at_;
    const auto value = form.parse(text_.substr(from, at_ - from));
    if (!value) {
      return bad(code::kBadLiteral,
                 shown(text_.substr(start_, at_ - start_)) + " is not " + describe(form.kind),
                 hint_of(form.kind));
    }
    push(form.kind).time_ns = *value;
  }

  void digits() {
    while (is_digit(peek()) || peek() == '_') ++at_;
  }

  void number() {
    digits();
    if (peek() == '#') return based_number();
    const bool has_fraction = peek() == '.' && is_digit(peek(1));
    if (has_fraction) {
      ++at_;
      digits();
    }
    const bool has_exponent =
        (peek() == 'e' || peek() == 'E') &&
        (is_digit(peek(1)) || ((peek(1) == '-' || peek(1) == '+') && is_digit(peek(2))));
    if (has_exponent) {
      at_ += 2;
      digits();
    }
    if (starts_name(peek())) {
      while (continues_name(peek())) ++at_;
      return bad_number();
    }
    const std::string_view text = text_.substr(start_, at_ - start_);
    if (has_fraction || has_exponent) {
      const auto value = parse_real(text);
      if (!value) return bad_number();
      push(TokenKind::Real).real = *value;
      return;
    }
    const auto value = parse_integer(text, 10);
    if (!value) return bad_number();
    push(TokenKind::Integer).integer = *value;
  }

  void based_number() {
    const auto base = parse_integer(text_.substr(start_, at_ - start_), 10);
    ++at_;
    const std::size_t from = at_;
    while (continues_name(peek())) ++at_;
    const bool known = base && (*base == 2 || *base == 8 || *base == 10 || *base == 16);
    const auto value =
        known ? parse_integer(text_.substr(from, at_ - from), static_cast<unsigned>(*base)) : std::nullopt;
    if (!value) return bad_number();
    Token& token = push(TokenKind::Integer);
    token.integer = *value;
    token.based = true;
  }

  void bad_number() {
    const std::string_view text = text_.substr(start_, at_ - start_);
    if (parse_duration(text))
      return bad(code::kBadLiteral, shown(text) + " is no number",
                 "a duration is written T#" + std::string(text));
    bad(code::kBadLiteral, shown(text) + " is no number",
        "bases are 2#, 8#, 10# and 16#; an integer has at most 64 bits, underscores stand between digits");
  }

  void direct() {
    ++at_;
    while (continues_name(peek()) || (peek() == '.' && is_digit(peek(1)))) ++at_;
    // "%I*", "%QW*": a place that VAR_CONFIG gives.
    if (peek() == '*' && at_ - start_ > 1 && !is_digit(text_[at_ - 1])) ++at_;
    push(TokenKind::Direct);
  }

  void string(char quote) {
    ++at_;
    while (at_ < text_.size() && peek() != quote && peek() != '\n') at_ += peek() == '$' ? 2 : 1;
    if (peek() != quote) {
      at_ = std::min(at_, text_.size());
      return bad(code::kUnterminated, "the string has no end on its line",
                 std::string("close it with ") + quote);
    }
    ++at_;
    push(quote == '"' ? TokenKind::WideString : TokenKind::String);
  }

  bool foreign_operator() {
    for (const ForeignOperator& each : kForeignOperators) {
      if (!at_text(each.text)) continue;
      at_ += each.text.size();
      sink_.error(code::kBadCharacter, place(start_), "'" + std::string(each.text) + "' is no operator of ST",
                  each.hint);
      Token& token = push(each.kind);
      token.keyword = each.keyword;
      token.foreign = true;
      return true;
    }
    return false;
  }

  void symbol() {
    if (foreign_operator()) return;
    struct Symbol {
      std::string_view text;
      TokenKind kind;
    };
    static constexpr Symbol kSymbols[] = {
        {":=", TokenKind::Assign},     {"=>", TokenKind::Output},      {"?=", TokenKind::AttemptAssign},
        {"..", TokenKind::Range},      {"^", TokenKind::Caret},        {"**", TokenKind::Power},
        {"<>", TokenKind::NotEqual},   {"<=", TokenKind::LessEqual},   {">=", TokenKind::GreaterEqual},
        {":", TokenKind::Colon},       {";", TokenKind::Semicolon},    {",", TokenKind::Comma},
        {".", TokenKind::Dot},         {"(", TokenKind::LeftParen},    {")", TokenKind::RightParen},
        {"[", TokenKind::LeftBracket}, {"]", TokenKind::RightBracket}, {"+", TokenKind::Plus},
        {"-", TokenKind::Minus},       {"*", TokenKind::Star},         {"/", TokenKind::Slash},
        {"&", TokenKind::Ampersand},   {"=", TokenKind::Equal},        {"<", TokenKind::Less},
        {">", TokenKind::Greater},
    };
    for (const Symbol& each : kSymbols) {
      if (!at_text(each.text)) continue;
      at_ += each.text.size();
      push(each.kind);
      return;
    }
    ++at_;
    while ((static_cast<unsigned char>(peek()) & 0xC0u) == 0x80u) ++at_;
    const std::string shown(text_.substr(start_, at_ - start_));
    const bool printable = static_cast<unsigned char>(shown[0]) >= 0x20;
    bad(code::kBadCharacter, printable ? "'" + shown + "' does not belong to ST" : "a control character");
  }

  const source::SourceSet& sources_;
  source::FileId file_;
  std::string_view text_;
  TextKind kind_;
  source::NameTable& names_;
  source::DiagnosticSink& sink_;
  std::vector<Token> tokens_;
  std::size_t at_ = 0;
  std::size_t start_ = 0;
  source::FileId mapped_file_;
  std::size_t map_from_ = 0;
  std::size_t map_to_ = 0;
  bool map_fixed_ = false;
  bool in_section_ = false;  // of variables
  int structures_ = 0;       // STRUCTs around
};

}  // namespace

std::vector<Token> lex(const source::SourceSet& sources, source::FileId file, TextKind kind,
                       source::NameTable& names, source::DiagnosticSink& sink, Extent extent) {
  return Lexer(sources, file, sources.text(file), kind, names, sink, extent).run();
}

std::vector<Token> lex(std::string_view text, source::NameTable& names) {
  const source::SourceSet none;
  source::DiagnosticSink sink(none);
  return Lexer(none, source::FileId(0), text, TextKind::Piece, names, sink, {}).run();
}

}  // namespace stepwright::syntax
