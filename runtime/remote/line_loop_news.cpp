// Events, images and figures on their way to the service.

#include <algorithm>
#include <utility>

#include "runtime/ground/result/counted.h"
#include "runtime/host/status_detail.h"
#include "runtime/remote/line_loop.h"

namespace stepwright::remote {
namespace {

constexpr double kNsPerUs = 1'000.0;
// Of the line's time at most one part in so many goes into images that no event asks for.
constexpr std::int64_t kImageShare = 10;

}  // namespace

// What happened on the controller since the event that is known. The image of the newest one only is left.
LineLoop::Done LineLoop::take_events(const ControllerStatus& status) {
  if (status.event == known_event_) {
    const bool same = static_cast<unsigned>(status.state) == static_cast<unsigned>(now_.state);
    // After a loss it is stopped and this side at fault until somebody starts it again.
    const bool at_rest = status.state != control::State::Running && !running();
    if (same || at_rest) return {};
    return result::fail("R0143", {link_.name(), 0, 0}, "the controller changed its state without an event");
  }
  if (program_ == nullptr) {
    known_event_ = status.event;
    return {};
  }
  events_.lost += status.event - known_event_ - 1;
  known_event_ = status.event;
  if (auto read = read_event_image(); !read) return read;
  const std::uint64_t scan = std::exchange(now_.scan, status.event_scan);
  switch (status.event_kind) {
    case control::Event::Started:
      now_.state = host::RuntimeState::Running;
      emit(host::EventKind::Started, {});
      break;
    case control::Event::StepChange:
      emit(host::EventKind::StepChange, {});
      break;
    case control::Event::Stopped:
      gate_.rest(reading());
      now_.state = host::RuntimeState::Stopped;
      emit(host::EventKind::Stopped, "at the controller, by somebody else");
      break;
    case control::Event::Trap:
      gate_.rest(reading());
      now_.state = host::RuntimeState::Fault;
      ++now_.process.traps;
      emit(host::EventKind::Trap, trap_detail(status), scan::SafeCause::Trap);
      break;
  }
  now_.scan = std::max(scan, now_.scan);
  return {};
}

std::string LineLoop::trap_detail(const ControllerStatus& status) const {
  if (status.trap) return result::to_string(reader::describe(program_->program(), status.trap));
  if (status.inputs_lost()) return "the controller heard nothing of its plant for too long";
  return "the controller is at fault and does not say why";
}

LineLoop::Done LineLoop::read_event_image() {
  auto head = link_.read_memory(control::Memory::EventImage, image_);
  if (!head) return result::forward(head);
  image_scan_ = head->scan;
  image_due_ns_ = wall_ns() + std::chrono::nanoseconds(config_.image_period).count();
  return {};
}

LineLoop::Done LineLoop::refresh_image() {
  const std::int64_t begin_ns = wall_ns();
  if (begin_ns < image_due_ns_ || program_ == nullptr) return {};
  auto head = link_.read_memory(control::Memory::Image, image_);
  if (!head) return result::forward(head);
  image_scan_ = head->scan;
  const std::int64_t took_ns = wall_ns() - begin_ns;
  image_due_ns_ =
      wall_ns() + std::max(std::chrono::nanoseconds(config_.image_period).count(), kImageShare * took_ns);
  return {};
}

void LineLoop::emit(host::EventKind kind, std::string detail, scan::SafeCause cause) {
  if (kind == host::EventKind::StepChange) gate_.stand(reading());
  host::StepEvent event;
  event.sequence = events_.next();
  event.scan = now_.scan;
  event.time_ns = now_.time_ns;
  event.kind = kind;
  if (program_ != nullptr) event.program_digest = program_->digest();
  event.detail = std::move(detail);
  event.cause = cause;
  event.image = image_;
  event.plant = plant_.named_truths();
  detail_ = event.detail;
  publish();  // who sees the event must find a status that is at least as new
  events_.handed_over(queues_.add(std::move(event)));
}

void LineLoop::publish_if_due() {
  if (wall_ns() - published_ns_ >= host::kPublishPeriodNs) publish();
}

void LineLoop::publish() {
  published_ns_ = wall_ns();
  plant_.beat();
  now_.waiting_for_supervisor = gate_.waits_for_supervisor();
  now_.realtime_factor = gate_.factor(published_ns_, now_.time_ns).value_or(now_.realtime_factor);
  now_.scan_p50_us = static_cast<double>(turns_.percentile_ns(50'000)) / kNsPerUs;
  now_.scan_p99_us = static_cast<double>(turns_.percentile_ns(99'000)) / kNsPerUs;
  now_.scan_max_us = static_cast<double>(turns_.max_ns()) / kNsPerUs;
  RemoteFigures figures{now_, program_, {}, contact_, line_problem_, link_.repeated(), losses_};
  host::RuntimeStatus& status = figures.status;
  status.program_digest = program_ == nullptr ? std::string() : program_->digest();
  status.detail = detail_;
  const auto note = [&](const std::string& text) { host::add_detail(status, text); };
  note(line_problem_);
  if (link_.repeated() > 0)
    note(result::counted(link_.repeated(), "request was", "requests were") + " repeated");
  if (losses_ > 0) note("the line was lost " + result::counted(losses_, "time", "times"));
  host::add_events(status, events_);
  const auto truths = plant_.truths();
  status.plant = plant_.named_truths();
  for (image::Force force : forces_.forces()) {
    if (force.end_ns != image::kNoEnd) force.end_ns = std::max<std::int64_t>(0, force.end_ns - published_ns_);
    figures.forces.push_back(force);
  }
  if (program_ != nullptr) snapshots_.publish(now_.scan, now_.time_ns, program_->digest(), image_, truths);
  queues_.publish(std::move(figures));
}

}  // namespace stepwright::remote
