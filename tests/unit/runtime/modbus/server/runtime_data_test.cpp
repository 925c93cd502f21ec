// The values of a runtime: its snapshot, its service, its absence.

#include "runtime/modbus/server/runtime_data.h"

#include "ladder/driver/compile.h"
#include "runtime/bytecode/reader/program_info.h"
#include "runtime/bytecode/reader/read_value.h"
#include "runtime/modbus/pdu/answer.h"
#include "tests/unit/runtime/modbus/server/server_harness.h"
#include "tests/unit/runtime/service/service_harness.h"

namespace stepwright::modbus::server {
namespace {

using pdu::Exception;

std::vector<std::byte> compiled(const std::string& source) {
  driver::CompileInput input;
  input.texts.push_back({"test.st", source});
  return std::move(driver::compile(input)->container);
}

// Which copies a wish, so that a write is seen to be in the image of a scan.
std::vector<std::byte> program(const std::string& more = {}) {
  return compiled(
      "PROGRAM Main VAR wish AT %MW0 : INT; copy AT %MW1 : INT; pair AT %MD1 : DINT; lamp AT %QX0.1 : BOOL;" +
      more + " END_VAR copy := wish; END_PROGRAM");
}

const Bytes kWish = bytes({6, 4, 0, 0x12, 0x34});  // %MW0

class RuntimeDataTest : public testing::Test {
 protected:
  RuntimeDataTest() : runtime_(std::make_unique<service::ServiceHarness>()) {
    options_.socket = runtime_->socket();
    options_.map.openplc_writable = true;
    options_.writes = true;
    load(program());
    data_ = std::move(*RuntimeData::create(options_, [](const char*, const std::string&, const auto&) {}));
    await(true);
  }

