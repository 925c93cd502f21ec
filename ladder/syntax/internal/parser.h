#pragma once

// The recursive-descent parser behind parser.h. One object reads one token list; its members are defined in
// one source file per language part (expressions, statements, declarations, charts, configurations).

#include <initializer_list>
#include <optional>
#include <string>
#include <utility>

#include "ladder/syntax/parser.h"

namespace stepwright::syntax::internal {

class Parser {
 public:
  // `tokens` and `context` must outlive the parser.
  Parser(SyntaxContext& context, const std::vector<Token>& tokens, TextKind kind)
      : context_(context), tokens_(tokens), kind_(kind), jumps_(kind == TextKind::Generated) {}

  // parser.cpp
  void unit(Unit& out);
  Statements whole_statements();
  std::vector<VariableDeclaration> whole_variables();
  PieceResult piece(PieceKind kind);
  ExpressionPtr whole_expression();

 private:
  bool at_declaration_of_unit() const;

  // Cursor (cursor.cpp).
  const Token& peek(std::size_t ahead = 0) const;
  const Token& advance();
  bool at(TokenKind kind) const { return peek().is(kind); }
  bool at(Keyword keyword) const { return peek().is(keyword); }
  bool accept(TokenKind kind);
  bool accept(Keyword keyword);
  // Reports "expected ..., found ..." unless the token was complained about already.
  bool expect(TokenKind kind, const char* after, const std::string& otherwise = {});
  bool expect(Keyword keyword, const char* after);
  // Closes a block that `open` began: reports the missing END at the place of `open`.
  bool expect_end(Keyword keyword, const Token& open, const std::string& hint = {});
  std::optional<Name> expect_name(const char* what);
  void unexpected(const std::string& wanted, const std::string& hint = {});
  // The end of the token before: where something is missing.
  source::Position after_previous() const;
  // Skips to behind the next ';' or before something that begins or ends a block.
  void skip_statement();
  void skip_declaration();
  bool at_pou_start() const { return begins_or_ends_pou(peek()) || at_test_declaration(); }
  static bool begins_or_ends_pou(const Token& token);
  static bool begins_section(const Token& token);
  bool at_block_end() const;
  bool at_statement_keyword() const;

  // Guards against stack exhaustion; reports once.
  class Nesting;
  bool is_too_deep() const;
  bool too_deep();

  // expression_parser.cpp
  ExpressionPtr expression();
  ExpressionPtr binary(int level);
  ExpressionPtr no_assignment(ExpressionPtr before);
  ExpressionPtr unary();
  ExpressionPtr primary();
  ExpressionPtr name_or_call();
  ExpressionPtr suffixes(ExpressionPtr base);
  bool member(Expression& node);
  std::optional<DirectAddress> direct_address();
  bool at_path_call(const Expression& base) const;
  void call_arguments(Expression& call);
  ExpressionPtr make(ExpressionKind kind) const;
  ExpressionPtr error_node() const { return make(ExpressionKind::Error); }
  ExpressionPtr join(Operator op, ExpressionPtr left, ExpressionPtr right, source::Position where,
                     bool extend);
  static void adopt(Expression& parent, ExpressionPtr child);

  // literal_parser.cpp
  ExpressionPtr literal();
  ExpressionPtr text_literal();
  ExpressionPtr prefixed_literal();
  bool at_full_prefix() const;
  Name literal_prefix();

  // argument_parser.cpp
  bool arguments(std::vector<Argument>& list);
  Argument argument();
  ExpressionPtr initial_value();
  ExpressionPtr array_values();
  ExpressionPtr struct_values();

  // object_parser.cpp
  bool at_object() const;
  void skip_object();
  void object_word();
  bool accept_modifier();
  void skip_inheritance();

  // namespace_parser.cpp
  bool at_namespace() const;
  bool at_using() const;
  std::optional<Name> full_name(const char* what, std::vector<std::string_view>* parts = nullptr);
  bool is_too_long(std::size_t characters, source::Position where);
  void using_directives(std::vector<Name>& out);
  bool accept_internal();
  void qualify(Unit& out, Name& name, bool internal);
  void open_namespace(Unit& out, const Name& name, const std::vector<std::string_view>& parts, bool internal);
  void skip_namespace();
  void namespace_block(Unit& out);
  void namespace_part(Unit& out);
  void types_of_unit(Unit& out);
  void pou_of_unit(Unit& out);
  void enter_scope(Unit& out, PouDeclaration& pou);
  void globals_of_unit(Unit& out);

