#include "ladder/driver/text_sheets.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "ladder/driver/chart_conversion.h"
#include "ladder/driver/declaration_notes.h"

namespace stepwright::driver {

namespace {

using graphic::Sheet;
using syntax::Keyword;
using syntax::Token;
using syntax::TokenKind;

graphic::VariableSection section_of(syntax::Section section) {
  switch (section) {
    case syntax::Section::Local:
      return graphic::VariableSection::Local;
    case syntax::Section::Temp:
      return graphic::VariableSection::Temp;
    case syntax::Section::Input:
      return graphic::VariableSection::Input;
    case syntax::Section::Output:
      return graphic::VariableSection::Output;
    case syntax::Section::InOut:
      return graphic::VariableSection::InOut;
    case syntax::Section::External:
      return graphic::VariableSection::External;
    case syntax::Section::Global:
      break;
  }
  return graphic::VariableSection::Global;
}

const char* kind_word(syntax::PouKind kind) {
  return kind == syntax::PouKind::Program         ? "PROGRAM"
         : kind == syntax::PouKind::FunctionBlock ? "FUNCTION_BLOCK"
                                                  : "FUNCTION";
}

bool is_blank(char c) {
  return std::isspace(static_cast<unsigned char>(c)) != 0;
}

// On one line, with single blanks.
std::string collapsed(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (!is_blank(c)) {
      result += c;
    } else if (!result.empty() && result.back() != ' ') {
      result += ' ';
    }
  }
  while (!result.empty() && result.back() == ' ') result.pop_back();
  return result;
}

class TextSheets {
 public:
  TextSheets(syntax::SyntaxContext& context, source::FileId file)
      : context_(context),
        file_(file),
        text_(context.sources.text(file)),
        tokens_(syntax::lex(context.sources, file, syntax::TextKind::Written, context.names, context.sink)) {
    for (std::size_t i = 0; i < text_.size(); ++i)
      if (text_[i] == '\n') line_ends_.push_back(i);
  }

  std::vector<Sheet> run(const syntax::Unit& unit) {
    for (const syntax::PouDeclaration& pou : unit.pous) add(pou);
    for (const syntax::Configuration& each : unit.configurations) {
      add_section("CONFIGURATION", std::string(each.name.text), before(each.name.where.offset),
                  Keyword::EndConfiguration);
      Sheet& sheet = sheets_.back().second;
      for (const syntax::VariableDeclaration& line : each.globals) add(line, sheet);
      for (const syntax::Resource& resource : each.resources)
        for (const syntax::VariableDeclaration& line : resource.globals) add(line, sheet);
    }
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      if (tokens_[i].is(Keyword::Type)) add_section("TYPE", "", i, Keyword::EndType);
    }
    add_globals(unit.globals);
    std::stable_sort(sheets_.begin(), sheets_.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Sheet> result;
    for (auto& each : sheets_) {
      each.second.file = context_.sources.name(file_);
      result.push_back(std::move(each.second));
    }
    return result;
  }

 private:
  // Index of the first token at or behind a byte.
  std::size_t at(std::size_t offset) const {
    const auto found =
        std::lower_bound(tokens_.begin(), tokens_.end(), offset,
                         [](const Token& token, std::size_t byte) { return token.where.offset < byte; });
    return static_cast<std::size_t>(found - tokens_.begin());
  }
  std::size_t before(std::size_t offset) const {
    const std::size_t index = at(offset);
    return index > 0 ? index - 1 : 0;
  }
  std::size_t end_of(const Token& token) const { return token.where.offset + token.text.size(); }

  void add(const syntax::PouDeclaration& pou) {
    Sheet sheet{kind_word(pou.kind), std::string(pou.name.text)};
    if (pou.result) sheet.result_type = until(at(pou.result->where.offset), result_end(pou));
    for (const syntax::VariableDeclaration& line : pou.variables) add(line, sheet);
    if (pou.chart) {
      auto chart = to_graphic(*pou.chart, Marks::None, context_.sources, context_.sink);
      result::Diagnostics diagnostics = graphic::check(chart);
      for (result::Diagnostic& each : diagnostics)
        if (each.where.file.empty()) each.where = context_.sources.location(pou.name.where);
      context_.sink.add(std::move(diagnostics));
      sheet.body = std::move(chart);
    } else {
      sheet.body = listing(body_start(pou), pou.end.offset);
    }
    sheets_.emplace_back(pou.name.where.offset, std::move(sheet));
  }

  // The same as listing_of, without counting the lines before from the beginning of the file.
  graphic::Listing listing(std::size_t begin, std::size_t end) const {
    begin = std::min(begin, text_.size());
    graphic::Listing found = listing_of(text_.substr(begin, std::max(begin, end) - begin), 0, text_.size());
    found.first_line +=
        static_cast<std::uint32_t>(std::ranges::lower_bound(line_ends_, begin) - line_ends_.begin());
    return found;
  }

  // Behind the type of a function's result: BOOL, STRING[20], Plant.Mode.
  std::size_t result_end(const syntax::PouDeclaration& pou) const {
    std::size_t i = at(pou.result->where.offset) + 1;
    while (tokens_[i].is(TokenKind::Dot) && tokens_[i + 1].is(TokenKind::Identifier)) i += 2;
    if (!tokens_[i].is(TokenKind::LeftBracket)) return i;
    while (!tokens_[i].is(TokenKind::RightBracket) && !tokens_[i].is(TokenKind::End)) ++i;
    return i + 1;
  }

