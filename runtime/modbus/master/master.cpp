#include "runtime/modbus/master/master.h"

#include <modbus/modbus.h>
#include <sys/select.h>
#include <sys/socket.h>
#include <termios.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <thread>
#include <utility>

#include "runtime/modbus/line/line_claim.h"
#include "runtime/modbus/master/exchange.h"
#include "runtime/modbus/master/late_answer.h"
#include "runtime/modbus/master/tcp_connect.h"
#include "runtime/modbus/master/wire_request.h"
#include "runtime/modbus/pdu/wire.h"

namespace stepwright::modbus::master {
namespace {

using Clock = std::chrono::steady_clock;
using Context = std::unique_ptr<modbus_t, decltype(&modbus_free)>;

constexpr std::uint8_t kLastUnit = 247;
constexpr std::chrono::milliseconds kShortestPeerTimeout{1'000};

// Characters of a request and its answer, with address and checksum (Modbus Application Protocol V1.1b3, 6).
constexpr std::size_t kEcho = 8;       // what writes are answered with, and what reads consist of
constexpr std::size_t kReadHead = 5;   // of the answer to a read, beside its values
constexpr std::size_t kWriteHead = 9;  // of a request that writes several
constexpr std::size_t kMask = 10;
constexpr std::size_t kReadWriteHead = 13;

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

// Of the speeds that kSpeeds has.
speed_t code_of(std::uint32_t baud) {
  constexpr std::array<speed_t, kSpeeds.size()> kCodes = {B1200,   B2400,   B4800,   B9600,   B19200,
                                                          B38400,  B57600,  B115200, B230400, B460800,
                                                          B500000, B921600, B1000000};
  const auto found = std::ranges::find(kSpeeds, baud);
  return kCodes[static_cast<std::size_t>(found - kSpeeds.begin())];
}

bool is_range(std::uint16_t first, std::size_t count, std::size_t most) {
  return count >= 1 && count <= most && first + count <= 65'536;
}

constexpr Outcome kBadRequest{Fault::BadRequest, 0, 0};

// libmodbus looks at neither length nor unit of a TCP answer's header (3.1.6), and knows no echo.
std::optional<Exchange> exchange_for(const Endpoint& endpoint) {
  if (const auto* tcp = std::get_if<TcpEndpoint>(&endpoint)) return Exchange({.framing = tcp->framing});
  if (std::get<SerialEndpoint>(endpoint).echo) return Exchange({.framing = Framing::Rtu, .echo = true});
  return std::nullopt;
}

}  // namespace

struct Master::State {
  State(Endpoint e, const MasterOptions& o, Context c)
      : endpoint(std::move(e)), options(o), context(std::move(c)), exchange(exchange_for(endpoint)) {}

  bool serial() const { return std::holds_alternative<SerialEndpoint>(endpoint); }
  bool open() const { return modbus_get_socket(context.get()) >= 0; }

  void close() {
    if (open()) modbus_close(context.get());
    modbus_set_socket(context.get(), -1);  // of a line, modbus_close leaves the number
    claim.release();
  }

  Outcome connect_line() {
    const auto& endpoint_of_line = std::get<SerialEndpoint>(endpoint);
    // Before libmodbus opens it and changes its settings under somebody who uses it.
    if (const int error = claim.take(endpoint_of_line.device); error != 0)
      return {Fault::NotConnected, 0, error};
    if (modbus_connect(context.get()) != 0) {
      const int error = errno;
      modbus_set_socket(context.get(), -1);
      claim.release();
      return {Fault::NotConnected, 0, error};
    }
    const int error = set_up_line(endpoint_of_line);
    if (error == 0) return {};
    close();
    return {Fault::NotConnected, 0, error};
  }

  int set_up_line(const SerialEndpoint& endpoint_of_line) {
    const int descriptor = modbus_get_socket(context.get());
    if (descriptor >= FD_SETSIZE) return EMFILE;
    if (!line::has_taken(descriptor, wanted_settings(endpoint_of_line))) return EINVAL;
    if (endpoint_of_line.rs485 && modbus_rtu_set_serial_mode(context.get(), MODBUS_RTU_RS485) != 0)
      return errno;
    line::keep_others_out(descriptor);
    line::ask_for_low_latency(descriptor);
    return 0;
  }

  Outcome connect_host() {
    const auto peer = std::max(kShortestPeerTimeout, 2 * options.timeout);
    const ConnectedSocket made = connect_tcp(std::get<TcpEndpoint>(endpoint), options.connect_timeout, peer);
    if (made.descriptor < 0) return {Fault::NotConnected, 0, made.error};
    modbus_set_socket(context.get(), made.descriptor);
    return {};
  }

  // `characters`: of the request and its answer, which a line takes its time for.
  std::chrono::microseconds timeout_for(std::size_t characters) const {
    const auto* const on_line = std::get_if<SerialEndpoint>(&endpoint);
    const std::chrono::microseconds wire =
        on_line != nullptr ? time_on(*on_line, characters) : std::chrono::microseconds(0);
    return options.timeout + wire;
  }

