// Every page of ladder/doc/diagnostics: its wrong example gives the code at the marked place and nothing
// else, its right example compiles without a word.

#include "ladder/driver/diagnostic_pages.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>

#include "ladder/driver/compile.h"
#include "runtime/bytecode/reader/loaded_program.h"
#include "tests/support/compiled_program.h"

namespace {

using namespace stepwright;

struct Mark {
  std::string code;
  std::uint32_t line = 0;
  std::uint32_t column = 0;

  friend auto operator<=>(const Mark&, const Mark&) = default;
};

void PrintTo(const Mark& mark, std::ostream* out) {
  *out << mark.code << " at " << mark.line << ":" << mark.column;
}

// The block of ST behind a line of text; empty if there is none.
std::string block(std::string_view page, std::string_view heading) {
  const std::string opening = std::string(heading) + "\n\n```st\n";
  const std::size_t begin = page.find(opening);
  if (begin == std::string_view::npos) return {};
  const std::size_t end = page.find("```", begin + opening.size());
  return std::string(page.substr(begin + opening.size(), end - begin - opening.size()));
}

// "//   ^ E0301" marks a character of the line before.
std::vector<Mark> marks_of(const std::string& text) {
  std::vector<Mark> marks;
  std::uint32_t line = 0;
  for (std::size_t at = 0; at < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string each = text.substr(at, end - at);
    const std::size_t caret = each.find('^');
    if (each.rfind("//", 0) == 0 && caret != std::string::npos)
      marks.push_back({each.substr(caret + 2, 5), line, static_cast<std::uint32_t>(caret + 1)});
    at = end + 1;
  }
  return marks;
}

// "Dialect: matiec": whose examples they are.
const source::Dialect& dialect_of(std::string_view page) {
  constexpr std::string_view kWord = "\nDialect: ";
  const std::size_t at = page.find(kWord);
  if (at == std::string_view::npos) return source::standard_dialect();
  const std::string_view rest = page.substr(at + kWord.size());
  return *source::find_dialect(rest.substr(0, rest.find('\n')));
}

result::Diagnostics diagnostics_of(const std::string& text, lint::Level level,
                                   const source::Dialect& dialect) {
  driver::CompileInput input;
  input.dialect = &dialect;
  input.texts.push_back({"example.st", text});
  input.lint = level;
  const auto output = driver::compile(input);
  return output ? output->warnings : output.error();
}

// Compiles a program and runs it for three scans: the trap as a mark.
std::vector<Mark> traps_of(const std::string& text) {
  driver::CompileInput input;
  input.texts.push_back({"example.st", text});
  support::CompiledProgram program(input);
  for (int i = 0; i < 3; ++i) {
    const auto report = program.scan();
    if (!report.trap) continue;
    const auto trap = reader::describe(program.loaded().program(), report.trap);
    return {{trap.code, trap.where.line, trap.where.column}};
  }
  return {};
}

bool is_trap(const driver::DiagnosticPage& page) {
  return page.code.front() == 'R';
}

class Page : public testing::TestWithParam<driver::DiagnosticPage> {};

TEST_P(Page, WrongExample_WhenCompiled_ThenGivesTheCodeAtTheMarkAndNothingElse) {
  const std::string text = block(GetParam().text, "Wrong:");
  std::vector<Mark> expected = marks_of(text);
  ASSERT_FALSE(expected.empty()) << "no place is marked";
  for (const Mark& each : expected) EXPECT_EQ(each.code, GetParam().code);
  std::vector<Mark> found;
  const auto diagnostics = diagnostics_of(text, lint::Level::All, dialect_of(GetParam().text));
  for (const auto& each : diagnostics) found.push_back({each.code, each.where.line, each.where.column});
  if (is_trap(GetParam())) {
    EXPECT_TRUE(found.empty()) << to_string(diagnostics);
    found = traps_of(text);
  }
  EXPECT_EQ(found, expected) << to_string(diagnostics);
}

TEST_P(Page, RightExample_WhenCompiled_ThenNothingIsReported) {
  const std::string text = block(GetParam().text, "Right:");
  const auto diagnostics = diagnostics_of(text, lint::Level::All, dialect_of(GetParam().text));
  EXPECT_TRUE(diagnostics.empty()) << to_string(diagnostics);
  if (is_trap(GetParam())) {
    EXPECT_EQ(traps_of(text), std::vector<Mark>());
  }
}

TEST(Pages, Texts_WhenRead_ThenBeginWithTheirCodeAndFitATerminal) {
  for (const driver::DiagnosticPage& page : driver::diagnostic_pages()) {
    const std::string text(page.text);
    EXPECT_EQ(text.rfind("# " + std::string(page.code) + ": ", 0), 0u) << page.code;
    EXPECT_FALSE(page.title().empty()) << page.code;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = text.find('\n', at);
      EXPECT_LE(end - at, 120u) << text.substr(at, end - at);
      at = end + 1;
    }
  }
}

