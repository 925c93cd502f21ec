#pragma once

// The words of Structured Text (IEC 61131-3, 6.1). Tokens view the text of their SourceSet.

#include <cstdint>
#include <string_view>

#include "ladder/source/name_table.h"
#include "ladder/source/source_set.h"

namespace stepwright::syntax {

enum class TokenKind : std::uint8_t {
  End,
  Identifier,
  TypePrefix,     // "INT#", "Color#": the name before '#'
  Integer,        // value in `integer`
  Real,           // value in `real`
  Time,           // value in `time_ns`, as in the next three
  Date,           // D#..., since 1970-01-01
  TimeOfDay,      // TOD#..., since midnight
  DateAndTime,    // DT#..., since 1970-01-01
  String,         // '...', with its quotes
  WideString,     // "...", with its quotes
  Direct,         // "%IX0.0", "%I*"
  Assign,         // :=
  AttemptAssign,  // ?=
  Output,         // =>
  Colon,
  Semicolon,
  Comma,
  Dot,
  Range,  // ..
  LeftParen,
  RightParen,
  LeftBracket,
  RightBracket,
  Plus,
  Minus,
  Star,
  Power,  // **
  Slash,
  Ampersand,
  Caret,  // ^
  Equal,
  NotEqual,
  Less,
  LessEqual,
  Greater,
  GreaterEqual,
  Bad,  // reported by the lexer already
  Keyword,
};

// Reserved words; the order is that of `kKeywords` in token.cpp.
enum class Keyword : std::uint8_t {
  None,
  Program,
  EndProgram,
  FunctionBlock,
  EndFunctionBlock,
  Function,
  EndFunction,
  Var,
  VarInput,
  VarOutput,
  VarInOut,
  VarTemp,
  VarExternal,
  VarGlobal,
  VarConfig,
  VarAccess,
  EndVar,
  Constant,
  Retain,
  NonRetain,
  RisingEdge,
  FallingEdge,
  At,
  Type,
  EndType,
  Struct,
  EndStruct,
  Array,
  Of,
  RefTo,
  Configuration,
  EndConfiguration,
  Resource,
  EndResource,
  On,
  Task,
  With,
  If,
  Then,
  Elsif,
  Else,
  EndIf,
  Case,
  EndCase,
  For,
  To,
  By,
  Do,
  EndFor,
  While,
  EndWhile,
  Repeat,
  Until,
  EndRepeat,
  Exit,
  Continue,
  Return,
  Jmp,
  True,
  False,
  Null,
  And,
  AndThen,
  Or,
  OrElse,
  Xor,
  Not,
  Mod,
  FinalScan,  // the pragma {sfc_final_scan}
  InitialStep,
  Step,
  EndStep,
  Transition,
  EndTransition,
  From,
  Action,
  EndAction,
};

struct Token {
  TokenKind kind = TokenKind::End;
  Keyword keyword = Keyword::None;  // TokenKind::Keyword only
  bool based = false;               // Integer: written with a base ("16#FF")
  bool foreign = false;             // an operator of another language, reported: what was meant
  source::Position where;
  std::string_view text;
  source::NameId name;  // Identifier, TypePrefix, Keyword
  union {
    std::uint64_t integer = 0;
    double real;
    std::int64_t time_ns;
  };

  bool is(TokenKind k) const { return kind == k; }
  bool is(Keyword k) const { return kind == TokenKind::Keyword && keyword == k; }
};

// Makes the reserved words the first names of an empty table, which every lexer of a compilation shares.
void intern_keywords(source::NameTable& names);
// The reserved word that a name is, or None.
Keyword keyword_of(source::NameId name);
// "END_IF"
const char* to_string(Keyword keyword);
// "';'", "an identifier"
const char* describe(TokenKind kind);

}  // namespace stepwright::syntax
