#include "ladder/semantics/analyze.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "ladder/syntax/parser.h"

namespace {

using namespace stepwright;
using semantics::Base;
using semantics::Model;
using semantics::Pou;
using semantics::StatementKind;

// A source analysed without the standard library.
class Analyzed {
 public:
  explicit Analyzed(const std::string& text) : sink_(sources_) {
    syntax::intern_keywords(names_);
    syntax::SyntaxContext context{sources_, names_, sink_};
    syntax::parse_unit(context, sources_.add("t.st", text), unit_);
    model_ = semantics::analyze(unit_, unit_.pous.size(), names_, sink_);
    reports_ = sink_.take();
  }

  source::NameId name(const std::string& text) { return names_.intern(text); }
  const Model& model() const { return *model_; }
  std::string reports() const { return result::to_string(reports_); }
  const Pou& pou(const std::string& name) const {
    const auto& pous = model_->pous;
    return **std::find_if(pous.begin(), pous.end(), [&](const auto& each) { return each->spelling == name; });
  }

 private:
  source::SourceSet sources_;
  source::NameTable names_;
  source::DiagnosticSink sink_;
  syntax::Unit unit_;
  std::unique_ptr<Model> model_;
  result::Diagnostics reports_;
};

TEST(Analyze, Declarations_WhenUsedBeforeTheyStand_ThenTheirOrderDoesNotMatter) {
  const Analyzed found(
      "PROGRAM main VAR b : Block; l : List; END_VAR b(x := l[2].v); END_PROGRAM FUNCTION_BLOCK Block "
      "VAR_INPUT "
      "x : INT; END_VAR END_FUNCTION_BLOCK TYPE List : ARRAY[1..Last] OF Node; Node : STRUCT v : INT; "
      "END_STRUCT; "
      "END_TYPE VAR_GLOBAL CONSTANT Last : INT := 3; END_VAR");
  EXPECT_EQ(found.reports(), "");
  EXPECT_EQ(found.pou("main").type->size, 2u + 6u);
}

TEST(Analyze, Bounds_WhenTheyNameAConstantOfThePou_ThenItsValueCounts) {
  Analyzed found(
      "PROGRAM main VAR CONSTANT last : INT := 4; twice : INT := 2 * last; END_VAR VAR a : ARRAY[1..last] OF "
      "INT; "
      "b : INT(0..twice); END_VAR a[4] := b; END_PROGRAM");
  EXPECT_EQ(found.reports(), "");
  EXPECT_EQ(found.pou("main").find(found.name("A"))->type->size, 8u);
  EXPECT_EQ(found.pou("main").find(found.name("B"))->type->range.high, 8);
}

TEST(Analyze, Inputs_WhenTheFunctionWritesNothingOutside_ThenTheyAreNotCopied) {
  const std::string types = "TYPE List : ARRAY[1..3] OF INT; END_TYPE VAR_GLOBAL g : List; END_VAR ";
  const Analyzed reads(types +
                       "FUNCTION f : INT VAR_INPUT x : List; END_VAR f := x[1]; END_FUNCTION "
                       "PROGRAM main VAR n : INT; END_VAR n := f(g); END_PROGRAM");
  EXPECT_EQ(reads.reports(), "");
  EXPECT_EQ(reads.pou("f").frame_size, 0u);
  const Analyzed writes(types +
                        "FUNCTION f : INT VAR_INPUT x : List; END_VAR g[1] := 0; f := x[1]; END_FUNCTION "
                        "PROGRAM main VAR n : INT; END_VAR n := f(g); END_PROGRAM");
  EXPECT_EQ(writes.pou("f").frame_size, 6u);
  const Analyzed calls(
      types +
      "FUNCTION h : INT g[1] := 0; END_FUNCTION FUNCTION f : INT VAR_INPUT x : List; END_VAR "
      "VAR n : INT; END_VAR n := h(); f := x[1]; END_FUNCTION PROGRAM main VAR n : INT; "
      "END_VAR n := f(g); END_PROGRAM");
  EXPECT_EQ(calls.pou("f").frame_size, 6u);
}

TEST(Analyze, Guard_WhenAPouDeclaresEnable_ThenItsEntryReturns) {
  const Analyzed found(
      "FUNCTION_BLOCK b VAR_INPUT EN : BOOL; END_VAR VAR_OUTPUT ENO : BOOL; END_VAR END_FUNCTION_BLOCK "
      "PROGRAM main "
      "VAR x : b; END_VAR x(); END_PROGRAM");
  const semantics::Block& entry = found.pou("b").entry;
  ASSERT_EQ(entry.size(), 2u);
  EXPECT_EQ(entry[0].kind, StatementKind::Assign);
  ASSERT_EQ(entry[1].kind, StatementKind::If);
  EXPECT_EQ(entry[1].branches[0].body[0].kind, StatementKind::Return);
  // Enabled, if no call says otherwise.
  EXPECT_EQ(found.pou("b").type->initial[0], std::byte{1});
}

TEST(Analyze, Configuration_WhenABlockHasATask_ThenTheBodyOnlyPassesArguments) {
  const Analyzed found(
      "FUNCTION_BLOCK b VAR_INPUT x : INT; END_VAR END_FUNCTION_BLOCK PROGRAM main VAR own, given : b; "
      "END_VAR "
      "own(x := 1); given(x := 2); END_PROGRAM CONFIGURATION c TASK t(INTERVAL := T#1ms); TASK s(INTERVAL := "
      "T#9ms, "
      "PRIORITY := 3); PROGRAM p WITH t : main(given WITH s); END_CONFIGURATION");
  EXPECT_EQ(found.reports(), "");
  const semantics::Block& body = found.pou("main").body;
  EXPECT_FALSE(body[0].passes_only);
  EXPECT_TRUE(body[1].passes_only);
  ASSERT_EQ(found.model().tasks[1].calls.size(), 1u);
  EXPECT_EQ(found.model().tasks[1].calls[0].name, "p.given");
}

TEST(Analyze, Configuration_WhenAProgramHasNoTask_ThenItRunsBehindAllOthers) {
  const Analyzed found(
      "PROGRAM main END_PROGRAM CONFIGURATION c TASK t(INTERVAL := T#1ms, PRIORITY := 9); PROGRAM p WITH t : "
      "main; "
      "PROGRAM q : main; END_CONFIGURATION");
  ASSERT_EQ(found.model().tasks.size(), 2u);
  EXPECT_GT(found.model().tasks[1].priority, found.model().tasks[0].priority);
  EXPECT_EQ(found.model().tasks[1].calls[0].name, "q");
}

}  // namespace
