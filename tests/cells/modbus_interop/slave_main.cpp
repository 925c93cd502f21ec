// Our server with tables in memory, without a runtime: what other slaves are in these tests, and a server
// that can be asked as fast as it answers.
//   modbus_interop_slave tcp PORT | rtu DEVICE | tls PORT FOLDER
// FOLDER has the certificates of runtime/doc/modbus_security.md. Says "ready" when it listens; ends by a
// signal.

#include <sys/eventfd.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <deque>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "runtime/modbus/pdu/wire.h"
#include "runtime/modbus/server/line/line_door.h"
#include "runtime/modbus/server/server.h"
#include "runtime/modbus/server/tcp_door.h"
#include "runtime/modbus/server/tls/tls_door.h"

namespace {

using namespace stepwright;
using namespace stepwright::modbus::server;
using modbus::pdu::Exception;
using modbus::pdu::Function;
using modbus::pdu::Request;

constexpr std::size_t kCount = 200;

// The tables of peer_server.py. Writes are done at once.
class PeerTables final : public ProcessData {
 public:
  PeerTables() : descriptor_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
    for (std::size_t i = 0; i < kCount; ++i) {
      discrete_[i] = i % 3 == 0;
      input_[i] = static_cast<std::uint16_t>(3 * i + 7);
    }
  }
  ~PeerTables() override { ::close(descriptor_); }

  Exception read(const Request& request, std::span<std::byte> table) override {
    if (!holds(request.address, request.count)) return Exception::IllegalDataAddress;
    for (std::byte& each : table) each = std::byte{0};
    for (std::size_t i = 0; i < request.count; ++i) {
      const std::size_t at = request.address + i;
      if (request.reads_bits()) {
        const auto& bits = request.function == Function::ReadCoils ? coils_ : discrete_;
        table[i / 8] |= std::byte(bits[at]) << (i % 8);
      } else {
        const auto& words = request.function == Function::ReadInputRegisters ? input_ : holding_;
        modbus::pdu::put16(table, 2 * i, words[at]);
      }
    }
    return Exception::None;
  }

  Exception begin_write(std::uint64_t ticket, const Request& request) override {
    const bool both = request.function == Function::ReadWriteMultipleRegisters;
    if (!holds(request.address, request.count) ||
        (both && !holds(request.write_address, request.write_count)))
      return Exception::IllegalDataAddress;
    write(request, both ? request.write_address : request.address,
          both ? request.write_count : request.count);
    done_.push_back({ticket, Exception::None});
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto put = ::write(descriptor_, &one, sizeof one);
    return Exception::None;
  }
  std::optional<Written> take_written() override {
    if (done_.empty()) return std::nullopt;
    const Written first = done_.front();
    done_.pop_front();
    return first;
  }
  int descriptor() const override { return descriptor_; }
  void clear() override {
    std::uint64_t count = 0;
    [[maybe_unused]] const auto got = ::read(descriptor_, &count, sizeof count);
  }

 private:
  static bool holds(std::size_t address, std::size_t count) { return address + count <= kCount; }

  void write(const Request& request, std::size_t address, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      if (request.writes_bits()) {
        coils_[address + i] = (request.data[i / 8] >> (i % 8) & std::byte{1}) != std::byte{0};
      } else if (request.function == Function::MaskWriteRegister) {
        holding_[address] = modbus::pdu::masked(holding_[address], request.and_mask, request.or_mask);
      } else {
        holding_[address + i] = modbus::pdu::get16(request.data, 2 * i);
      }
    }
  }

  int descriptor_;
  std::array<bool, kCount> coils_{}, discrete_{};
  std::array<std::uint16_t, kCount> holding_{}, input_{};
  std::deque<Written> done_;
};

ClientRule rule(const char* role, bool writes) {
  ClientRule out;
  out.role = role;
  for (std::size_t table = 0; table < modbus::map::kTables; ++table) {
    out.read.push_back({static_cast<modbus::map::Table>(table)});
    if (writes) out.write.push_back({static_cast<modbus::map::Table>(table)});
  }
  return out;
}

// Everybody may do everything; over TLS operators may, viewers may read, and others may nothing.
std::vector<ClientRule> rules(bool tls) {
  if (!tls) return {rule("", true)};
  return {rule("operator", true), rule("viewer", false)};
}

result::Result<std::unique_ptr<Door>> tcp_door(const std::string& port) {
  TcpOptions options;
  options.port = static_cast<std::uint16_t>(std::stoi(port));
  options.allow = {*IpRange::parse("127.0.0.0/8")};
  auto door = TcpDoor::open(options);
  if (!door) return result::forward(door);
  return std::move(*door);
}

result::Result<std::unique_ptr<Door>> tls_door(const std::string& port, const std::filesystem::path& folder) {
  TlsOptions options;
  options.certificate = folder / "plc.crt";
  options.key = folder / "plc.key";
  options.authorities = folder / "plant-ca.crt";
  auto context = TlsContext::create(options);
  if (!context) return result::forward(context);
  auto inner = tcp_door(port);
  if (!inner) return inner;
  return std::make_unique<TlsDoor>(std::move(*inner), *context,
                                   [](const std::string& address, const std::string& why) {
                                     std::cout << "refused " << address << ": " << why << std::endl;
                                   });
}

std::unique_ptr<Door> line_door(const std::string& device) {
  LineOptions options;
  options.device = device;
  options.parity = Parity::None;
  return LineDoor::create(options, [](const auto& why) { std::cout << result::to_string(why) << std::endl; });
}

}  // namespace

int main(int argc, char** argv) {
  const std::string kind = argc > 2 ? argv[1] : "";
  if ((kind != "tcp" && kind != "rtu" && kind != "tls") || argc != (kind == "tls" ? 4 : 3)) return 2;
  PeerTables tables;
  ServerOptions options;
  options.clients = rules(kind == "tls");
  auto server = Server::create(options, tables);
  auto door = kind == "rtu"   ? result::Result<std::unique_ptr<Door>>(line_door(argv[2]))
              : kind == "tcp" ? tcp_door(argv[2])
                              : tls_door(argv[2], argv[3]);
  if (!server || !door) {
    std::cerr << result::to_string(server ? door.error() : server.error()) << '\n';
    return 1;
  }
  (*server)->add(std::move(*door));
  if (kind == "rtu") {
    while ((*server)->figures().connections == 0) (*server)->turn(std::chrono::milliseconds(10));
  }
  std::cout << "ready" << std::endl;
  while (true) (*server)->turn(std::chrono::milliseconds(1'000));
}
