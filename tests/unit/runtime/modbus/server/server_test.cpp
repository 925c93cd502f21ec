// Requests and answers over TCP: pieces, pipelines, order, rights.

#include "tests/unit/runtime/modbus/server/server_harness.h"

namespace stepwright::modbus::server {
namespace {

const Bytes kRead = bytes({3, 0, 1, 0, 1});
const Bytes kWrite = bytes({6, 0, 1, 0xAB, 0xCD});

TEST(Server, WhenAsked_ThenTheAnswerHasTransactionAndUnit) {
  ServerHarness harness;
  harness.data.tables.holding[1] = 0x1234;
  const Client client = harness.client();
  EXPECT_EQ(client.ask(frame(0xABCD, kRead, 17), 11), "ab cd 00 00 00 05 11 03 02 12 34");
  EXPECT_EQ(client.ask(frame(2, kWrite), 12), "00 02 00 00 00 06 01 06 00 01 ab cd");
  EXPECT_EQ(client.ask(frame(3, kRead), 11), "00 03 00 00 00 05 01 03 02 ab cd");
  EXPECT_EQ(client.ask(frame(4, bytes({1, 0, 0, 0, 3})), 10), "00 04 00 00 00 04 01 01 01 00");
}

TEST(Server, WhenAFrameComesByteByByte_ThenItIsAnsweredAtItsEnd) {
  ServerHarness harness;
  const Client client = harness.client();
  const Client other = harness.client();
  const Bytes request = frame(7, kRead);
  for (std::size_t i = 0; i < request.size(); ++i) {
    client.send(Bytes{request[i]});
    // somebody else is served while half a frame is there
    EXPECT_EQ(other.ask(frame(static_cast<unsigned>(i), kRead), 11).size(), 32u);
  }
  EXPECT_EQ(client.receive(11), "00 07 00 00 00 05 01 03 02 00 00");
}

TEST(Server, WhenManyRequestsComeAtOnce_ThenAllAreAnsweredInOrder) {
  ServerHarness harness;
  const Client client = harness.client();
  constexpr unsigned kMany = 2'000;  // more than both buffers hold
  std::thread sender([&] {
    Bytes all;
    for (unsigned i = 0; i < kMany; ++i)
      all = std::move(all) + frame(i, i % 50 == 49 ? bytes({6, 0, 1, i >> 8, i & 0xFF}) : kRead);
    client.send(all);
  });
  for (unsigned i = 0; i < kMany; ++i) {
    const bool write = i % 50 == 49;
    const std::string answer = client.receive(write ? 12 : 11);
    const unsigned value = i < 49 ? 0 : write ? i : (i + 1) / 50 * 50 - 1;
    ASSERT_EQ(answer.substr(0, 5), hex(bytes({i >> 8, i & 0xFF})));
    ASSERT_EQ(answer.substr(answer.size() - 5), hex(bytes({value >> 8, value & 0xFF}))) << i;
  }
  sender.join();
}

TEST(Server, WhenAWriteIsUnderWay_ThenItsClientWaitsAndOthersDoNot) {
  ServerHarness harness;
  harness.data.at_once = false;
  const Client writer = harness.client();
  const Client reader = harness.client();
  writer.send(frame(1, kWrite) + frame(2, kRead));
  EXPECT_EQ(writer.receive(1, 50ms), "");
  EXPECT_EQ(reader.ask(frame(3, kRead), 11).substr(0, 5), "00 03");
  harness.data.finish_one();
  EXPECT_EQ(writer.receive(23), "00 01 00 00 00 06 01 06 00 01 ab cd 00 02 00 00 00 05 01 03 02 ab cd");
}

TEST(Server, WhenMoreWaitsBehindAWriteThanTheBufferHolds_ThenTheServerSleeps) {
  ServerHarness harness;
  harness.data.at_once = false;
  const Client client = harness.client();
  Bytes all = frame(0, kWrite);
  for (unsigned i = 1; i <= 500; ++i) all = std::move(all) + frame(i, kRead);
  client.send(all);
  std::this_thread::sleep_for(50ms);
  const auto used_s = [] {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) / 1e9;
  };
  const double before_s = used_s();
  std::this_thread::sleep_for(300ms);
  EXPECT_LT(used_s() - before_s, 0.1);
  harness.data.finish_one();
  EXPECT_EQ(client.receive(12).substr(0, 5), "00 00");
  for (unsigned i = 1; i <= 500; ++i)
    ASSERT_EQ(client.receive(11).substr(0, 5), hex(bytes({i >> 8, i & 0xFF})));
}

TEST(Server, WhenAClientLeavesDuringItsWrite_ThenTheNextOneGetsItsOwnAnswerOnly) {
  ServerHarness harness;
  harness.data.at_once = false;
  {
    Client writer = harness.client();
    writer.send(frame(1, kWrite));
    while (harness.data.begun < 1) std::this_thread::sleep_for(1ms);
    const linger reset{1, 0};
    setsockopt(writer.descriptor(), SOL_SOCKET, SO_LINGER, &reset, sizeof reset);
  }
  std::this_thread::sleep_for(50ms);
  const Client next = harness.client();
  next.send(frame(9, bytes({6, 0, 2, 0, 5})));
  while (harness.data.begun < 2) std::this_thread::sleep_for(1ms);
  harness.data.finish_one();  // of the one that left
  EXPECT_EQ(next.receive(1, 50ms), "");
  harness.data.finish_one();
  EXPECT_EQ(next.receive(12), "00 09 00 00 00 06 01 06 00 02 00 05");
}

TEST(Server, WhenTheControllerIsAway_ThenException4) {
  ServerHarness harness;
  const Client client = harness.client();
  harness.data.away = true;
  EXPECT_EQ(client.ask(frame(1, kRead), 9), "00 01 00 00 00 03 01 83 04");
  EXPECT_EQ(client.ask(frame(1, kWrite), 9), "00 01 00 00 00 03 01 86 04");
  harness.data.away = false;
  EXPECT_EQ(client.ask(frame(1, kRead), 11).substr(21, 2), "03");
}

TEST(Server, WhenAClientOnlyEndsSending_ThenItGetsItsAnswers) {
  ServerHarness harness;
  const Client client = harness.client();
  client.send(frame(1, kRead) + frame(2, kWrite));
  client.end_sending();
  EXPECT_EQ(client.receive(100),
            "00 01 00 00 00 05 01 03 02 00 00 00 02 00 00 00 06 01 06 00 01 ab cd closed");
}

TEST(Server, WhenTheStreamIsNoModbus_ThenThatConnectionEnds) {
  ServerHarness harness;
  const Client other = harness.client();
  for (const Bytes& wrong : {bytes({0, 1, 0, 1, 0, 6, 1, 3, 0, 1, 0, 1}), bytes({0, 1, 0, 0, 0, 1, 1}),
                             bytes({0, 1, 0, 0, 1, 11, 1}), bytes({'G', 'E', 'T', ' ', '/', ' '})}) {
    const Client client = harness.client();
    EXPECT_EQ(client.ask(wrong, 1), "closed");
  }
  EXPECT_EQ(other.ask(frame(1, kRead), 11).substr(21, 2), "03");
  harness.stop();
  EXPECT_EQ(harness.server->figures().malformed, 4u);
}

TEST(Server, WhenMalformedOrDenied_ThenItsException) {
  ServerOptions options;
  ClientRule rule;
  rule.read = {{map::Table::HoldingRegisters, 0, 9}};
  rule.write = {{map::Table::HoldingRegisters, 5, 5}};
  options.clients.push_back(rule);
  ServerHarness harness(options);
  const Client client = harness.client();
  const auto code = [&](const Bytes& pdu) { return client.ask(frame(1, pdu), 9).substr(21); };
  EXPECT_EQ(code(bytes({7})), "87 01");
  EXPECT_EQ(code(bytes({3, 0, 0, 0, 0})), "83 03");
  EXPECT_EQ(code(bytes({3, 0, 9, 0, 2})), "83 02");
  EXPECT_EQ(code(bytes({1, 0, 0, 0, 1})), "81 02");
  EXPECT_EQ(code(bytes({6, 0, 4, 0, 1})), "86 02");
  EXPECT_EQ(code(bytes({23, 0, 0, 0, 1, 0, 6, 0, 1, 2, 0, 1})), "97 02");
  EXPECT_EQ(code(bytes({23, 0, 10, 0, 1, 0, 5, 0, 1, 2, 0, 1})), "97 02");
  EXPECT_EQ(client.ask(frame(1, bytes({6, 0, 5, 0, 1})), 12).substr(21, 2), "06");
  EXPECT_EQ(harness.data.tables.writes, 1);
}

// One register too many for any frame: the request is refused like any other, and the next one is answered.
TEST(Server, WhenARequestIsLongerThanTheProtocolHasIt_ThenException3AndTheConnectionStays) {
  ServerHarness harness;
  const Client client = harness.client();
  Bytes write = bytes({16, 0, 0, 0, 124, 248});
  write.resize(6 + 248);
  Bytes read_write = bytes({23, 0, 0, 0, 1, 0, 0, 0, 122, 244});
  read_write.resize(10 + 244);
  EXPECT_EQ(client.ask(frame(1, write), 9), "00 01 00 00 00 03 01 90 03");
  EXPECT_EQ(client.ask(frame(2, read_write), 9), "00 02 00 00 00 03 01 97 03");
  EXPECT_EQ(client.ask(frame(3, kRead), 11), "00 03 00 00 00 05 01 03 02 00 00");
}

TEST(Server, WhenTheUnitIsAnother_ThenException11OrSilence) {
  ServerOptions options;
  options.units = {5};
  ServerHarness harness(options);
  EXPECT_EQ(harness.client().ask(frame(1, kRead, 6), 9), "00 01 00 00 00 03 06 83 0b");
  EXPECT_EQ(harness.client().ask(frame(1, kRead, 5), 11).substr(21, 2), "03");
  options.answer_unknown_units = false;
  ServerHarness silent(options);
  EXPECT_EQ(silent.client().ask(frame(1, kRead, 6) + frame(2, kRead, 5), 11).substr(0, 5), "00 02");
}

TEST(Server, WhenAskedWhoItIs_ThenItSays) {
  ServerOptions options;
  options.identification = {"V", "P", "1", "", "", "", "cell"};
  ServerHarness harness(options);
  EXPECT_EQ(harness.client().ask(frame(1, bytes({43, 14, 2, 0})), 7 + 7 + 3 + 3 + 3 + 6),
            "00 01 00 00 00 17 01 2b 0e 02 82 00 00 04 00 01 56 01 01 50 02 01 31 06 04 63 65 6c 6c");
}

}  // namespace
}  // namespace stepwright::modbus::server