// Which pages have none is held by a test of its own.
std::vector<driver::DiagnosticPage> pages_with_examples() {
  std::vector<driver::DiagnosticPage> pages;
  for (const driver::DiagnosticPage& each : driver::diagnostic_pages())
    if (!block(each.text, "Wrong:").empty()) pages.push_back(each);
  return pages;
}

INSTANTIATE_TEST_SUITE_P(Pages, Page, testing::ValuesIn(pages_with_examples()),
                         [](const auto& each) { return std::string(each.param.code); });

std::set<std::string> codes_in(const std::string& file) {
  std::ifstream in(STEPWRIGHT_SOURCE_DIR "/" + file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  std::set<std::string> codes;
  for (std::size_t at = text.find("= \""); at != std::string::npos; at = text.find("= \"", at + 1))
    codes.insert(text.substr(at + 3, 5));
  return codes;
}

TEST(Pages, Codes_WhenComparedWithThePages_ThenEachHasOneAndNoPageIsLeftOver) {
  std::set<std::string> codes = codes_in("ladder/source/codes.h");
  ASSERT_GT(codes.size(), 60u);
  codes.merge(codes_in("ladder/graphic/sfc_codes.h"));
  codes.merge(codes_in("ladder/exchange/exchange_codes.h"));
  codes.insert({"E0001", "E0002", "E0003", "E0004"});  // of the command line
  for (std::uint8_t i = 1; i < bytecode::kTrapCodeCount; ++i)
    codes.insert(bytecode::diagnostic_code_of(static_cast<bytecode::TrapCode>(i)));
  std::set<std::string> pages;
  for (const driver::DiagnosticPage& each : driver::diagnostic_pages()) pages.insert(std::string(each.code));
  EXPECT_EQ(pages, codes);
}

// What no ST text of a page can give: drawings, files, floods, depth, names longer than its lines.
TEST(Pages, Examples_WhenCounted_ThenOnlyKnownPagesHaveNone) {
  const std::set<std::string> without = {
      "E0001", "E0002", "E0003", "E0004", "E0100", "E0106", "E0109", "E0701", "E0702", "E0711",
      "E0713", "E0714", "E0715", "E0716", "E0717", "E0719", "E0801", "E0802", "E0803", "E0804",
      "E0811", "E0812", "E0813", "E0814", "E0815", "R0404", "R0407", "W0021", "W0706"};
  for (const driver::DiagnosticPage& each : driver::diagnostic_pages())
    EXPECT_EQ(block(each.text, "Wrong:").empty(), without.contains(std::string(each.code))) << each.code;
}

TEST(Pages, Find_WhenTheCaseDiffers_ThenFindsThePage) {
  ASSERT_NE(driver::find_page("e0301"), nullptr);
  EXPECT_EQ(driver::find_page("e0301")->title(), "the value has another type than its place");
  EXPECT_EQ(driver::find_page("E9999"), nullptr);
}

}  // namespace
