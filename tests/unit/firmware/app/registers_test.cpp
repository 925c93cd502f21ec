// Which registers may be read and written how (runtime/doc/modbus_controller.md), on raw requests.

#include "runtime/modbus/pdu/serve.h"
#include "tests/unit/firmware/app/board_test.h"

namespace stepwright::test {
namespace {

constexpr int kIllegalFunction = 1;
constexpr int kIllegalAddress = 2;
constexpr int kIllegalValue = 3;
constexpr int kBusy = 6;

Bytes read_request(int first, int count, int function = 3) {
  return bytes_of({function, first >> 8, first & 0xFF, count >> 8, count & 0xFF});
}
Bytes write_request(int first, std::initializer_list<int> words) {
  Bytes pdu = bytes_of(
      {16, first >> 8, first & 0xFF, 0, static_cast<int>(words.size()), static_cast<int>(words.size() * 2)});
  for (const int word : words) {
    pdu.push_back(static_cast<std::byte>(word >> 8));
    pdu.push_back(static_cast<std::byte>(word & 0xFF));
  }
  return pdu;
}

class RegistersTest : public BoardTest {};

TEST_F(RegistersTest, Reading_WhenWithinABlock_ThenAnswers_WhenBeyond_ThenIsRefused) {
  EXPECT_EQ(exception_of(read_request(0xF000, 78)), 0);
  EXPECT_EQ(exception_of(read_request(0xF04D, 1)), 0);
  EXPECT_EQ(exception_of(read_request(0xF000, 79)), kIllegalAddress);
  EXPECT_EQ(exception_of(read_request(0xF04E, 1)), kIllegalAddress);
  EXPECT_EQ(exception_of(read_request(0xEFFF, 2)), kIllegalAddress);
  EXPECT_EQ(exception_of(read_request(0xF190, 106)), 0);
  EXPECT_EQ(exception_of(read_request(0xF190, 107)), kIllegalAddress);
  EXPECT_EQ(exception_of(read_request(0xF280, 125)), 0);
  EXPECT_EQ(exception_of(read_request(0xF281, 125)), kIllegalAddress);
  for (const int write_only : {0xF080, 0xF100, 0xF180, 0xF200})
    EXPECT_EQ(exception_of(read_request(write_only, 1)), kIllegalAddress) << write_only;
  EXPECT_EQ(exception_of(read_request(0xF300, 1)), kIllegalAddress);
  EXPECT_EQ(exception_of(read_request(0xF000, 10, 4)), kIllegalAddress) << "no input register";
}

TEST_F(RegistersTest, Writing_WhenABlockIsNotWhole_ThenIsRefused) {
  EXPECT_EQ(exception_of(write_request(0xF080, {1})), kIllegalValue);
  EXPECT_EQ(exception_of(write_request(0xF080, {0, 0})), kIllegalValue) << "number 0";
  EXPECT_EQ(exception_of(write_request(0xF081, {0, 0})), kIllegalValue);
  EXPECT_EQ(exception_of(write_request(0xF100, {0, 0, 1})), kIllegalValue);
  EXPECT_EQ(exception_of(write_request(0xF100, {0, 0, 0, 0})), kIllegalValue);
  EXPECT_EQ(exception_of(write_request(0xF100, {0, 0, 3, 0})), kIllegalValue)
      << "three bytes in one register";
  EXPECT_EQ(exception_of(write_request(0xF180, {0, 0})), kIllegalValue);
  EXPECT_EQ(exception_of(write_request(0xF180, {3, 0, 0})), kIllegalValue) << "no such memory";
  EXPECT_EQ(exception_of(write_request(0xF180, {2, 0, 0})), 0);
  EXPECT_EQ(exception_of(write_request(0xF200, {0})), kIllegalValue) << "turn 0";
  EXPECT_EQ(exception_of(write_request(0xF200, {1})), 0);
  EXPECT_EQ(exception_of(write_request(0xF200, {1, 0})), kIllegalValue) << "more inputs than the program has";
  EXPECT_EQ(exception_of(write_request(0xF000, {1})), kIllegalAddress) << "read only";
  EXPECT_EQ(exception_of(write_request(0xF280, {1})), kIllegalAddress);
  EXPECT_EQ(exception_of(bytes_of({6, 0xF0, 0x80, 0, 1})), kIllegalValue) << "a command is written whole";
  EXPECT_EQ(exception_of(bytes_of({22, 0xF2, 0x00, 0, 1, 0, 1})), kIllegalAddress) << "FC 22";
  EXPECT_EQ(exception_of(bytes_of({8, 0, 0, 0, 0})), kIllegalFunction);
}

TEST_F(RegistersTest, ReadWrite_WhenTheReadHalfIsRefused_ThenNothingIsWritten) {
  load_and_start(kCounting, control::kStartLockStep);
  EXPECT_EQ(exception_of(bytes_of({23, 0xF3, 0, 0, 1, 0xF2, 0, 0, 1, 2, 0, 1})), kIllegalAddress);
  EXPECT_EQ(controller.status().scan, 0u);
  EXPECT_EQ(exception_of(bytes_of({23, 0xF2, 0x80, 0, 1, 0xF2, 0, 0, 1, 2, 0, 1})), 0);
  EXPECT_EQ(controller.status().scan, 1u);
}

TEST_F(RegistersTest, Window_WhenBeyondTheMemory_ThenReadsZeros) {
  controller.download(compiled(kCounting));
  const auto size = controller.status().program_bytes;
  ASSERT_EQ(
      exception_of(write_request(0xF180, {2, static_cast<int>(size >> 16), static_cast<int>(size & 0xFFFF)})),
      0);
  const Bytes answer = line.ask(read_request(0xF196, 100));
  ASSERT_EQ(answer.size(), 202u);
  EXPECT_TRUE(std::all_of(answer.begin() + 2, answer.end(), [](std::byte b) { return b == std::byte{0}; }));
}

TEST_F(RegistersTest, Command_WhenNumberIsTheNewest_ThenIsNotCarriedOutAgain) {
  controller.download(compiled(kCounting));
  const int next = controller.status().command_number + 1;
  EXPECT_EQ(exception_of(write_request(0xF080, {next, 1, 1})), 0);
  EXPECT_EQ(controller.status().state, State::Running);
  EXPECT_EQ(exception_of(write_request(0xF080, {next, 2})), 0) << "a repetition, whatever it says";
  EXPECT_EQ(controller.status().state, State::Running);
  EXPECT_EQ(exception_of(write_request(0xF080, {next + 1, 2})), 0);
  EXPECT_EQ(controller.status().state, State::Stopped);
}

TEST_F(RegistersTest, Command_WhenOneIsUnderWay_ThenTheNextIsBusy) {
  app::Slave slave(board.controller());
  std::array<std::byte, modbus::pdu::kMaxPdu> answer;
  const auto ask = [&](const Bytes& pdu) {
    static_cast<void>(modbus::pdu::serve(slave, pdu, answer));
    return (std::to_integer<int>(answer[0]) & 0x80) != 0 ? std::to_integer<int>(answer[1]) : 0;
  };
  EXPECT_EQ(ask(write_request(0xF080, {1, 0})), 0);
  EXPECT_EQ(ask(write_request(0xF080, {2, 0})), kBusy);
  EXPECT_EQ(ask(write_request(0xF080, {1, 0})), 0) << "a repetition of the one under way";
  board.run_ms(1);
  EXPECT_EQ(controller.status().command_number, 1);
  EXPECT_EQ(ask(write_request(0xF080, {2, 0})), 0);
}

TEST_F(RegistersTest, Command_WhenUnknownOrShort_ThenIsRefusedWithItsReason) {
  EXPECT_EQ(controller.command(static_cast<Command>(99)).refusal, Refusal::UnknownCommand);
  EXPECT_EQ(controller.command(Command::Start).refusal, Refusal::BadArguments);
  EXPECT_EQ(controller.command(Command::TransferBegin, {0, 100}).refusal, Refusal::BadArguments);
  EXPECT_EQ(controller.command(Command::Force, {0, 0}).refusal, Refusal::BadArguments);
  EXPECT_TRUE(controller.command(Command::Nothing).done());
  controller.download(compiled(kCounting));
  controller.start(1);
  EXPECT_EQ(controller.command(Command::Start, {1}).refusal, Refusal::AlreadyRunning);
}

TEST_F(RegistersTest, Identification_WhenAsked_ThenNamesTheBoard) {
  const Bytes answer = line.ask(bytes_of({43, 14, 4, 1}));
  const std::string text(reinterpret_cast<const char*>(answer.data()), answer.size());
  EXPECT_NE(text.find("test board"), std::string::npos);
}

}  // namespace
}  // namespace stepwright::test
