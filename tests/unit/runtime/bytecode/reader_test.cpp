#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <fstream>
#include <utility>
#include <vector>

#include "runtime/bytecode/member_bit.h"
#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/bytecode/reader/program_info.h"
#include "runtime/bytecode/reader/read_value.h"
#include "runtime/bytecode/reader/resolve_name.h"
#include "runtime/bytecode/writer/container_writer.h"
#include "tests/support/sample_model.h"
#include "tests/support/test_program.h"

namespace stepwright::reader {
namespace {

using L = support::SampleLayout;

std::vector<std::byte> sample_bytes() {
  return writer::write_container(support::sample_model()).value();
}

std::string code_for(std::vector<std::byte> bytes) {
  const auto loaded = LoadedProgram::load(std::move(bytes), "x.swb");
  return loaded ? "" : loaded.error()[0].code;
}

// A program with one variable, of a type with two BOOLs; the second one has these flags.
ProgramInfo with_two_bools(const char* variable, bytecode::TypeKind kind, const char* first,
                           const char* second, std::uint32_t flags) {
  writer::ContainerModel model;
  model.sizes.data_bytes = 2;
  const auto boolean = model.add_type(writer::elementary(bytecode::ElementaryType::Bool));
  writer::Type pair;
  pair.name = "PAIR";
  pair.kind = kind;
  pair.size = 2;
  pair.members.push_back({first, boolean, 0});
  pair.members.push_back({second, boolean, 1, flags});
  const auto type = model.add_type(std::move(pair));
  writer::Symbol symbol;
  symbol.name = variable;
  symbol.type = type;
  model.symbols.push_back(std::move(symbol));
  writer::FunctionBuilder main("MAIN", bytecode::FunctionKind::Program, 2);
  main.emit(bytecode::Opcode::Return);
  model.functions.push_back(std::move(main).take());
  model.tasks.push_back({.name = "t", .interval_us = 1'000, .priority = 0, .calls = {{"MAIN", 0, 0}}});
  return ProgramInfo::read(writer::write_container(model).value()).value();
}

TEST(LoadedProgram, Bytes_WhenWrong_ThenTheCodeSaysWhatIsWrong) {
  std::vector<std::byte> bytes = sample_bytes();
  EXPECT_EQ(code_for(bytes), "");
  EXPECT_EQ(code_for({}), "B0001");
  EXPECT_EQ(code_for(std::vector<std::byte>(100, std::byte{'x'})), "B0001");
  EXPECT_EQ(code_for({bytes.begin(), bytes.begin() + 200}), "B0003");
  EXPECT_EQ(code_for({bytes.begin(), bytes.begin() + 10}), "B0003");
  std::vector<std::byte> flipped = bytes;
  flipped[300] ^= std::byte{4};
  EXPECT_EQ(code_for(flipped), "B0004");
  std::vector<std::byte> newer = bytes;
  newer[4] = std::byte{77};
  EXPECT_EQ(code_for(newer), "B0002");
}

TEST(LoadedProgram, File_WhenMissing_ThenNamesIt) {
  const auto loaded = LoadedProgram::load_file("/nonexistent/x.swb");
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.error()[0].code, "B0006");
  EXPECT_EQ(loaded.error()[0].where.file, "/nonexistent/x.swb");
}

TEST(LoadedProgram, File_WhenADirectory_ThenIsRefused) {
  EXPECT_FALSE(LoadedProgram::load_file("/"));
}

TEST(LoadedProgram, Trap_WhenDescribed_ThenNamesLineAndFunction) {
  const auto loaded = LoadedProgram::load(sample_bytes(), "x.swb").value();
  const auto diagnostic = describe(loaded.program(), {bytecode::TrapCode::IndexRange, 1, 7});
  EXPECT_EQ(result::to_string(diagnostic), "library.st:2: R0403: array index out of bounds in TON");
}

TEST(ProgramInfo, Variables_WhenAskedByPath_ThenAreFoundInsideInstancesAndArrays) {
  const ProgramInfo info = ProgramInfo::read(sample_bytes()).value();
  const Variable* element = info.find("main.History[3]");
  ASSERT_NE(element, nullptr);
  EXPECT_EQ(element->address, L::kMain + L::kHistory + 4);
  EXPECT_EQ(element->type, bytecode::ElementaryType::Int);
  const Variable* pump = info.find("PUMP");
  ASSERT_NE(pump, nullptr);
  EXPECT_EQ(pump->bit, 0);
  EXPECT_EQ(info.find("MAIN.timer.PT")->address, L::kMain + 2);
  EXPECT_EQ(info.find("MAIN.history[9]"), nullptr);
  EXPECT_EQ(info.find("MAIN.timer"), nullptr);
}

TEST(ProgramInfo, Variables_WhenMembersAreBits_ThenSayWhich) {
  for (const std::uint8_t bit : {std::uint8_t{0}, std::uint8_t{7}})
    EXPECT_EQ(bytecode::member_bit(bytecode::bit_member(bit)), bit);
  EXPECT_EQ(bytecode::member_bit(bytecode::kMemberHidden), bytecode::kNoBit);
  const ProgramInfo info =
      with_two_bools("f", bytecode::TypeKind::Struct, "whole", "third", bytecode::bit_member(3));
  EXPECT_EQ(info.find("f.whole")->bit, bytecode::kNoBit);
  EXPECT_EQ(info.find("f.third")->bit, 3);
  EXPECT_EQ(info.find("f.third")->address, info.find("f.whole")->address + 1);
}

TEST(ProgramInfo, Variables_WhenTheCompilerHidesThem_ThenNobodySeesThem) {
  const ProgramInfo info =
      with_two_bools("MAIN", bytecode::TypeKind::Instance, "go", "go#BEFORE", bytecode::kMemberHidden);
  ASSERT_EQ(info.tags().size(), 1u);
  EXPECT_EQ(info.tags()[0].name, "MAIN.go");
}

TEST(ProgramInfo, Charts_WhenRead_ThenHaveStepsAndLinks) {
  const ProgramInfo info = ProgramInfo::read(sample_bytes()).value();
  const ChartInfo* chart = info.chart("main");
  ASSERT_NE(chart, nullptr);
  EXPECT_TRUE(chart->steps[0].initial);
  EXPECT_EQ(chart->steps[1].comment, "(load v1 f1)");
  EXPECT_EQ(chart->transitions[1].targets, std::vector<std::uint32_t>{0});
}

// A type that nests hundreds of levels deep is valid, but no reader may follow it without end.
TEST(ProgramInfo, Types_WhenTheyNestVeryDeep_ThenReadingEnds) {
  writer::ContainerModel model = support::one_program(8, [](auto&) {});
  std::uint32_t type = model.add_type(writer::elementary(bytecode::ElementaryType::Bool));
  for (int i = 0; i < 5000; ++i) {
    type = model.add_type({.name = "T" + std::to_string(i),
                           .kind = bytecode::TypeKind::Array,
                           .size = 1,
                           .element = type,
                           .count = 1,
                           .members = {}});
  }
  model.symbols.push_back({.name = "deep", .type = type, .address = 0, .direct_address = {}});
  const auto info = ProgramInfo::read(writer::write_container(model).value());
  ASSERT_TRUE(info);
  EXPECT_FALSE(info->complete());
  // Who asks for a name learns that it may be there all the same.
  const auto unknown = resolve_name(*info, "deep");
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error()[0].hint.find("more values than can be named"), std::string::npos);
}

// Arrays of any size that a runtime takes: what lies behind them has its name, too.
TEST(ProgramInfo, Variables_WhenBehindManyOthers_ThenAreFound) {
  constexpr std::uint32_t kMany = 250'000;
  writer::ContainerModel model = support::one_program(kMany + 1, [](auto&) {});
  const std::uint32_t byte = model.add_type(writer::elementary(bytecode::ElementaryType::Byte));
  const std::uint32_t many = model.add_type({.name = "many",
                                             .kind = bytecode::TypeKind::Array,
                                             .size = kMany,
                                             .element = byte,
                                             .count = kMany,
                                             .members = {}});
  model.symbols.push_back({.name = "many", .type = many, .address = 0, .direct_address = {}});
  model.symbols.push_back({.name = "Last", .type = byte, .address = kMany, .direct_address = {}});
  const ProgramInfo info = ProgramInfo::read(writer::write_container(model).value()).value();
  EXPECT_TRUE(info.complete());
  ASSERT_NE(info.find("LAST"), nullptr);
  EXPECT_EQ(info.find("last")->address, kMany);
  ASSERT_NE(info.find("many[249999]"), nullptr);
  EXPECT_EQ(info.find("MANY[249999]")->address, kMany - 1);
  EXPECT_EQ(info.find("many[250000]"), nullptr);
}

// Upper and lower case alike; of two variables of one name the first one counts.
TEST(ProgramInfo, Variables_WhenTwoHaveOneName_ThenTheFirstIsFound) {
  writer::ContainerModel model = support::one_program(8, [](auto&) {});
  const std::uint32_t byte = model.add_type(writer::elementary(bytecode::ElementaryType::Byte));
  for (const auto& [name, address] : {std::pair{"b", 3u}, {"Same", 1u}, {"SAME", 2u}, {"a", 4u}})
    model.symbols.push_back({.name = name, .type = byte, .address = address, .direct_address = {}});
  const ProgramInfo info = ProgramInfo::read(writer::write_container(model).value()).value();
  EXPECT_EQ(info.find("same")->address, 1u);
  EXPECT_EQ(info.find("B")->address, 3u);
  EXPECT_EQ(info.find("A")->address, 4u);
  EXPECT_EQ(info.find("c"), nullptr);
}

TEST(ReadValue, Variables_WhenOfAnyElementaryType_ThenAreReadExactly) {
  using bytecode::ElementaryType;
  std::vector<std::byte> image(16);
  const auto put = [&](auto value) { std::memcpy(image.data(), &value, sizeof(value)); };
  put(std::uint64_t{0xFFFFFFFFFFFFFFFF});
  EXPECT_EQ(read_value({ElementaryType::Bool, 0}, image), Value(true));
  EXPECT_EQ(read_value({ElementaryType::Bool, 0, 3}, image), Value(true));
  EXPECT_EQ(read_value({ElementaryType::Bool, 8, 3}, image), Value(false));
  EXPECT_EQ(read_value({ElementaryType::Sint, 0}, image), Value(std::int64_t{-1}));
  EXPECT_EQ(read_value({ElementaryType::Byte, 0}, image), Value(std::uint64_t{255}));
  EXPECT_EQ(read_value({ElementaryType::Int, 0}, image), Value(std::int64_t{-1}));
  EXPECT_EQ(read_value({ElementaryType::Word, 0}, image), Value(std::uint64_t{65535}));
  EXPECT_EQ(read_value({ElementaryType::Dint, 0}, image), Value(std::int64_t{-1}));
  EXPECT_EQ(read_value({ElementaryType::Udint, 0}, image), Value(std::uint64_t{4294967295}));
  EXPECT_EQ(read_value({ElementaryType::Time, 0}, image), Value(std::int64_t{-1}));
  EXPECT_EQ(read_value({ElementaryType::Ulint, 0}, image), Value(std::uint64_t{0xFFFFFFFFFFFFFFFF}));
  put(0.1f);
  EXPECT_EQ(read_value({ElementaryType::Real, 0}, image), Value(0.1));
  put(0.1);
  EXPECT_EQ(read_value({ElementaryType::Lreal, 0}, image), Value(0.1));
}

TEST(ReadText, Values_WhenRead_ThenAreWrittenAsLiterals) {
  using bytecode::ElementaryType;
  std::vector<std::byte> image(16);
  const auto put = [&](auto value) { std::memcpy(image.data(), &value, sizeof(value)); };
  put(std::int64_t{1'500'000'000});
  EXPECT_EQ(read_text({ElementaryType::Time, 0}, image), "T#1s500ms");
  EXPECT_EQ(read_text({ElementaryType::Date, 0}, image), "D#1970-01-01");
  EXPECT_EQ(read_text({ElementaryType::Tod, 0}, image), "TOD#00:00:01.5");
  EXPECT_EQ(read_text({ElementaryType::Dt, 0}, image), "DT#1970-01-01-00:00:01.5");
  EXPECT_EQ(read_text({ElementaryType::Bool, 8}, image), "FALSE");
  put(0.1f);
  EXPECT_EQ(read_text({ElementaryType::Real, 0}, image), "0.1");
  const char narrow[] = {4, 0, 2, 0, 'a', '\xE4'};
  put(std::to_array(narrow));
  EXPECT_EQ(read_text({ElementaryType::String, 0}, image), "a\xC3\xA4");
  const std::uint16_t wide[] = {4, 4, 0x20AC, 0xD83D, 0xDE00, 0xD83D};
  put(std::to_array(wide));
  EXPECT_EQ(read_text({ElementaryType::Wstring, 0}, image), "\xE2\x82\xAC\xF0\x9F\x98\x80\xEF\xBF\xBD");
}

TEST(ReadText, String_WhenItsHeaderLies_ThenIsCutToTheImage) {
  using bytecode::ElementaryType;
  const std::vector<std::byte> image(7, std::byte{0x41});
  EXPECT_EQ(read_value({ElementaryType::String, 0}, image), Value(std::string("AAA")));
  EXPECT_EQ(read_value({ElementaryType::Wstring, 0}, image), Value(std::string("\xE4\x85\x81")));
  EXPECT_EQ(read_value({ElementaryType::String, 5}, image), Value(std::string()));
  EXPECT_EQ(read_number({ElementaryType::String, 0}, image), 0.0);
}

TEST(ProgramInfo, Types_WhenNewKinds_ThenGiveNamesBoundsAndTriggers) {
  using bytecode::ElementaryType;
  using bytecode::TypeKind;
  writer::ContainerModel model = support::one_program(16, [](auto&) {});
  const auto boolean = model.add_type(writer::elementary(ElementaryType::Bool));
  const auto text = model.add_type(writer::string_type(ElementaryType::String, 4));
  const auto colour = model.add_type({.name = "COLOUR",
                                      .kind = TypeKind::Enumeration,
                                      .elementary = ElementaryType::Int,
                                      .size = 2,
                                      .members = {{"RED", 0, 0}, {"GREEN", 0, 0xFFFFFFFF}}});
  const auto pointer =
      model.add_type({.name = "P", .kind = TypeKind::Reference, .size = 4, .element = text, .members = {}});
  model.symbols = {{.name = "colour", .type = colour, .address = 0, .direct_address = {}},
                   {.name = "text", .type = text, .address = 2, .direct_address = {}},
                   {.name = "p", .type = pointer, .address = 10, .direct_address = {}},
                   {.name = "go", .type = boolean, .address = 14, .direct_address = {}}};
  model.tasks.push_back({.name = "event", .interval_us = 0, .priority = 0, .calls = {}, .trigger = 3});
  const ProgramInfo info = ProgramInfo::read(writer::write_container(model).value()).value();
  std::vector<std::byte> image(16);
  image[0] = image[1] = std::byte{0xFF};
  EXPECT_EQ(read_text(*info.find("colour"), image), "GREEN");
  EXPECT_EQ(read_value(*info.find("colour"), image), Value(std::int64_t{-1}));
  image[0] = image[1] = std::byte{7};
  EXPECT_EQ(read_text(*info.find("colour"), image), "1799");
  EXPECT_EQ(info.find("text")->type, ElementaryType::String);
  EXPECT_EQ(info.find("p"), nullptr);
  EXPECT_EQ(info.tasks()[1].trigger, "go");
  EXPECT_EQ(info.tasks()[0].trigger, "");
}

}  // namespace
}  // namespace stepwright::reader
