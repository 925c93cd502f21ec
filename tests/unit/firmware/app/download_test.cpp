#include "tests/support/step_program.h"
#include "tests/unit/firmware/app/board_test.h"

namespace stepwright::test {
namespace {

class DownloadTest : public BoardTest {};

TEST_F(DownloadTest, Download_WhenWhole_ThenIsLoadedAndOutlivesAReset) {
  const Bytes container = compiled(kCounting);
  EXPECT_EQ(controller.status().state, State::Empty);
  controller.download(container);
  const auto status = controller.status();
  EXPECT_EQ(status.state, State::Stopped);
  EXPECT_EQ(status.digest, storage::sha256(container));
  EXPECT_EQ(status.program_bytes, container.size());
  EXPECT_EQ(controller.memory(control::Memory::Program, container.size()), container);
  board.reset();
  EXPECT_EQ(controller.status().digest, storage::sha256(container));
  EXPECT_EQ(controller.status().state, State::Stopped);
}

TEST_F(DownloadTest, Pieces_WhenRepeated_ThenAreIgnored_WhenOneIsMissing_ThenAreRefused) {
  const Bytes container = compiled(kCounting);
  controller.send(container);
  const auto again = std::span(container).subspan(240, 240);
  EXPECT_TRUE(controller.link().send_piece(240, again)) << "a lost answer";
  EXPECT_FALSE(controller.link().send_piece(static_cast<std::uint32_t>(container.size()), again))
      << "beyond the end";
  EXPECT_TRUE(controller.command(Command::TransferCommit).done());
  std::vector<std::uint16_t> begin(18);
  control::put32(begin, 0, 1000);
  controller.expect_done(Command::TransferBegin, begin);
  EXPECT_FALSE(controller.link().send_piece(240, again)) << "a gap";
  EXPECT_EQ(controller.status().flags & control::kTransferring, control::kTransferring);
  controller.expect_done(Command::TransferAbort);
  EXPECT_FALSE(controller.link().send_piece(0, again)) << "no transfer";
}

TEST_F(DownloadTest, Commit_WhenSomethingIsWrong_ThenSaysWhatAndLeavesWhatRuns) {
  load_and_start(kCounting, control::kStartLockStep);
  const auto before = controller.status();
  const Bytes other = compiled(kDividing);

  std::vector<std::uint16_t> begin(18);
  control::put32(begin, 0, 480);
  controller.expect_done(Command::TransferBegin, begin);
  ASSERT_TRUE(controller.link().send_piece(0, std::span(other).first(240)));
  const auto incomplete = controller.command(Command::TransferCommit);
  EXPECT_EQ(incomplete.refusal, Refusal::Incomplete);
  EXPECT_EQ(incomplete.detail, 240u);
  ASSERT_TRUE(controller.link().send_piece(240, std::span(other).subspan(240, 240)));
  EXPECT_EQ(controller.command(Command::TransferCommit).refusal, Refusal::WrongDigest);

  Bytes broken = other;
  broken[broken.size() / 2] ^= std::byte{1};
  controller.send(broken);
  const auto unverified = controller.command(Command::TransferCommit);
  EXPECT_EQ(unverified.refusal, Refusal::NotVerified);
  EXPECT_EQ(unverified.detail, static_cast<std::uint32_t>(bytecode::VerifyStatus::BadChecksum));

  control::put32(begin, 0, 100'000'000);
  const auto large = controller.command(Command::TransferBegin, begin);
  EXPECT_EQ(large.refusal, Refusal::TooLarge);
  EXPECT_EQ(large.detail, controller.status().max_program_bytes);

  EXPECT_EQ(controller.status().state, State::Running);
  EXPECT_EQ(controller.status().digest, before.digest);
  board.reset();
  EXPECT_EQ(controller.status().digest, before.digest);
}

TEST_F(DownloadTest, Commit_WhenProgramNeedsWhatIsLacking_ThenSaysWhich) {
  const auto refused = [&](const std::string& variable) {
    controller.send(compiled("PROGRAM main VAR " + variable + " END_VAR END_PROGRAM"));
    const auto answer = controller.command(Command::TransferCommit);
    EXPECT_EQ(answer.refusal, Refusal::NotSupported) << variable;
    return static_cast<app::Lacking>(answer.detail);
  };
  EXPECT_EQ(refused("x AT %IB240 : BYTE;"), app::Lacking::InputBytes);
  EXPECT_EQ(refused("x AT %QB210 : BYTE;"), app::Lacking::OutputBytes);
  EXPECT_EQ(refused("END_VAR VAR RETAIN x : ARRAY[0..70000] OF BYTE;"), app::Lacking::RetainBytes);
}

TEST(SmallBoard, Commit_WhenMemoryIsTooSmall_ThenSaysSo) {
  TestBoard board(64 * 1024);
  BoardLine line(board);
  support::RemoteController controller(line);
  const auto refused = [&](const std::string& program) {
    controller.send(compiled(program));
    const auto answer = controller.command(Command::TransferCommit);
    EXPECT_EQ(answer.refusal, Refusal::NotSupported);
    return static_cast<app::Lacking>(answer.detail);
  };
  EXPECT_EQ(refused("PROGRAM main VAR x : ARRAY[0..39999] OF BYTE; END_VAR END_PROGRAM"),
            app::Lacking::Memory)
      << "the image and its copy";
  std::string code;
  for (int i = 0; i < 500; ++i) code += "x := x + 1;\n";
  EXPECT_EQ(refused("PROGRAM main VAR x : DINT; END_VAR " + code + "END_PROGRAM"), app::Lacking::Scratch);
}

TEST_F(DownloadTest, Download_WhenAProgramRuns_ThenItIsStoppedAndScansGoOnCounting) {
  load_and_start(kCounting, control::kStartLockStep);
  controller.turn(bytes_of({1}));
  const auto before = controller.turn(bytes_of({255}));
  EXPECT_NE(before.outputs[0], std::byte{0});
  controller.download(compiled(kDividing));
  const auto status = controller.status();
  EXPECT_EQ(status.state, State::Stopped);
  EXPECT_EQ(status.scan, 2u);
  EXPECT_EQ(status.event_kind, control::Event::Stopped);
  controller.start_lock_step();
  const auto after = controller.turn(bytes_of({5}));
  EXPECT_EQ(after.head.scan, 3u);
  EXPECT_EQ(after.head.time_ns, before.head.next_ns);
}

TEST_F(DownloadTest, Boot_WhenNewestSlotIsBroken_ThenLoadsTheOneBefore) {
  const Bytes first = compiled(kCounting);
  controller.download(first);
  controller.download(compiled(kDividing));
  const auto stored = board.machine().container();
  board.flash_memory()[static_cast<std::size_t>(stored.data() - board.flash_memory().data()) + 100] ^=
      std::byte{1};
  board.reset();
  EXPECT_EQ(controller.status().digest, storage::sha256(first));
  controller.download(compiled(kEndless));
  EXPECT_EQ(controller.status().state, State::Stopped) << "the broken slot is written again";
}

TEST_F(DownloadTest, Boot_WhenProgramHasBeenOverwrittenByNoise_ThenIsEmpty) {
  controller.download(compiled(kCounting));
  for (std::byte& byte : board.flash_memory()) byte = static_cast<std::byte>(0xA5);
  board.reset();
  EXPECT_EQ(controller.status().state, State::Empty);
  EXPECT_EQ(controller.command(Command::Start, {1}).refusal, Refusal::NoProgram);
  EXPECT_EQ(controller.command(Command::Stop).refusal, Refusal::NoProgram);
}

}  // namespace
}  // namespace stepwright::test
