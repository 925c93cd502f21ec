// A program on its way to the controller.

#include <algorithm>
#include <array>
#include <utility>

#include "runtime/remote/line_loop.h"

namespace stepwright::remote {

host::Completion LineLoop::load(const RemoteCommand& asked) {
  const std::uint64_t ticket = asked.command.ticket;
  if (auto fit = fits(*asked.program); !fit) return failed(ticket, std::move(fit.error()));
  if (auto moved = bring(*asked.program); !moved) {
    const bool said_no = moved.error().front().code == kControllerRefuses;
    return said_no ? failed(ticket, std::move(moved.error())) : lost(ticket, std::move(moved.error()));
  }
  if (running()) {
    gate_.rest(reading());
    now_.state = host::RuntimeState::Stopped;
    emit(host::EventKind::Stopped, "another program was loaded");
  }
  if (auto adopted = adopt(asked.program); !adopted) return lost(ticket, std::move(adopted.error()));
  return {ticket, host::Outcome::Done, {}};
}

// What the controller says about its limits, before anything is sent.
LineLoop::Done LineLoop::fits(const RemoteProgram& program) {
  if (auto areas = program.check_fit(config_.host.input_bytes, config_.host.output_bytes); !areas)
    return areas;
  auto status = link_.status();
  if (!status) return result::forward(status);
  const auto refuse = [&](const char* what, std::size_t has, std::size_t limit) {
    return result::fail("R0145", {"download", 0, 0},
                        std::string("the program's ") + what + " takes " + std::to_string(has) +
                            " bytes, and the controller at " + link_.name() + " has room for " +
                            std::to_string(limit),
                        "fewer actions or variables, or a larger controller");
  };
  if (program.bytes().size() > status->max_program_bytes)
    return refuse("container", program.bytes().size(), status->max_program_bytes);
  if (program.program().memory_size() > status->max_image_bytes)
    return refuse("image", program.program().memory_size(), status->max_image_bytes);
  return {};
}

// A program that is there already is stopped and freed of forces; the flash is spared.
LineLoop::Done LineLoop::bring(const RemoteProgram& program) {
  const bool there = program_ != nullptr && program_->digest() == program.digest();
  if (!there) return transfer(program);
  if (running()) {
    if (auto read = link_.read_memory(control::Memory::Image, image_); !read) return result::forward(read);
  }
  if (auto stopped = link_.command(control::Command::Stop); !stopped) return tl::unexpected(stopped.error());
  for (const image::Force& force : forces_.forces()) {
    if (auto freed = link_.command(control::Command::Unforce,
                                   bits_arguments(image::bits_of(force), program.digest_bytes()));
        !freed)
      return tl::unexpected(freed.error());
  }
  return {};
}

// The container in pieces. By the clock what runs goes on meanwhile, and so do its inputs and outputs, and a
// stop does not wait for the last piece.
LineLoop::Done LineLoop::transfer(const RemoteProgram& program) {
  const auto exchange_if_due = [this] {
    if (simulated() || program_ == nullptr || due_ns_ > wall_ns()) return true;
    due_ns_ = wall_ns() + std::chrono::nanoseconds(config_.exchange_period).count();
    return exchange_by_clock().has_value();
  };
  const auto want = [&](const result::Result<CommandAnswer>& answer) -> Done {
    if (!answer) return tl::unexpected(answer.error());
    if (answer->done()) return {};
    return tl::unexpected(refusal(*answer));
  };
  const auto bytes = program.bytes();
  std::array<std::uint16_t, 2 + control::kDigestRegisters> begin{};
  control::put32(begin, 0, static_cast<std::uint32_t>(bytes.size()));
  control::put_bytes(std::span(begin).subspan(2), program.digest_bytes());
  if (auto begun = want(link_.command(control::Command::TransferBegin, begin, exchange_if_due)); !begun)
    return begun;
  for (std::size_t at = 0; at < bytes.size(); at += control::transfer::kMaxBytes) {
    const auto piece =
        bytes.subspan(at, std::min<std::size_t>(control::transfer::kMaxBytes, bytes.size() - at));
    if (auto sent = link_.send_piece(static_cast<std::uint32_t>(at), piece); !sent) return sent;
    take_urgent();
    if (!contact_ || !exchange_if_due())
      return result::fail("R0141", {link_.name(), 0, 0}, "lost during a download");
  }
  if (running() && program_ != nullptr) {
    // The last image of what the commit stops.
    if (auto read = link_.read_memory(control::Memory::Image, image_, exchange_if_due); !read)
      return result::forward(read);
  }
  return want(link_.command(control::Command::TransferCommit, {}, exchange_if_due));
}

LineLoop::Done LineLoop::adopt(std::shared_ptr<const RemoteProgram> program) {
  auto status = link_.status();
  if (!status) return result::forward(status);
  if (status->digest != program->digest_bytes() || status->state == control::State::Running)
    return result::fail("R0143", {link_.name(), 0, 0}, "the controller did not load what it committed");
  program_ = std::move(program);
  detail_.clear();  // of the program before
  known_event_ = status->event;
  forces_.clear_all();
  now_.state = host::RuntimeState::Stopped;
  plant_.fit(program_->sizes().input_bytes, program_->sizes().output_bytes, own_time_ns());
  image_.assign(program_->image_bytes(), std::byte{0});
  auto outputs = link_.outputs(plant_.outputs());
  if (!outputs) return result::forward(outputs);
  turn_ = outputs->turn;
  now_.scan = outputs->scan;
  now_.trace_hash = outputs->trace_hash;
  static_cast<void>(plant_.write(own_time_ns()));
  auto read = link_.read_memory(control::Memory::Image, image_);
  if (!read) return result::forward(read);
  image_scan_ = read->scan;
  return {};
}

}  // namespace stepwright::remote
