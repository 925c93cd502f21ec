#include "tests/support/modbus_controller/slave.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

#include "runtime/modbus/pdu/rtu_frame.h"
#include "runtime/modbus/pdu/serve.h"
#include "runtime/modbus/pdu/tcp_frame.h"

namespace stepwright::support {
namespace {

using std::chrono::milliseconds;

std::int64_t now_ns() {
  return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void send_all(int descriptor, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::write(descriptor, bytes.data(), bytes.size());
    if (sent <= 0) return;  // the master sees no answer
    bytes = bytes.subspan(static_cast<std::size_t>(sent));
  }
}

// Waits until a descriptor is readable, but not longer than until the next scan.
bool readable(ControllerModel& model, int descriptor, milliseconds timeout) {
  std::int64_t wait_ns = std::chrono::nanoseconds(timeout).count();
  if (const std::int64_t next = model.next_tick_ns(); next >= 0)
    wait_ns = std::clamp<std::int64_t>(next - now_ns(), 0, wait_ns);
  pollfd entry{descriptor, POLLIN, 0};
  const timespec wait{wait_ns / 1'000'000'000, wait_ns % 1'000'000'000};
  const bool ready = ppoll(&entry, 1, &wait, nullptr) > 0 && (entry.revents & POLLIN) != 0;
  model.tick(now_ns());
  return ready;
}

class PtySlave final : public Slave {
 public:
  PtySlave(ControlRegisters& registers, ControllerModel& model, std::uint8_t unit)
      : registers_(registers), model_(model), receiver_(unit), master_(posix_openpt(O_RDWR | O_NOCTTY)) {
    if (master_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0)
      throw std::runtime_error("no pseudo terminal");
    where_ = ptsname(master_);
    slave_ = open(where_.c_str(), O_RDWR | O_NOCTTY);  // held, so that the master end lives without a peer
    termios settings{};
    if (slave_ < 0 || tcgetattr(slave_, &settings) != 0) throw std::runtime_error("no pseudo terminal");
    cfmakeraw(&settings);
    tcsetattr(slave_, TCSANOW, &settings);
  }
  ~PtySlave() override {
    close(slave_);
    close(master_);
  }

  void turn(milliseconds timeout) override {
    if (!readable(model_, master_, timeout)) return;
    std::array<std::byte, 512> bytes;
    const ssize_t count = ::read(master_, bytes.data(), bytes.size());
    for (ssize_t i = 0; i < count; ++i) {
      receiver_.push(bytes[static_cast<std::size_t>(i)]);
      while (const auto frame = receiver_.take()) {
        std::array<std::byte, modbus::pdu::kMaxRtuFrame> out;
        send_all(master_, std::span(out).first(modbus::pdu::serve_rtu(registers_, frame, out)));
      }
    }
  }
  std::string where() const override { return where_; }

 private:
  ControlRegisters& registers_;
  ControllerModel& model_;
  modbus::pdu::RtuReceiver receiver_;
  int master_;
  int slave_ = -1;
  std::string where_;
};

class TcpSlave final : public Slave {
 public:
  TcpSlave(ControlRegisters& registers, ControllerModel& model, std::uint16_t port)
      : registers_(registers), model_(model), listener_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    const int on = 1;
    setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* const plain = reinterpret_cast<sockaddr*>(&address);
    if (bind(listener_, plain, sizeof address) != 0 || listen(listener_, 4) != 0 ||
        getsockname(listener_, plain, &size) != 0)
      throw std::runtime_error("no socket");
    where_ = "127.0.0.1:" + std::to_string(ntohs(address.sin_port));
  }
  ~TcpSlave() override {
    if (peer_ >= 0) close(peer_);
    close(listener_);
  }

  // The newest master has the line.
  void turn(milliseconds timeout) override {
    pollfd fresh{listener_, POLLIN, 0};
    if (poll(&fresh, 1, peer_ < 0 ? static_cast<int>(std::min(timeout, milliseconds(20)).count()) : 0) > 0) {
      if (peer_ >= 0) close(peer_);
      peer_ = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
      held_.clear();
    }
    model_.tick(now_ns());
    if (peer_ < 0 || !readable(model_, peer_, std::min(timeout, milliseconds(20)))) return;
    std::array<std::byte, 512> bytes;
    const ssize_t count = ::read(peer_, bytes.data(), bytes.size());
    if (count <= 0) return hang_up();
    held_.insert(held_.end(), bytes.begin(), bytes.begin() + count);
    serve_held();
  }
  std::string where() const override { return where_; }

 private:
  void serve_held() {
    using modbus::pdu::TcpTake;
    while (true) {
      const TcpTake take = modbus::pdu::take_frame(held_);
      if (take.state == TcpTake::State::Bad) return hang_up();
      if (take.state == TcpTake::State::NeedsMore) return;
      std::array<std::byte, modbus::pdu::kMaxTcpFrame> out;
      const std::size_t length = modbus::pdu::serve(registers_, take.frame.pdu, modbus::pdu::tcp_pdu(out));
      send_all(peer_, std::span(out).first(
                          modbus::pdu::seal_tcp(out, take.frame.transaction, take.frame.unit, length)));
      held_.erase(held_.begin(), held_.begin() + static_cast<std::ptrdiff_t>(take.frame.bytes));
    }
  }
  void hang_up() {
    close(peer_);
    peer_ = -1;
  }

  ControlRegisters& registers_;
  ControllerModel& model_;
  int listener_;
  int peer_ = -1;
  std::vector<std::byte> held_;
  std::string where_;
};

}  // namespace

std::unique_ptr<Slave> Slave::on_pty(ControlRegisters& registers, ControllerModel& model, std::uint8_t unit) {
  return std::make_unique<PtySlave>(registers, model, unit);
}

std::unique_ptr<Slave> Slave::on_loopback(ControlRegisters& registers, ControllerModel& model,
                                          std::uint16_t port) {
  return std::make_unique<TcpSlave>(registers, model, port);
}

}  // namespace stepwright::support
