#include "runtime/modbus/master/master.h"

#include <modbus/modbus.h>
#include <sys/select.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <thread>
#include <utility>

#include "runtime/modbus/master/tcp_connect.h"

namespace stepwright::modbus::master {
namespace {

using Clock = std::chrono::steady_clock;
using Context = std::unique_ptr<modbus_t, decltype(&modbus_free)>;

constexpr std::uint8_t kLastUnit = 247;
constexpr std::chrono::milliseconds kShortestPeerTimeout{1'000};

tl::unexpected<result::Diagnostics> impossible(const std::string& name, const std::string& what) {
  return result::fail("R0126", {name, 0, 0}, what);
}

result::Result<Context> make_context(const TcpEndpoint& endpoint) {
  if (endpoint.host.empty() || endpoint.port == 0)
    return impossible(name_of(endpoint), "a connection needs a host and a port from 1 to 65535");
  // The address is of no use to libmodbus: it gets a socket that is connected.
  return Context(modbus_new_tcp("127.0.0.1", endpoint.port), &modbus_free);
}

result::Result<Context> make_context(const SerialEndpoint& line) {
  if (line.device.empty()) return impossible("", "a serial line needs a device");
  if (std::ranges::find(kSpeeds, line.baud) == kSpeeds.end())
    return impossible(line.device, "no line has " + std::to_string(line.baud) + " baud");
  const bool sized =
      (line.data_bits == 7 || line.data_bits == 8) && (line.stop_bits == 1 || line.stop_bits == 2);
  if (!sized) return impossible(line.device, "characters have 7 or 8 data bits and 1 or 2 stop bits");
  const char parity = line.parity == Parity::Even ? 'E' : line.parity == Parity::Odd ? 'O' : 'N';
  return Context(modbus_new_rtu(line.device.c_str(), static_cast<int>(line.baud), parity, line.data_bits,
                                line.stop_bits),
                 &modbus_free);
}

bool is_range(std::uint16_t first, std::size_t count, std::size_t most) {
  return count >= 1 && count <= most && first + count <= 65'536;
}

constexpr Outcome kBadRequest{Fault::BadRequest, 0, 0};

}  // namespace

struct Master::State {
  State(Endpoint e, const MasterOptions& o, Context c)
      : endpoint(std::move(e)), options(o), context(std::move(c)) {}

  bool serial() const { return std::holds_alternative<SerialEndpoint>(endpoint); }
  bool open() const { return modbus_get_socket(context.get()) >= 0; }

  void close() {
    if (open()) modbus_close(context.get());
    modbus_set_socket(context.get(), -1);  // of a line, modbus_close leaves the number
  }

  Outcome connect_line() {
    const auto& line = std::get<SerialEndpoint>(endpoint);
    if (modbus_connect(context.get()) != 0) {
      const int error = errno;
      modbus_set_socket(context.get(), -1);
      return {Fault::NotConnected, 0, error};
    }
    const bool fits = modbus_get_socket(context.get()) < FD_SETSIZE;
    const bool switched = !line.rs485 || modbus_rtu_set_serial_mode(context.get(), MODBUS_RTU_RS485) == 0;
    if (fits && switched) return {};
    const int error = fits ? errno : EMFILE;
    close();
    return {Fault::NotConnected, 0, error};
  }

  Outcome connect_host() {
    const auto peer = std::max(kShortestPeerTimeout, 2 * options.timeout);
    const ConnectedSocket made = connect_tcp(std::get<TcpEndpoint>(endpoint), options.connect_timeout, peer);
    if (made.descriptor < 0) return {Fault::NotConnected, 0, made.error};
    modbus_set_socket(context.get(), made.descriptor);
    return {};
  }

  void apply_timeout() {
    const auto us = std::chrono::duration_cast<std::chrono::microseconds>(options.timeout).count();
    modbus_set_response_timeout(context.get(), static_cast<std::uint32_t>(us / 1'000'000),
                                static_cast<std::uint32_t>(us % 1'000'000));
    // Without a timeout between bytes libmodbus holds the whole answer to the one above.
    modbus_set_byte_timeout(context.get(), 0, 0);
  }

  // Late answers would be taken for those of the next request. False if the other side does nothing but send.
  bool drain() {
    if (serial()) return modbus_flush(context.get()) >= 0;
    std::array<std::byte, 4'096> late;
    const ssize_t got = recv(modbus_get_socket(context.get()), late.data(), late.size(), MSG_DONTWAIT);
    return got < static_cast<ssize_t>(late.size());
  }

  // Before a request: what stands in its way.
  Outcome prepare() {
    if (!open()) return {Fault::NotConnected, 0, ENOTCONN};
    if (serial()) {
      const auto free_at = last + options.gap;
      if (Clock::now() < free_at) std::this_thread::sleep_until(free_at);
    }
    if (stale && !drain()) {
      close();
      return {Fault::ConnectionLost, 0, EBADMSG};
    }
    stale = false;
    return {};
  }

  // What the return value of a libmodbus request means; `wanted` is that of success.
  Outcome finish(int got, std::size_t wanted) {
    const int error = errno;
    last = Clock::now();
    if (got == static_cast<int>(wanted)) return {};
    stale = true;
    if (got >= 0) return bad_answer(0);
    if (error > MODBUS_ENOBASE && error < EMBBADCRC) {
      stale = false;
      return {Fault::Exception, static_cast<std::uint8_t>(error - MODBUS_ENOBASE), error};
    }
    if (error >= EMBBADCRC && error <= EMBBADSLAVE) return bad_answer(error);
    if (error == ETIMEDOUT) return {Fault::Timeout, 0, error};
    close();
    return {Fault::ConnectionLost, 0, error};
  }

