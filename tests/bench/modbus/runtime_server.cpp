#include "tests/bench/modbus/runtime_server.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "ladder/driver/compile.h"
#include "runtime/host/host_runtime.h"
#include "runtime/image/no_io.h"
#include "runtime/modbus/server/runtime_data.h"
#include "runtime/modbus/server/server.h"
#include "runtime/modbus/server/tcp_acceptor.h"
#include "runtime/service/connection.h"
#include "runtime/service/server.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::bench {
namespace {

using namespace std::chrono_literals;

constexpr const char* kProgram = R"(
PROGRAM Main
  VAR
    i : INT;
    count AT %MW0 : INT;
    values AT %MW16 : ARRAY[0..255] OF INT;
  END_VAR
  count := count + 1;
  FOR i := 0 TO 255 DO values[i] := count + i; END_FOR;
END_PROGRAM
CONFIGURATION Plant
  RESOURCE Cpu ON Any
    TASK Fast(INTERVAL := T#1ms, PRIORITY := 1);
    PROGRAM Main WITH Fast : Main;
  END_RESOURCE
END_CONFIGURATION)";

template <typename T>
T taken(result::Result<T> made) {
  if (made) return std::move(*made);
  std::fprintf(stderr, "bench_modbus: %s\n", result::to_string(made.error()).c_str());
  std::exit(5);
}

std::vector<std::byte> compiled() {
  driver::CompileInput input;
  input.texts.push_back({"bench.st", kProgram});
  return taken(driver::compile(input)).container;
}

}  // namespace

struct RuntimeServer::State {
  support::TemporaryFolder folder;
  image::NoIo driver;
  int stop = eventfd(0, 0);
  std::unique_ptr<host::HostRuntime> runtime;
  std::unique_ptr<service::Server> service;
  std::unique_ptr<service::Connection> operate;
  std::unique_ptr<modbus::server::RuntimeData> data;
  std::unique_ptr<modbus::server::Server> server;
  std::uint16_t port = 0;
  std::atomic<bool> quit{false};
  std::thread service_thread;
  std::thread server_thread;
};

RuntimeServer::RuntimeServer() : state_(std::make_unique<State>()) {
  State& s = *state_;
  host::HostConfig config;
  config.clock = host::ClockMode::Real;
  s.runtime = taken(host::HostRuntime::create(config, s.driver, nullptr));
  s.service = taken(service::Server::create({s.folder / "runtime.sock", 60s}, *s.runtime));
  s.service_thread = std::thread([&s] { s.service->run(s.stop); });
  s.operate =
      taken(service::Connection::open(s.folder / "runtime.sock", {service::Role::Controller, "bench", 0}));
  restart();
  modbus::server::RuntimeDataOptions options;
  options.socket = s.folder / "runtime.sock";
  options.real_time = true;
  s.data = taken(
      modbus::server::RuntimeData::create(options, [](const char*, const std::string&, const auto&) {}));
  s.server = taken(modbus::server::Server::create({}, *s.data));
  modbus::server::TcpOptions tcp;
  tcp.port = 0;
  tcp.allow = {*network::IpRange::parse("127.0.0.0/8")};
  auto acceptor = taken(modbus::server::TcpAcceptor::open(tcp));
  s.port = acceptor->port();
  s.server->add(std::move(acceptor));
  while (!s.data->serving()) std::this_thread::sleep_for(10ms);
  s.server_thread = std::thread([&s] {
    while (!s.quit) s.server->run_for(20ms);
  });
}

RuntimeServer::~RuntimeServer() {
  State& s = *state_;
  s.quit = true;
  s.server_thread.join();
  s.server.reset();
  s.data.reset();
  s.operate.reset();
  const std::uint64_t one = 1;
  if (write(s.stop, &one, sizeof one) != static_cast<ssize_t>(sizeof one)) std::exit(5);
  s.service_thread.join();
  s.service.reset();
  s.runtime.reset();
}

std::uint16_t RuntimeServer::port() const {
  return state_->port;
}

void RuntimeServer::restart() {
  taken(state_->operate->download(compiled(), 10s));
  taken(state_->operate->call(service::Start{}, 10s));
}

host::TaskStatus RuntimeServer::task() const {
  while (auto message = state_->operate->receive(0ms)) {
  }
  while (auto message = state_->operate->receive(1s)) {
    const auto* status = std::get_if<host::RuntimeStatus>(&*message);
    if (status != nullptr && !status->tasks.empty()) return status->tasks.front();
  }
  return {};
}

double RuntimeServer::service_p99_us() const {
  return static_cast<double>(state_->server->figures().service_time.percentile_ns(99'000)) / 1e3;
}

}  // namespace stepwright::bench
