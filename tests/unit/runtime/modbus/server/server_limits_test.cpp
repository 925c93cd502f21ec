// What clients must not be able to do to each other and to the server.

#include <fcntl.h>
#include <sys/resource.h>

#include "tests/unit/runtime/modbus/server/server_harness.h"

namespace stepwright::modbus::server {
namespace {

const Bytes kRead = bytes({3, 0, 1, 0, 1});
const Bytes kLong = bytes({3, 0, 0, 0, 125});

bool served(const Client& client) {
  return client.ask(frame(1, kRead), 11).substr(0, 5) == "00 01";
}

TEST(ServerLimits, WhenThereIsNoMoreRoom_ThenNewcomersAreTurnedAway) {
  ServerOptions options;
  options.max_connections = 3;
  ServerHarness harness(options);
  std::vector<Client> clients;
  for (int i = 0; i < 3; ++i) clients.push_back(harness.client());
  for (const Client& client : clients) EXPECT_TRUE(served(client));
  EXPECT_EQ(harness.client().receive(1), "closed");
  clients.pop_back();
  for (int i = 0; i < 6'000; ++i) {
    const Client next = harness.client();
    if (next.ask(frame(1, kRead), 11) != "closed") return;
    std::this_thread::sleep_for(10ms);
  }
  FAIL() << "the place that became free stayed empty";
}

TEST(ServerLimits, WhenOneAddressHasItsShare_ThenOthersStillComeIn) {
  ServerOptions options;
  options.max_per_address = 2;
  ServerHarness harness(options);
  const Client first = harness.client("127.0.0.2");
  const Client second = harness.client("127.0.0.2");
  EXPECT_TRUE(served(first) && served(second));
  EXPECT_EQ(harness.client("127.0.0.2").receive(1), "closed");
  EXPECT_TRUE(served(harness.client("127.0.0.3")));
}

TEST(ServerLimits, WhenAnAddressIsNotAllowed_ThenItIsTurnedAway) {
  TcpOptions tcp;
  tcp.allow = {*network::IpRange::parse("127.0.0.2"), *network::IpRange::parse("127.0.1.0/24")};
  ServerHarness harness({}, tcp);
  EXPECT_EQ(harness.client("127.0.0.1").receive(1), "closed");
  EXPECT_TRUE(served(harness.client("127.0.0.2")));
  EXPECT_TRUE(served(harness.client("127.0.1.77")));
  harness.stop();
  EXPECT_EQ(harness.server->figures().turned_away, 1u);
}

TEST(ServerLimits, WhenACrowdThatMayNotComeInIsAtTheAcceptor_ThenOneCallTakesSoManyAndAllAreCounted) {
  TcpOptions tcp;
  tcp.port = 0;
  tcp.allow = {*network::IpRange::parse("127.0.0.2")};
  auto acceptor = std::move(*TcpAcceptor::open(tcp));
  std::vector<Client> crowd;
  for (int i = 0; i < 3 * Listener::kMostRefused; ++i) crowd.emplace_back(acceptor->port());
  const Client welcome(acceptor->port(), "127.0.0.2");
  std::unique_ptr<Transport> let_in;
  std::uint64_t refused = 0;
  for (int turn = 0; turn < 100 && let_in == nullptr; ++turn) {
    let_in = acceptor->admit();
    const std::uint64_t now = acceptor->take_refused();
    EXPECT_LE(now, static_cast<std::uint64_t>(Listener::kMostRefused));
    refused += now;
  }
  ASSERT_NE(let_in, nullptr);
  EXPECT_EQ(let_in->address(), "127.0.0.2");
  EXPECT_EQ(refused, crowd.size());
}

TEST(ServerLimits, WhenAClientIsIdle_ThenItIsDroppedAndABusyOneIsNot) {
  ServerOptions options;
  options.idle_timeout = 300ms;
  ServerHarness harness(options);
  const Client idle = harness.client();
  const Client busy = harness.client();
  bool ended = false;
  for (int i = 0; i < 100 && !ended; ++i) {
    ASSERT_TRUE(served(busy));
    ended = idle.receive(1, 20ms) == "closed";
  }
  EXPECT_TRUE(ended);
}

TEST(ServerLimits, WhenAClientReadsNothing_ThenItIsDroppedAndOthersAreServed) {
  ServerOptions options;
  options.send_timeout = 300ms;
  ServerHarness harness(options);
  const Client slow = harness.client();
  const Client other = harness.client();
  const int small = 4'096;
  setsockopt(slow.descriptor(), SOL_SOCKET, SO_RCVBUF, &small, sizeof small);
  fcntl(slow.descriptor(), F_SETFL, O_NONBLOCK);
  Bytes many;
  for (unsigned i = 0; i < 200; ++i) many = std::move(many) + frame(i, kLong);
  bool ended = false;
  const auto deadline = Clock::now() + 20s;
  while (!ended && Clock::now() < deadline) {
    ended = ::send(slow.descriptor(), many.data(), many.size(), MSG_NOSIGNAL) < 0 && errno != EAGAIN;
    ASSERT_TRUE(served(other));
  }
  EXPECT_TRUE(ended);
  harness.stop();
  EXPECT_GE(harness.server->figures().dropped, 1u);
}

TEST(ServerLimits, WhenThereAreNoDescriptorsLeft_ThenItGoesOnWithThoseItHas) {
  ServerHarness harness;
  const Client client = harness.client();
  EXPECT_TRUE(served(client));
  std::vector<int> taken;
  rlimit before{};
  getrlimit(RLIMIT_NOFILE, &before);
  const Client waiting = harness.client();
  EXPECT_TRUE(served(waiting));
  const int newcomer = ::socket(AF_INET, SOCK_STREAM, 0);
  const int highest = dup(newcomer);
  ::close(highest);
  const rlimit few{static_cast<rlim_t>(highest), before.rlim_max};
  setrlimit(RLIMIT_NOFILE, &few);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(harness.port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  EXPECT_EQ(::connect(newcomer, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(served(client));
  pollfd entry{newcomer, POLLIN, 0};
  EXPECT_EQ(poll(&entry, 1, 2'000), 1) << "it was neither let in nor turned away";
  setrlimit(RLIMIT_NOFILE, &before);
  ::close(newcomer);
  EXPECT_TRUE(served(harness.client()));
}

TEST(ServerLimits, WhenManyComeAndGo_ThenTheCountIsRight) {
  ServerHarness harness;
  for (int i = 0; i < 300; ++i) {
    const Client client = harness.client();
    if (i % 3 != 0) continue;
    EXPECT_TRUE(served(client));
  }
  const Client last = harness.client();
  // It takes a turn of the server for each; within these it has seen who left.
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(served(last));
  harness.stop();
  EXPECT_EQ(harness.server->figures().connections, 1u);
  EXPECT_EQ(harness.server->figures().accepted, 301u);
}

TEST(ServerLimits, WhenASessionIsMade_ThenItIsSmall) {
  EXPECT_LE(sizeof(Session), 16u << 10);
}

}  // namespace
}  // namespace stepwright::modbus::server