  void load(const std::vector<std::byte>& container) {
    const auto operate = runtime_->connect();
    const auto loaded = operate->download(container, service::kPatience);
    ASSERT_TRUE(loaded) << result::to_string(loaded.error());
  }
  void await(bool serving) {
    for (int i = 0; i < 2'000 && data_->serving() != serving; ++i) std::this_thread::sleep_for(5ms);
    ASSERT_EQ(data_->serving(), serving);
  }
  // "0012 0000", or the exception.
  std::string read(const Bytes& pdu) {
    const pdu::Request request = pdu::parse(pdu).request;
    Bytes table(pdu::table_bytes(request));
    const Exception exception = data_->read(request, table);
    return exception == Exception::None ? hex(table)
                                        : "exception " + std::to_string(static_cast<int>(exception));
  }
  Exception write(const Bytes& pdu) {
    const Exception begun = data_->begin_write(++ticket_, pdu::parse(pdu).request);
    return begun == Exception::None ? written() : begun;
  }
  Exception written() {
    for (int i = 0; i < 2'000; ++i) {
      data_->clear();
      if (const auto done = data_->take_written()) {
        EXPECT_EQ(done->ticket, ticket_);
        return done->exception;
      }
      std::this_thread::sleep_for(5ms);
    }
    return Exception::Acknowledge;
  }

  std::unique_ptr<service::ServiceHarness> runtime_;
  RuntimeDataOptions options_;
  std::unique_ptr<RuntimeData> data_;
  std::uint64_t ticket_ = 0;
};

TEST_F(RuntimeDataTest, WhenWritten_ThenTheNextReadShowsIt) {
  for (unsigned i = 1; i <= 100; ++i) {
    ASSERT_EQ(write(bytes({6, 4, 0, 0x12, i})), Exception::None);
    ASSERT_EQ(read(bytes({3, 4, 0, 0, 1})), hex(bytes({0x12, i})));
  }
  EXPECT_EQ(write(bytes({16, 8, 2, 0, 2, 4, 1, 2, 3, 4})), Exception::None);  // %MD1
  EXPECT_EQ(read(bytes({3, 4, 2, 0, 2})), "03 04 01 02");                     // %MW2, %MW3
  EXPECT_EQ(write(bytes({5, 0, 1, 0xFF, 0})), Exception::None);
  EXPECT_EQ(read(bytes({1, 0, 0, 0, 3})), "02");
  EXPECT_EQ(write(bytes({22, 4, 0, 0xFF, 0x00, 0, 0x34})), Exception::None);
  EXPECT_EQ(read(bytes({3, 4, 0, 0, 1})), "12 34");
  EXPECT_EQ(write(bytes({22, 4, 0, 0xFF, 0xFF, 0, 0})), Exception::None) << "a mask that changes nothing";
}

TEST_F(RuntimeDataTest, WhenReadAndWrittenInOne_ThenTheReadComesAfterTheWrite) {
  const Bytes both = bytes({23, 4, 0, 0, 2, 4, 0, 0, 1, 2, 0x55, 0x66});
  EXPECT_EQ(write(both), Exception::None);
  EXPECT_EQ(read(both).substr(0, 5), "55 66");
  EXPECT_EQ(write(bytes({23, 0xF0, 0, 0, 2, 4, 0, 0, 1, 2, 0x77, 0x77})), Exception::IllegalDataAddress);
  EXPECT_EQ(read(both).substr(0, 5), "55 66");
}

TEST_F(RuntimeDataTest, WhenTheProgramChanges_ThenItsMapIsServed) {
  ASSERT_EQ(write(bytes({6, 4, 0, 0, 7})), Exception::None);
  EXPECT_EQ(read(bytes({3, 4, 40, 0, 1})), "00 00");
  EXPECT_EQ(write(bytes({6, 4, 40, 0, 1})), Exception::IllegalDataAddress) << "the program has no %MW40";
  load(program("far AT %MW40 : INT := 9;"));
  for (int i = 0; i < 2'000 && read(bytes({3, 4, 40, 0, 1})) != "00 09"; ++i)
    std::this_thread::sleep_for(5ms);
  EXPECT_EQ(read(bytes({3, 4, 40, 0, 1})), "00 09");
  EXPECT_EQ(write(bytes({6, 4, 40, 0, 1})), Exception::None);
}

// The meaning of a write is its address in the map that it was looked up in. Where the next program comes
// first the client is told so, and no place of that program is written to by the map of another one.
TEST_F(RuntimeDataTest, WhenWrittenBesideDownloads_ThenNoForeignPlaceIsWritten) {
  // `wish` lies elsewhere in this one's image.
  const auto other = compiled(
      "PROGRAM Main VAR lamp AT %QX0.1 : BOOL; far AT %QW9 : INT; keep AT %MD5 : DINT; copy AT %MW1 : INT;"
      " wish AT %MW0 : INT; END_VAR copy := wish; END_PROGRAM");
  const auto info = *reader::ProgramInfo::read(other);
  ASSERT_NE(info.find("main.wish")->address,
            reader::ProgramInfo::read(program())->find("main.wish")->address);
  int refused = 0;
  for (int round = 0; round < 20; ++round) {
    load(program());
    for (int i = 0; i < 2'000 && read(bytes({1, 0, 1, 0, 1})) == "exception 4"; ++i)
      std::this_thread::sleep_for(5ms);
    const Exception early =
        round % 2 == 0 ? data_->begin_write(++ticket_, pdu::parse(kWish).request) : Exception::Acknowledge;
    load(other);
    if (round % 2 != 0) {
      refused += write(kWish) == Exception::None ? 0 : 1;
    } else {
      refused += early == Exception::None && written() == Exception::None ? 0 : 1;
    }
    const auto image = runtime_->connect()->snapshot()->image;
    for (const char* name : {"main.far", "main.keep", "main.lamp"}) {
      const auto variable = *info.find(name);
      EXPECT_EQ(reader::read_number(variable, image), 0.0) << name << " in round " << round;
    }
  }
  RecordProperty("refused", refused);
}

TEST_F(RuntimeDataTest, WhenTheRuntimeEnds_ThenException4AndTheNextOneIsFound) {
  const auto socket = options_.socket;
  runtime_->end();
  await(false);
  EXPECT_EQ(read(bytes({3, 4, 0, 0, 1})), "exception 4");
  EXPECT_EQ(write(bytes({6, 4, 0, 0, 1})), Exception::DeviceFailure);
}

TEST_F(RuntimeDataTest, WhenWritesAreNotWanted_ThenItAttendsAsAnObserver) {
  options_.writes = false;
  data_ = std::move(*RuntimeData::create(options_, [](const char*, const std::string&, const auto&) {}));
  await(true);
  EXPECT_EQ(read(bytes({3, 4, 0, 0, 1})), "00 00");
  EXPECT_EQ(write(bytes({6, 4, 0, 0, 1})), Exception::DeviceFailure);
}

TEST_F(RuntimeDataTest, WhenTheSnapshotStandsStillInRealTime_ThenException4) {
  // The harness's clock is simulated and nothing runs: nothing is published any more.
  options_.real_time = true;
  options_.stale_after = 300ms;
  data_ = std::move(*RuntimeData::create(options_, [](const char*, const std::string&, const auto&) {}));
  await(true);
  await(false);
  EXPECT_EQ(read(bytes({3, 4, 0, 0, 1})), "exception 4");
}

}  // namespace
}  // namespace stepwright::modbus::server