  void apply_timeout(std::size_t characters) {
    const auto us = timeout_for(characters).count();
    modbus_set_response_timeout(context.get(), static_cast<std::uint32_t>(us / 1'000'000),
                                static_cast<std::uint32_t>(us % 1'000'000));
    // Without a timeout between bytes libmodbus holds the whole answer to the one above.
    modbus_set_byte_timeout(context.get(), 0, 0);
  }

  // Late answers would be taken for those of the next request. False if the other side does nothing but send.
  bool drain() {
    if (serial()) return modbus_flush(context.get()) >= 0;
    std::array<std::byte, 4'096> rest;
    const ssize_t got = recv(modbus_get_socket(context.get()), rest.data(), rest.size(), MSG_DONTWAIT);
    return got < static_cast<ssize_t>(rest.size());
  }

  // Before a request: what stands in its way.
  Outcome prepare(std::size_t characters) {
    if (!open()) return {Fault::NotConnected, 0, ENOTCONN};
    if (serial()) {
      const auto free_at = last + options.gap;
      if (Clock::now() < free_at) std::this_thread::sleep_until(free_at);
    }
    if ((stale || exchange || serial()) && !drain()) {
      close();
      return {Fault::ConnectionLost, 0, EBADMSG};
    }
    stale = false;
    apply_timeout(characters);
    return {};
  }

  // The answer's PDU in `room` where all is well.
  Answer ask_itself(const WireRequest& request, std::span<std::byte> room) {
    const std::size_t characters = request.pdu().size() + request.answer_bytes() + 6;
    if (const Outcome ready = prepare(characters); !ready.good()) return {ready, {}};
    const auto timeout = std::chrono::ceil<std::chrono::milliseconds>(timeout_for(characters));
    const auto unit = static_cast<std::uint8_t>(modbus_get_slave(context.get()));
    const Answer answer = exchange->ask(modbus_get_socket(context.get()), unit, request, timeout, room);
    last = Clock::now();
    if (answer.outcome.fault == Fault::BadAnswer) return {bad_answer(0), {}};
    if (answer.outcome.fault == Fault::ConnectionLost) close();
    return answer;
  }

  // A request whose answer has nothing but that it was done.
  Outcome tell(const WireRequest& request) {
    std::array<std::byte, Exchange::kMaxAdu> room;
    return ask_itself(request, room).outcome;
  }

  // One whose answer has registers.
  Outcome fetch(const WireRequest& request, std::span<std::uint16_t> words) {
    std::array<std::byte, Exchange::kMaxAdu> room;
    const Answer answer = ask_itself(request, room);
    if (!answer.outcome.good()) return answer.outcome;
    for (std::size_t i = 0; i < words.size(); ++i) words[i] = pdu::get16(request.table(answer.pdu), 2 * i);
    return {};
  }

  Outcome fetch_bits(const WireRequest& request, std::span<std::uint8_t> bits) {
    std::array<std::byte, Exchange::kMaxAdu> room;
    const Answer answer = ask_itself(request, room);
    if (!answer.outcome.good()) return answer.outcome;
    const auto packed = request.table(answer.pdu);
    for (std::size_t i = 0; i < bits.size(); ++i)
      bits[i] = (std::to_integer<unsigned>(packed[i / 8]) >> (i % 8)) & 1u;
    return {};
  }

  // Sends a request and waits for its answer. `wanted` is what libmodbus returns where all is well.
  template <typename Request>
  Outcome ask_once(std::size_t characters, std::size_t wanted, const Request& request) {
    if (const Outcome ready = prepare(characters); !ready.good()) return ready;
    return finish(request(context.get()), wanted);
  }