  // Whatever follows on a stream that is out of step belongs to no request.
  Outcome bad_answer(int error) {
    if (!serial()) close();
    return {Fault::BadAnswer, 0, error};
  }

  Endpoint endpoint;
  MasterOptions options;
  Context context;
  Clock::time_point last{};
  bool stale = false;  // bytes may be on their way that nobody asked for
};

Master::Master(std::unique_ptr<State> state) : state_(std::move(state)) {}
Master::~Master() {
  if (state_ != nullptr) state_->close();
}
Master::Master(Master&&) noexcept = default;
Master& Master::operator=(Master&&) noexcept = default;

result::Result<Master> Master::create(const Endpoint& endpoint, const MasterOptions& options) {
  auto context = std::visit([](const auto& kind) { return make_context(kind); }, endpoint);
  if (!context) return result::forward(context);
  if (*context == nullptr) return impossible(name_of(endpoint), "libmodbus refuses this connection");
  auto state = std::make_unique<State>(endpoint, options, std::move(*context));
  if (const auto* line = std::get_if<SerialEndpoint>(&endpoint); line != nullptr && options.gap.count() < 0)
    state->options.gap = frame_gap(line->baud);
  modbus_set_error_recovery(state->context.get(), MODBUS_ERROR_RECOVERY_NONE);
  modbus_set_slave(state->context.get(), 1);
  state->apply_timeout();
  return Master(std::move(state));
}

Outcome Master::connect() {
  state_->close();
  state_->stale = state_->serial();  // a line may have gone on without us
  return state_->serial() ? state_->connect_line() : state_->connect_host();
}

void Master::close() {
  state_->close();
}

bool Master::connected() const {
  return state_->open();
}

Outcome Master::select_unit(std::uint8_t unit) {
  const bool known = state_->serial() ? unit >= 1 && unit <= kLastUnit : unit <= kLastUnit || unit == 255;
  if (!known || modbus_set_slave(state_->context.get(), unit) != 0) return kBadRequest;
  return {};
}

void Master::set_timeout(std::chrono::milliseconds timeout) {
  state_->options.timeout = timeout;
  state_->apply_timeout();
}

Outcome Master::read_bits(BitTable table, std::uint16_t first, std::span<std::uint8_t> bits) {
  if (!is_range(first, bits.size(), kMaxReadBits)) return kBadRequest;
  if (const Outcome ready = state_->prepare(); !ready.good()) return ready;
  const auto read = table == BitTable::Coils ? modbus_read_bits : modbus_read_input_bits;
  return state_->finish(read(state_->context.get(), first, static_cast<int>(bits.size()), bits.data()),
                        bits.size());
}

Outcome Master::read_registers(RegisterTable table, std::uint16_t first, std::span<std::uint16_t> words) {
  if (!is_range(first, words.size(), kMaxReadRegisters)) return kBadRequest;
  if (const Outcome ready = state_->prepare(); !ready.good()) return ready;
  const auto read = table == RegisterTable::Holding ? modbus_read_registers : modbus_read_input_registers;
  return state_->finish(read(state_->context.get(), first, static_cast<int>(words.size()), words.data()),
                        words.size());
}

Outcome Master::write_coil(std::uint16_t address, bool value) {
  if (const Outcome ready = state_->prepare(); !ready.good()) return ready;
  return state_->finish(modbus_write_bit(state_->context.get(), address, value ? 1 : 0), 1);
}

Outcome Master::write_register(std::uint16_t address, std::uint16_t value) {
  if (const Outcome ready = state_->prepare(); !ready.good()) return ready;
  return state_->finish(modbus_write_register(state_->context.get(), address, value), 1);
}

Outcome Master::write_coils(std::uint16_t first, std::span<const std::uint8_t> bits) {
  if (!is_range(first, bits.size(), kMaxWriteBits)) return kBadRequest;
  if (const Outcome ready = state_->prepare(); !ready.good()) return ready;
  return state_->finish(
      modbus_write_bits(state_->context.get(), first, static_cast<int>(bits.size()), bits.data()),
      bits.size());
}

Outcome Master::write_registers(std::uint16_t first, std::span<const std::uint16_t> words) {
  if (!is_range(first, words.size(), kMaxWriteRegisters)) return kBadRequest;
  if (const Outcome ready = state_->prepare(); !ready.good()) return ready;
  return state_->finish(
      modbus_write_registers(state_->context.get(), first, static_cast<int>(words.size()), words.data()),
      words.size());
}

Outcome Master::mask_register(std::uint16_t address, std::uint16_t and_mask, std::uint16_t or_mask) {
  if (const Outcome ready = state_->prepare(); !ready.good()) return ready;
  return state_->finish(modbus_mask_write_register(state_->context.get(), address, and_mask, or_mask), 1);
}

Outcome Master::read_write_registers(std::uint16_t write_first, std::span<const std::uint16_t> write,
                                     std::uint16_t read_first, std::span<std::uint16_t> read) {
  if (!is_range(write_first, write.size(), kMaxWriteInReadWrite) ||
      !is_range(read_first, read.size(), kMaxReadRegisters)) {
    return kBadRequest;
  }
  if (const Outcome ready = state_->prepare(); !ready.good()) return ready;
  return state_->finish(
      modbus_write_and_read_registers(state_->context.get(), write_first, static_cast<int>(write.size()),
                                      write.data(), read_first, static_cast<int>(read.size()), read.data()),
      read.size());
}

}  // namespace stepwright::modbus::master
