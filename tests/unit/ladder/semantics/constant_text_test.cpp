#include "ladder/semantics/constants/constant_text.h"

#include <gtest/gtest.h>

namespace {

using namespace stepwright::semantics;
using stepwright::bytecode::StringOpId;

Constant text(const char16_t* characters) {
  return {0, 0, characters};
}

class ConstantText : public testing::Test {
 protected:
  std::optional<Constant> of(StringOpId op, std::vector<Constant> operands, std::uint32_t capacity = 80) {
    return evaluate_text(op, operands, *types_.string(ElementaryType::String, capacity));
  }
  std::optional<Constant> number(StringOpId op, const char16_t* characters, ElementaryType type) {
    const Constant operand = text(characters);
    return evaluate_text(op, {&operand, 1}, *types_.elementary(type));
  }

  TypeTable types_;
};

TEST_F(ConstantText, Edit_WhenTheResultIsLongerThanItsType_ThenItIsCut) {
  EXPECT_EQ(of(StringOpId::ConcatS, {text(u"abc"), text(u"def")}, 4)->text, u"abcd");
  EXPECT_EQ(of(StringOpId::InsertS, {text(u"abc"), text(u"xy"), {1}}, 2)->text, u"ax");
}

TEST_F(ConstantText, Edit_WhenANumberIsNegative_ThenThereIsNoValue) {
  EXPECT_FALSE(of(StringOpId::LeftS, {text(u"abc"), {-1}}));
  EXPECT_FALSE(of(StringOpId::RightS, {text(u"abc"), {-1}}));
  EXPECT_FALSE(of(StringOpId::MidS, {text(u"abc"), {1}, {-1}}));
  EXPECT_FALSE(of(StringOpId::DeleteS, {text(u"abc"), {-1}, {1}}));
  EXPECT_FALSE(of(StringOpId::InsertS, {text(u"abc"), text(u"x"), {-1}}));
  EXPECT_FALSE(of(StringOpId::ReplaceS, {text(u"abc"), text(u"x"), {1}, {-1}}));
}

TEST_F(ConstantText, Edit_WhenAPositionIsBeyondTheText_ThenItIsTheEnd) {
  EXPECT_EQ(of(StringOpId::MidS, {text(u"abc"), {2}, {9}})->text, u"");
  EXPECT_EQ(of(StringOpId::InsertS, {text(u"abc"), text(u"x"), {9}})->text, u"abcx");
  EXPECT_EQ(of(StringOpId::ReplaceS, {text(u"abc"), text(u"x"), {9}, {3}})->text, u"abx");
}

TEST_F(ConstantText, Number_WhenItDoesNotFit_ThenThereIsNoValue) {
  EXPECT_EQ(number(StringOpId::ToI64S, u"-128", ElementaryType::Sint)->integer, -128);
  EXPECT_FALSE(number(StringOpId::ToI64S, u"128", ElementaryType::Sint));
  EXPECT_FALSE(number(StringOpId::ToU64S, u"-1", ElementaryType::Ulint));
  EXPECT_FALSE(number(StringOpId::ToF32S, u"1E39", ElementaryType::Real));
  EXPECT_FALSE(number(StringOpId::ToI64S, u"\u0661", ElementaryType::Int));
}

TEST_F(ConstantText, Order_WhenTextsDiffer_ThenTheCodesDecide) {
  EXPECT_EQ(compare_texts(u"abc", u"abd"), -1);
  EXPECT_EQ(compare_texts(u"ab", u"abc"), -1);
  EXPECT_EQ(compare_texts(u"b", u"abc"), 1);
  EXPECT_EQ(compare_texts(u"", u""), 0);
}

}  // namespace
