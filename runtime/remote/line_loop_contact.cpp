// Finding the controller, and what is done when it is lost.

#include <utility>

#include "runtime/remote/line_loop.h"
#include "runtime/service/digest.h"

namespace stepwright::remote {
namespace {

constexpr ProgramDigest kNoProgram{};

}  // namespace

// One attempt, or the wait for the next one.
void LineLoop::seek() {
  const std::int64_t period_ns = std::chrono::nanoseconds(config_.reconnect_period).count();
  const std::int64_t left_ns = sought_ns_ == 0 ? 0 : sought_ns_ + period_ns - wall_ns();
  if (left_ns > 0) {
    if (!simulated() && met_) plant_.keep_safe(own_time_ns());
    publish_if_due();
    return wait(left_ns);
  }
  const Done met = meet();
  sought_ns_ = wall_ns();
  contact_ = met.has_value();
  line_problem_ = contact_ ? std::string() : result::to_string(met.error());
  if (contact_) {
    sought_ns_ = 0;
    met_ = true;
    status_due_ns_ = wall_ns();
    progress_ns_ = wall_ns();
  }
  publish();
  queues_.news().notify();
}

// Opens the line, learns what the controller is and runs, and brings both sides to the same state.
LineLoop::Done LineLoop::meet() {
  if (auto opened = link_.reopen(); !opened) return opened;
  auto status = link_.status();
  if (!status) return result::forward(status);
  const std::shared_ptr<const RemoteProgram> before = program_;
  if (auto known = know_program(*status); !known) return known;
  // Nobody held its turns, or what it did meanwhile was not seen: it may not go on as if nothing had been.
  const bool goes_on = !met_ && !simulated() && !status->lock_step();
  if (status->state == control::State::Running && !goes_on) {
    if (auto stopped = link_.command(control::Command::Stop); !stopped)
      return tl::unexpected(stopped.error());
    status = link_.status();
    if (!status) return result::forward(status);
  }
  auto outputs = link_.outputs(plant_.outputs());
  if (!outputs) return result::forward(outputs);
  turn_ = outputs->turn;
  known_event_ = status->event;
  uptime_ms_ = status->uptime_ms;
  now_.scan = outputs->scan;
  now_.trace_hash = outputs->trace_hash;
  now_.overruns = status->overruns;
  base_ns_ = next_ns_ - outputs->next_ns;
  if (program_ == nullptr) {
    now_.state = host::RuntimeState::Empty;
  } else if (!met_ || program_ != before) {
    now_.state = static_cast<host::RuntimeState>(status->state);
  }  // else as it was left: stopped, or at fault until it is started again
  if (program_ == nullptr) return {};
  auto read = link_.read_memory(control::Memory::Image, image_);
  if (!read) return result::forward(read);
  image_scan_ = read->scan;
  return {};
}

// The program that the controller has, read from it unless it is known.
LineLoop::Done LineLoop::know_program(const ControllerStatus& status) {
  if (status.digest == kNoProgram) {
    program_.reset();
    forces_.clear_all();
    image_.clear();
    plant_.fit(0, 0, own_time_ns());
    return {};
  }
  if (program_ != nullptr && program_->digest_bytes() == status.digest) return {};
  if (status.program_bytes > host::kMaxContainerBytes)
    return result::fail("R0143", {link_.name(), 0, 0}, "the controller's program has no possible size");
  std::vector<std::byte> container(status.program_bytes);
  if (auto read = link_.read_memory(control::Memory::Program, container,
                                    [this] { return !quit_.load(std::memory_order_acquire); });
      !read)
    return result::forward(read);
  const service::Sha256 digest = service::sha256(container);
  if (!std::ranges::equal(digest, status.digest))
    return result::fail("R0143", {link_.name(), 0, 0}, "the controller's program does not have its digest");
  auto program = RemoteProgram::create(std::move(container), service::to_hex(digest));
  if (!program) return result::forward(program);
  program_ = std::move(*program);
  forces_.clear_all();  // those that are known here were of another program
  image_.assign(program_->image_bytes(), std::byte{0});
  plant_.fit(program_->sizes().input_bytes, program_->sizes().output_bytes, own_time_ns());
  return {};
}

// Still the controller that was met, with the program that was seen.
LineLoop::Done LineLoop::check_identity(const ControllerStatus& status) {
  const ProgramDigest mine = program_ == nullptr ? kNoProgram : program_->digest_bytes();
  if (status.digest != mine) {
    return result::fail("R0143", {link_.name(), 0, 0}, "the controller has another program now",
                        "was it exchanged, or does somebody else download to it?");
  }
  // A count of milliseconds comes to its end after 49 days.
  const bool restarted = status.uptime_ms < uptime_ms_ && uptime_ms_ < 0xF000'0000;
  uptime_ms_ = status.uptime_ms;
  if (restarted) return result::fail("R0143", {link_.name(), 0, 0}, "the controller was restarted");
  return {};
}

// The controller cannot be trusted to hear this side: safe outputs for the plant, and nothing but a start
// leaves the fault.
void LineLoop::lose(const result::Diagnostics& why) {
  contact_ = false;
  ++losses_;
  sought_ns_ = wall_ns();
  line_problem_ = result::to_string(why);
  gate_.rest(reading());
  const bool ran = running();
  if (ran) now_.state = host::RuntimeState::Fault;
  plant_.make_safe(own_time_ns());
  if (ran) {
    emit(host::EventKind::Trap, "the controller was lost while it ran: " + line_problem_,
         scan::SafeCause::Trap);
  } else {
    publish();
    queues_.news().notify();
  }
}

}  // namespace stepwright::remote
