#include "runtime/record/retain_writer.h"

#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

namespace stepwright::record {
namespace {

using std::chrono::nanoseconds;

// While writing fails it is tried again this often at most.
constexpr nanoseconds kRetry = std::chrono::milliseconds(500);

// A file that reaches the limit of this process for files is an error like a full disk, not the end.
void keep_file_size_signal_out() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGXFSZ);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

// Until a notification, or for that time; without a time until a notification.
void wait(int event, std::optional<nanoseconds> time) {
  pollfd entry{event, POLLIN, 0};
  const nanoseconds span = time.value_or(nanoseconds(0));
  const timespec limit{static_cast<time_t>(span.count() / 1'000'000'000),
                       static_cast<long>(span.count() % 1'000'000'000)};
  ppoll(&entry, 1, time ? &limit : nullptr, nullptr);
  std::uint64_t count = 0;
  if (entry.revents != 0) static_cast<void>(!read(event, &count, sizeof count));
}

}  // namespace

RetainWriter::RetainWriter(std::filesystem::path path, nanoseconds period, std::optional<StoredState> found)
    : path_(std::move(path)), period_(period), found_(std::move(found)) {
  event_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  if (found_) sequence_ = found_->sequence;
  thread_ = std::thread([this] { run(); });
}

RetainWriter::~RetainWriter() {
  quit_.store(true, std::memory_order_release);
  notify();
  thread_.join();
  if (event_ >= 0) close(event_);
}

void RetainWriter::add(std::shared_ptr<RetainChannel> channel) {
  const std::lock_guard lock(mutex_);
  // A program that ended has left its channel to this list alone.
  const RetainChannel* const used = current_.load(std::memory_order_acquire);
  std::erase_if(channels_, [&](const auto& each) { return each.get() != used && each.use_count() == 1; });
  channels_.push_back(std::move(channel));
}

void RetainWriter::notify() const {
  const std::uint64_t one = 1;
  static_cast<void>(!write(event_, &one, sizeof one));
}

std::string RetainWriter::note() const {
  const std::lock_guard lock(mutex_);
  return note_;
}

void RetainWriter::set_note(std::string note) {
  const std::lock_guard lock(mutex_);
  note_ = std::move(note);
}

std::shared_ptr<RetainChannel> RetainWriter::current() {
  const std::lock_guard lock(mutex_);
  const RetainChannel* const used = current_.load(std::memory_order_acquire);
  const auto found =
      std::find_if(channels_.begin(), channels_.end(), [&](const auto& each) { return each.get() == used; });
  return found == channels_.end() ? nullptr : *found;
}

void RetainWriter::run() {
  keep_file_size_signal_out();
  while (true) {
    // Asked before the turn: what was published before the end is seen in the last turn.
    const bool last = quit_.load(std::memory_order_acquire);
    turn();
    if (last) return;
    if (event_ < 0 || unwritten_) {
      wait(event_, std::max(period_, kRetry));
    } else if (writing_ != nullptr) {
      wait(event_, period_);
    } else {
      wait(event_, std::nullopt);
    }
  }
}

// The last values of the program before, then those of the present one.
void RetainWriter::turn() {
  const auto drain = [this] {
    if (writing_ == nullptr) return;
    if (writing_->buffer.take()) unwritten_ = true;
    if (unwritten_ && save(*writing_)) {
      unwritten_ = false;
      committed_.store(writing_->buffer.number(), std::memory_order_release);
    }
  };
  drain();
  std::shared_ptr<RetainChannel> now = current();
  if (now == nullptr || now == writing_) return;
  writing_ = std::move(now);
  unwritten_ = false;
  drain();
}

bool RetainWriter::save(RetainChannel& channel) {
  const std::span<const std::byte> payload = channel.buffer.front();
  const StateLayout& layout = channel.values.in_payload();
  const bool fits = found_ && found_->layout == layout;
  if (fits && !store_) {
    if (auto store = RetainStore::resume(path_, *found_)) {
      store_ = std::move(*store);
      written_ = found_->damage.empty() ? found_->payload : std::vector<std::byte>();
    }
  }
  if (fits && store_ && std::equal(payload.begin(), payload.end(), written_.begin(), written_.end())) {
    return true;
  }
  result::Result<void> saved;
  if (fits && store_) {
    saved = store_->write(payload);
  } else {
    auto store = RetainStore::create(path_, layout, payload, sequence_ + 1);
    if (store) {
      store_ = std::move(*store);
      found_ = StoredState{layout, {}, 0, {}};
    } else {
      saved = result::forward(store);
    }
  }
  if (!saved) {
    set_note(result::to_string(saved.error()) + "; it is tried again");
    written_.clear();  // what the slot holds is not known any more
    if (!store_ || !store_->is_there()) {
      store_.reset();
      found_.reset();
    }
    return false;
  }
  sequence_ = store_->sequence();
  written_.assign(payload.begin(), payload.end());
  set_note({});
  return true;
}

}  // namespace stepwright::record