  // statement_parser.cpp
  Statements statements();
  StatementPtr statement();
  StatementPtr simple_statement();
  StatementPtr if_statement();
  ExpressionPtr condition();
  bool at_misspelt_elsif() const;
  StatementPtr case_statement();
  StatementPtr for_statement();
  StatementPtr while_statement();
  StatementPtr repeat_statement();
  StatementPtr keyword_statement(StatementKind kind);
  StatementPtr jump_statement();
  void expect_in_head(Keyword word, const char* after, Keyword last);
  StatementPtr make_statement(StatementKind kind) const;
  Branch case_branch();
  bool at_case_label() const;
  void end_of_statement(const std::string& hint = {});
  void end_of_block();

  // declaration_parser.cpp
  bool at_variable_section() const;
  bool at_reserved_name() const;
  void variable_section(std::vector<VariableDeclaration>& out);
  bool variable_line(const VariableDeclaration& model, std::vector<VariableDeclaration>& out);
  bool variable_names(VariableDeclaration& line);
  bool variable_address(VariableDeclaration& line);
  bool relative_address(VariableDeclaration& line);
  bool typed_line(VariableDeclaration& line);
  void variable_lines(const VariableDeclaration& model, std::vector<VariableDeclaration>& out);
  bool at_declaration() const;
  bool at_bare_statement() const;

  // type_parser.cpp
  TypeSpecPtr type();
  TypeSpecPtr named_type();
  TypeSpecPtr array_type();
  bool array_range(TypeSpec& spec);
  TypeSpecPtr struct_type();
  TypeSpecPtr enumeration_type();
  void enumerators(TypeSpec& spec);
  void subrange(TypeSpec& spec);
  void text_length(TypeSpec& spec);
  bool at_pointer() const;
  TypeSpecPtr reference_type();
  bool type_section(std::vector<TypeDeclaration>& out);

  // pou_parser.cpp
  PouDeclaration pou();
  void pou_head(PouDeclaration& result, bool stands_for_another = false);
  void pou_body(PouDeclaration& result, std::optional<Keyword> end = {});
  void stray_word(PouDeclaration& pou);
  TypeSpecPtr function_result();
  void skip_header_line();
  bool at_unopened_section() const;

  // test_parser.cpp
  bool at_word(const char* word) const;
  bool at_test() const;
  bool at_mock() const;
  // Where a test or a mock begins, or ends the one that is being read.
  bool at_test_declaration() const;
  void test(std::vector<TestDeclaration>& out);
  void mock(Unit& out);
  void close_test(const Token& open);

  // configuration_parser.cpp
  Configuration configuration();
  Resource resource();
  void resource_item(Resource& out);
  void skip_resource_item();
  void task(Resource& out);
  bool task_argument(const Argument& argument, const char* name);
  void program_instance(Resource& out);
  void program_elements(ProgramDeclaration& out);
  void access_section();
  bool access_line();
  bool access_path();
  void configured_section(std::vector<ConfiguredVariable>& out);
  bool configured_line(std::vector<ConfiguredVariable>& out);

  // chart_parser.cpp
  bool at_chart() const;
  Chart chart(Keyword end);
  StepDeclaration step();
  ActionUse action_use();
  TextSlice action_argument(const char* what);
  TransitionDeclaration transition();
  std::optional<std::uint64_t> transition_priority();
  void transition_condition(TransitionDeclaration& result);
  std::vector<Name> step_list();
  ActionDeclaration action();
  void action_statements();
  // From the cursor to before the given token; `until` is not passed.
  template <typename Kind>
  TextSlice slice_until(Kind until);
  // The text from a token to before the cursor.
  TextSlice slice_from(std::size_t first) const;

  SyntaxContext& context_;
  const std::vector<Token>& tokens_;
  TextKind kind_;
  std::size_t at_ = 0;
  std::size_t reported_at_ = static_cast<std::size_t>(-1);
  int nesting_ = 0;
  int cases_ = 0;                  // CASE statements around the cursor
  bool jumps_;                     // "JMP name;" and "name:" are statements
  bool open_end_ = false;          // the last statement of the list may stand without ';'
  const char* closing_ = nullptr;  // END_TEST, END_MOCK: of what is being read
  NameScope* scope_ = nullptr;     // of the declarations at the cursor; null outside of a unit
  std::string space_text_;         // full name of the namespace that is open; empty outside
  bool in_structure_ = false;      // what is declared is a member
  std::vector<Name> pou_used_;     // USING of the POU that is being read
  bool internal_pou_ = false;      // it is INTERNAL to the namespace
};

// Counts one level of nesting while it lives.
class Parser::Nesting {
 public:
  explicit Nesting(Parser& parser) : parser_(parser) { ++parser_.nesting_; }
  ~Nesting() { --parser_.nesting_; }
  Nesting(const Nesting&) = delete;
  Nesting& operator=(const Nesting&) = delete;

 private:
  Parser& parser_;
};

}  // namespace stepwright::syntax::internal