  // On a line the late answer of another unit is thrown away with the one that follows, and the request
  // repeated (Modbus over Serial Line V1.02, 2.4.1: the unexpected slave).
  template <typename Request>
  Outcome ask(std::size_t characters, std::size_t wanted, const Request& request) {
    const Outcome outcome = ask_once(characters, wanted, request);
    if (!serial() || outcome.system_error != EMBBADSLAVE) return outcome;
    throw_away_a_frame(modbus_get_socket(context.get()), options.timeout);
    last = Clock::now();
    return ask_once(characters, wanted, request);
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

  static termios wanted_settings(const SerialEndpoint& endpoint_of_line) {
    termios wanted{};
    wanted.c_cflag = endpoint_of_line.data_bits == 7 ? CS7 : CS8;
    if (endpoint_of_line.stop_bits == 2) wanted.c_cflag |= CSTOPB;
    if (endpoint_of_line.parity != Parity::None) wanted.c_cflag |= PARENB;
    if (endpoint_of_line.parity == Parity::Odd) wanted.c_cflag |= PARODD;
    cfsetospeed(&wanted, code_of(endpoint_of_line.baud));
    return wanted;
  }

  Endpoint endpoint;
  MasterOptions options;
  Context context;
  std::optional<Exchange> exchange;  // where the frames are this side's own
  line::LineClaim claim;
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

bool Master::moved() const {
  return state_->claim.moved();
}

Outcome Master::select_unit(std::uint8_t unit) {
  const bool known = state_->serial() ? unit >= 1 && unit <= kLastUnit : unit <= kLastUnit || unit == 255;
  if (!known || modbus_set_slave(state_->context.get(), unit) != 0) return kBadRequest;
  return {};
}

void Master::set_timeout(std::chrono::milliseconds timeout) {
  state_->options.timeout = timeout;
}

Outcome Master::read_bits(BitTable table, std::uint16_t first, std::span<std::uint8_t> bits) {
  if (!is_range(first, bits.size(), kMaxReadBits)) return kBadRequest;
  if (state_->exchange) {
    const auto function =
        table == BitTable::Coils ? pdu::Function::ReadCoils : pdu::Function::ReadDiscreteInputs;
    return state_->fetch_bits(WireRequest::read(function, first, bits.size()), bits);
  }
  const auto read = table == BitTable::Coils ? modbus_read_bits : modbus_read_input_bits;
  return state_->ask(kEcho + kReadHead + bytes_of_bits(bits.size()), bits.size(), [&](modbus_t* context) {
    return read(context, first, static_cast<int>(bits.size()), bits.data());
  });
}

Outcome Master::read_registers(RegisterTable table, std::uint16_t first, std::span<std::uint16_t> words) {
  if (!is_range(first, words.size(), kMaxReadRegisters)) return kBadRequest;
  if (state_->exchange) {
    const auto function = table == RegisterTable::Holding ? pdu::Function::ReadHoldingRegisters
                                                          : pdu::Function::ReadInputRegisters;
    return state_->fetch(WireRequest::read(function, first, words.size()), words);
  }
  const auto read = table == RegisterTable::Holding ? modbus_read_registers : modbus_read_input_registers;
  return state_->ask(kEcho + kReadHead + 2 * words.size(), words.size(), [&](modbus_t* context) {
    return read(context, first, static_cast<int>(words.size()), words.data());
  });
}

Outcome Master::write_coil(std::uint16_t address, bool value) {
  constexpr std::uint16_t kOn = 0xFF00;
  if (state_->exchange) {
    return state_->tell(
        WireRequest::write_single(pdu::Function::WriteSingleCoil, address, value ? kOn : std::uint16_t{0}));
  }
  return state_->ask(2 * kEcho, 1,
                     [&](modbus_t* context) { return modbus_write_bit(context, address, value ? 1 : 0); });
}

Outcome Master::write_register(std::uint16_t address, std::uint16_t value) {
  if (state_->exchange)
    return state_->tell(WireRequest::write_single(pdu::Function::WriteSingleRegister, address, value));
  return state_->ask(2 * kEcho, 1,
                     [&](modbus_t* context) { return modbus_write_register(context, address, value); });
}

Outcome Master::write_coils(std::uint16_t first, std::span<const std::uint8_t> bits) {
  if (!is_range(first, bits.size(), kMaxWriteBits)) return kBadRequest;
  if (state_->exchange) return state_->tell(WireRequest::write_coils(first, bits));
  return state_->ask(kWriteHead + bytes_of_bits(bits.size()) + kEcho, bits.size(), [&](modbus_t* context) {
    return modbus_write_bits(context, first, static_cast<int>(bits.size()), bits.data());
  });
}

Outcome Master::write_registers(std::uint16_t first, std::span<const std::uint16_t> words) {
  if (!is_range(first, words.size(), kMaxWriteRegisters)) return kBadRequest;
  if (state_->exchange) return state_->tell(WireRequest::write_registers(first, words));
  return state_->ask(kWriteHead + 2 * words.size() + kEcho, words.size(), [&](modbus_t* context) {
    return modbus_write_registers(context, first, static_cast<int>(words.size()), words.data());
  });
}

Outcome Master::mask_register(std::uint16_t address, std::uint16_t and_mask, std::uint16_t or_mask) {
  if (state_->exchange) return state_->tell(WireRequest::mask(address, and_mask, or_mask));
  return state_->ask(2 * kMask, 1, [&](modbus_t* context) {
    return modbus_mask_write_register(context, address, and_mask, or_mask);
  });
}

Outcome Master::read_write_registers(std::uint16_t write_first, std::span<const std::uint16_t> write,
                                     std::uint16_t read_first, std::span<std::uint16_t> read) {
  if (!is_range(write_first, write.size(), kMaxWriteInReadWrite) ||
      !is_range(read_first, read.size(), kMaxReadRegisters)) {
    return kBadRequest;
  }
  if (state_->exchange)
    return state_->fetch(WireRequest::read_write(write_first, write, read_first, read.size()), read);
  const std::size_t characters = kReadWriteHead + 2 * write.size() + kReadHead + 2 * read.size();
  return state_->ask(characters, read.size(), [&](modbus_t* context) {
    return modbus_write_and_read_registers(context, write_first, static_cast<int>(write.size()), write.data(),
                                           read_first, static_cast<int>(read.size()), read.data());
  });
}

}  // namespace stepwright::modbus::master
