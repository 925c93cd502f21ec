// Random bodies in ST and FBD, written and read back: the same model, the same containers.

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "ladder/exchange/plcopen_reader.h"
#include "ladder/exchange/plcopen_writer.h"
#include "tests/support/compiled_program.h"
#include "tests/unit/ladder/exchange/random_diagram.h"

namespace stepwright::exchange {
namespace {

graphic::Project project_of(graphic::Pou pou) {
  graphic::Project project;
  project.name = "demo";
  project.tasks = {{"fast", 10'000, 1}};
  project.instances = {{"run", pou.name, "fast"}};
  project.pous.push_back(std::move(pou));
  return project;
}

std::vector<std::byte> container_of(const graphic::Project& project) {
  driver::CompileInput input;
  input.projects = {&project};
  auto output = driver::compile(input);
  if (!output) throw std::runtime_error(result::to_string(output.error()));
  return std::move(output->container);
}

// All sections but those that say where in which file the program stands: one that was never in a file has no
// such places.
std::string program_of(const graphic::Project& project) {
  const auto loaded = reader::LoadedProgram::load(container_of(project), "test");
  if (!loaded) throw std::runtime_error(result::to_string(loaded.error()));
  std::string all;
  for (std::uint16_t i = 0; i < bytecode::kSectionCount; ++i) {
    const auto section = static_cast<bytecode::Section>(i);
    if (section == bytecode::Section::SourceFiles || section == bytecode::Section::SourceMap ||
        section == bytecode::Section::Strings)
      continue;
    const auto bytes = loaded->program().container().section(section);
    all.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    all += "|";
  }
  return all;
}

std::string body_text(const graphic::Pou& pou) {
  if (const auto* text = std::get_if<graphic::StBody>(&pou.body)) {
    graphic::DrawnBody drawn;
    drawn.body.text.text = text->text;
    return text_of(drawn);
  }
  return text_of(std::get<graphic::DrawnBody>(pou.body));
}

void expect_same_again(const graphic::Project& original) {
  const auto xml = write_plcopen(original);
  ASSERT_TRUE(xml) << result::to_string(xml.error());
  const auto copy = read_plcopen("plc.xml", *xml);
  ASSERT_TRUE(copy) << result::to_string(copy.error()) << *xml;
  ASSERT_EQ(body_text(original.pous[0]), body_text(copy->pous[0])) << *xml;
  const auto again = write_plcopen(*copy);
  ASSERT_TRUE(again);
  ASSERT_EQ(*xml, *again);
  ASSERT_EQ(program_of(original) == program_of(*copy), true) << *xml;
  ASSERT_EQ(container_of(*copy) == container_of(*read_plcopen("plc.xml", *again)), true);
}

TEST(PlcopenRandom, WhenBodiesAreFbd_ThenModelAndContainerAreTheSame) {
  for (unsigned seed = 1; seed <= 300 && !HasFatalFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    expect_same_again(project_of(random_diagram(random)));
  }
}

// Statements between all that texts hold: comments, strings, layout, characters that XML reserves.
std::string random_statements(std::mt19937& random) {
  constexpr std::array<const char*, 15> pieces{"n0 := n0 + 1;",
                                               "IF b0 AND (n0 < 5) THEN b1 := NOT b1; END_IF;",
                                               "b2 := n0 <> n1 & b0;",
                                               "(* a comment <with> ]]> marks & more *)",
                                               "// to the end of the line\n",
                                               "s := 'it$'s <b>&amp; ]]>';",
                                               "\n\n",
                                               "\r\n",
                                               "\t  ",
                                               "// gr\xC3\xB6\xC3\x9F"
                                               "er \xE2\x82\xAC \xF0\x9F\x9A\x80\n",
                                               "FOR n1 := 0 TO 3 DO\n  n2 := n2 + n1;\nEND_FOR;",
                                               "CASE n0 OF 1: b3 := TRUE; ELSE b3 := FALSE; END_CASE;",
                                               "t0(IN := b0, PT := T#20ms);",
                                               "{pragma}",
                                               ";"};
  std::string text;
  for (int i = static_cast<int>(random() % 9); i >= 0; --i) {
    text += pieces[random() % pieces.size()];
    if (random() % 3 == 0) text += " ";
  }
  return text;
}

TEST(PlcopenRandom, WhenBodiesAreSt_ThenModelAndContainerAreTheSame) {
  for (unsigned seed = 1; seed <= 400 && !HasFatalFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    graphic::Pou pou = random_diagram(random);
    pou.variables.push_back({"s", "STRING[40]"});
    pou.body = graphic::StBody{random_statements(random)};
    expect_same_again(project_of(std::move(pou)));
  }
}

TEST(PlcopenRandom, WhenATextHoldsWhatXmlCannot_ThenItIsRefused) {
  for (const std::string& bad : {std::string("a\x01"), std::string("\xFF"), std::string("a\0b", 3)}) {
    graphic::Pou pou;
    pou.name = "main";
    pou.body = graphic::StBody{"// " + bad + "\n"};
    const auto xml = write_plcopen(project_of(pou));
    ASSERT_FALSE(xml);
    EXPECT_EQ(xml.error().front().code, "E0815");
    EXPECT_NE(xml.error().front().message.find("POU 'main'"), std::string::npos);
  }
}

}  // namespace
}  // namespace stepwright::exchange