  // Behind the last declaration, or behind the head of a POU without any.
  std::size_t body_start(const syntax::PouDeclaration& pou) const {
    const std::size_t name = at(pou.name.where.offset);
    std::size_t start = end_of(tokens_[name]);
    if (pou.result) start = end_of(tokens_[result_end(pou) - 1]);
    for (std::size_t i = name; i < tokens_.size() && tokens_[i].where.offset < pou.end.offset; ++i)
      if (tokens_[i].is(Keyword::EndVar)) start = end_of(tokens_[i]);
    const std::size_t next = at(start);
    return tokens_[next].is(TokenKind::Semicolon) ? end_of(tokens_[next]) : start;
  }

  // The text from one token up to another.
  std::string until(std::size_t first, std::size_t last) const {
    if (first >= last) return {};
    const std::size_t begin = tokens_[first].where.offset;
    return collapsed(text_.substr(begin, end_of(tokens_[last - 1]) - begin));
  }

  void add(const syntax::VariableDeclaration& line, Sheet& sheet) {
    if (line.names.empty() || !line.type) return;
    graphic::Variable variable;
    variable.section = section_of(line.section);
    variable.constant = line.constant;
    variable.retain = line.retain;
    const std::size_t type = at(line.type->where.offset);
    std::size_t value = type;
    int depth = 0;
    for (; !tokens_[value].is(TokenKind::End); ++value) {
      if (tokens_[value].is(Keyword::Struct)) ++depth;
      if (tokens_[value].is(Keyword::EndStruct)) --depth;
      if (depth == 0 && (tokens_[value].is(TokenKind::Semicolon) || tokens_[value].is(TokenKind::Assign)))
        break;
    }
    std::size_t end = value;
    while (!tokens_[end].is(TokenKind::Semicolon) && !tokens_[end].is(TokenKind::End)) ++end;
    variable.type = until(type, value);
    if (tokens_[value].is(TokenKind::Assign)) variable.initial = until(value + 1, end);
    if (line.address || line.open_address)
      variable.address = std::string(tokens_[at(line.address_where.offset)].text);
    const DeclarationNotes notes = notes_of(at(line.names.front().where.offset), end);
    variable.comment = collapsed(notes.comment());
    for (const syntax::Name& name : line.names) {
      variable.name = std::string(name.text);
      if (const auto note = notes.note()) sheet.notes[variable.name] = *note;
      sheet.variables.push_back(variable);
    }
  }

  // Of the declaration between two tokens; members of a structure in it say nothing of the variable.
  DeclarationNotes notes_of(std::size_t first, std::size_t last) const {
    DeclarationNotes notes(text_);
    if (first > 0)
      notes.before(end_of(tokens_[first - 1]), tokens_[first].where.offset,
                   tokens_[first - 1].is(TokenKind::Semicolon));
    int depth = 0;
    for (std::size_t i = first; i < last; ++i) {
      if (tokens_[i].is(Keyword::Struct)) ++depth;
      if (tokens_[i].is(Keyword::EndStruct)) --depth;
      if (depth == 0) notes.between(end_of(tokens_[i]), tokens_[i + 1].where.offset);
    }
    notes.behind(end_of(tokens_[last]));
    return notes;
  }

  void add_section(const char* kind, std::string name, std::size_t first, Keyword last) {
    std::size_t end = first;
    while (!tokens_[end].is(last) && !tokens_[end].is(TokenKind::End)) ++end;
    Sheet sheet{kind, std::move(name)};
    sheet.body = listing(tokens_[first].where.offset, end_of(tokens_[end]));
    sheets_.emplace_back(tokens_[first].where.offset, std::move(sheet));
  }

  void add_globals(const std::vector<syntax::VariableDeclaration>& globals) {
    if (globals.empty() || globals.front().names.empty()) return;
    Sheet sheet{"VAR_GLOBAL", ""};
    for (const syntax::VariableDeclaration& line : globals) add(line, sheet);
    sheets_.emplace_back(globals.front().names.front().where.offset, std::move(sheet));
  }

  syntax::SyntaxContext& context_;
  source::FileId file_;
  std::string_view text_;
  std::vector<Token> tokens_;
  std::vector<std::size_t> line_ends_;
  std::vector<std::pair<std::size_t, Sheet>> sheets_;  // by the byte where it begins
};

}  // namespace

graphic::Listing listing_of(std::string_view text, std::size_t begin, std::size_t end) {
  end = std::min(end, text.size());
  begin = std::min(begin, end);
  std::size_t line_start = begin;
  for (std::size_t i = begin; i < end && is_blank(text[i]); ++i)
    if (text[i] == '\n') line_start = i + 1;
  while (end > line_start && is_blank(text[end - 1])) --end;
  graphic::Listing listing;
  listing.first_line = 1 + static_cast<std::uint32_t>(std::count(
                               text.begin(), text.begin() + static_cast<std::ptrdiff_t>(line_start), '\n'));
  std::string line;
  for (std::size_t i = line_start; i <= end; ++i) {
    if (i < end && text[i] != '\n') {
      if (text[i] == '\t') line += "    ";
      if (text[i] != '\r' && text[i] != '\t') line += text[i];
      continue;
    }
    if (i > line_start) listing.lines.push_back(std::move(line));
    line.clear();
  }
  return listing;
}

std::vector<Sheet> text_sheets(syntax::SyntaxContext& context, source::FileId file,
                               const syntax::Unit& unit) {
  return TextSheets(context, file).run(unit);
}

}  // namespace stepwright::driver
