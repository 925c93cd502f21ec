// A runtime that is there and is of no use: what becomes of the writes, and of the log.

#include "ladder/driver/compile.h"
#include "runtime/modbus/server/runtime_data.h"
#include "runtime/service/digest.h"
#include "tests/unit/runtime/modbus/server/deaf_runtime.h"
#include "tests/unit/runtime/modbus/server/server_harness.h"

namespace stepwright::modbus::server {
namespace {

using pdu::Exception;

std::vector<std::byte> program() {
  driver::CompileInput input;
  input.texts.push_back(
      {"test.st", "PROGRAM Main VAR wish AT %MW0 : INT; END_VAR wish := wish; END_PROGRAM"});
  return std::move(driver::compile(input)->container);
}

class RuntimeTrouble : public testing::Test {
 protected:
  void begin(std::vector<std::byte> container, std::chrono::milliseconds write_timeout) {
    std::string digest = service::to_hex(service::sha256(container));
    runtime_ = std::make_unique<DeafRuntime>(std::move(container), std::move(digest));
    RuntimeDataOptions options;
    options.socket = runtime_->socket();
    options.map.openplc_writable = true;
    options.writes = true;
    options.write_timeout = write_timeout;
    data_ =
        std::move(*RuntimeData::create(options, [this](const char* kind, const std::string&, const auto&) {
          if (std::string(kind) == "refused") ++refused_;
        }));
  }
  void await_program() {
    for (int i = 0; i < 2'000 && !data_->serving(); ++i) std::this_thread::sleep_for(5ms);
    ASSERT_TRUE(data_->serving());
  }
  Exception write(std::uint64_t ticket) {
    return data_->begin_write(ticket, pdu::parse(bytes({6, 4, 0, 0, 7})).request);
  }
  // How many are answered within so long.
  std::size_t answered(std::size_t wanted, std::chrono::milliseconds patience) {
    const auto deadline = Clock::now() + patience;
    std::size_t count = 0;
    while (count < wanted && Clock::now() < deadline) {
      data_->clear();
      while (const auto done = data_->take_written()) {
        // Busy: sent after others were late, when the runtime still had as many as it takes.
        wrong_ += done->exception != Exception::DeviceFailure && done->exception != Exception::DeviceBusy;
        ++count;
      }
      std::this_thread::sleep_for(5ms);
    }
    return count;
  }

  std::unique_ptr<DeafRuntime> runtime_;
  std::atomic<int> refused_{0};
  int wrong_ = 0;  // answers that say that something was written
  std::unique_ptr<RuntimeData> data_;
};

TEST_F(RuntimeTrouble, WhenManyWritesWait_ThenEachIsAnsweredWithinItsTime) {
  constexpr auto kTimeout = 2'000ms;
  begin(program(), kTimeout);
  await_program();
  // A hundred times what the runtime is sent at once: those behind must not wait for their turn to be late.
  constexpr std::size_t kWrites = 6'400;
  const auto began = Clock::now();
  for (std::uint64_t i = 1; i <= kWrites; ++i) ASSERT_EQ(write(i), Exception::None);
  std::this_thread::sleep_for(200ms);
  const int sent = runtime_->port.writes;
  // Once the first have had their time, those behind them are sent as long as they have some left.
  if (Clock::now() - began < kTimeout) {
    EXPECT_LE(sent, 64);
  }
  // Counted from the sending it would be a hundred times the time-out.
  EXPECT_EQ(answered(kWrites, 100'000ms), kWrites);
  EXPECT_EQ(wrong_, 0);
}

TEST_F(RuntimeTrouble, WhenMoreWritesWaitThanThereAreClients_ThenTheNextIsRefused) {
  begin(program(), 60'000ms);
  await_program();
  std::uint64_t taken = 0;
  Exception last = Exception::None;
  while (last == Exception::None && taken < 50'000) {
    last = write(taken + 1);
    if (last == Exception::None) ++taken;
  }
  EXPECT_EQ(last, Exception::DeviceBusy);
  EXPECT_GE(taken, 10'000u);
  EXPECT_LT(taken, 20'000u);
}

TEST_F(RuntimeTrouble, WhenItsProgramCannotBeRead_ThenItIsToldOnceAndNotFetchedAgain) {
  begin(std::vector<std::byte>(100, std::byte{0x5A}), 1'000ms);
  for (int i = 0; i < 2'000 && refused_ == 0; ++i) std::this_thread::sleep_for(5ms);
  ASSERT_EQ(refused_, 1);
  const int fetched = runtime_->port.fetched;
  std::this_thread::sleep_for(600ms);  // several statuses
  EXPECT_EQ(refused_, 1);
  EXPECT_EQ(runtime_->port.fetched, fetched);
  EXPECT_EQ(write(1), Exception::DeviceFailure);
}

}  // namespace
}  // namespace stepwright::modbus::server
