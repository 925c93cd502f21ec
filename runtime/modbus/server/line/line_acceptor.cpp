#include "runtime/modbus/server/line/line_acceptor.h"

#include <sys/timerfd.h>
#include <unistd.h>

#include <utility>

namespace stepwright::modbus::server {

struct LineAcceptor::State {
  State(LineOptions o, OnTrouble t, std::chrono::milliseconds r)
      : options(std::move(o)), on_trouble(std::move(t)), retry(r) {
    timer = ::timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC);
    wake_after(std::chrono::milliseconds(1));
  }
  ~State() {
    if (timer >= 0) ::close(timer);
  }

  void wake_after(std::chrono::milliseconds time) {
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(time);
    itimerspec due{};
    due.it_value.tv_sec = seconds.count();
    due.it_value.tv_nsec = std::chrono::nanoseconds(time - seconds).count();
    ::timerfd_settime(timer, 0, &due, nullptr);
  }
  // False if it is not time yet; the timer's descriptor is no longer readable.
  bool is_due() {
    std::uint64_t times = 0;
    return ::read(timer, &times, sizeof times) == static_cast<ssize_t>(sizeof times);
  }

  LineOptions options;
  OnTrouble on_trouble;
  std::chrono::milliseconds retry;
  int timer = -1;
  std::string told;  // the newest trouble
};

namespace {

// `Freed` is called when the line is closed.
template <typename Freed>
class LineTransport final : public Transport {
 public:
  LineTransport(SerialLine line, const LineOptions& options, Freed freed)
      : line_(std::move(line)), unit_(options.unit), freed_(std::move(freed)) {
    peer_.address = options.device.string();
  }
  ~LineTransport() override { freed_(); }

  int descriptor() const override { return line_.descriptor(); }
  Moved read(std::span<std::byte> into) override { return line_.read(into); }
  Moved write(std::span<const std::byte> from) override { return line_.write(from); }
  const Peer* peer() const override { return &peer_; }
  Framing framing() const override { return Framing::Rtu; }
  std::uint8_t unit() const override { return unit_; }

 private:
  SerialLine line_;
  std::uint8_t unit_;
  Freed freed_;
  Peer peer_;
};

}  // namespace

LineAcceptor::LineAcceptor(std::shared_ptr<State> state) : state_(std::move(state)) {}
LineAcceptor::~LineAcceptor() = default;

std::unique_ptr<LineAcceptor> LineAcceptor::create(LineOptions options, OnTrouble on_trouble,
                                                   std::chrono::milliseconds retry) {
  return std::unique_ptr<LineAcceptor>(
      new LineAcceptor(std::make_shared<State>(std::move(options), std::move(on_trouble), retry)));
}

int LineAcceptor::descriptor() const {
  return state_->timer;
}

std::unique_ptr<Transport> LineAcceptor::admit() {
  if (!state_->is_due()) return nullptr;
  auto line = SerialLine::open(state_->options);
  if (!line) {
    const std::string trouble = result::to_string(line.error());
    if (trouble != state_->told && state_->on_trouble) state_->on_trouble(line.error());
    state_->told = trouble;
    state_->wake_after(state_->retry);
    return nullptr;
  }
  state_->told.clear();
  auto freed = [state = state_] { state->wake_after(state->retry); };
  return std::make_unique<LineTransport<decltype(freed)>>(std::move(*line), state_->options,
                                                          std::move(freed));
}

void LineAcceptor::turn_away() {
  if (state_->is_due()) state_->wake_after(state_->retry);
}

std::string LineAcceptor::name() const {
  const LineOptions& options = state_->options;
  return "rtu " + options.device.string() + " " + line_text(options) + " unit " +
         std::to_string(options.unit);
}

}  // namespace stepwright::modbus::server
