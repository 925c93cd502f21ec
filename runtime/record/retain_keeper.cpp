#include "runtime/record/retain_keeper.h"

#include <utility>

namespace stepwright::record {
namespace {

// "2 new (MAIN.a, ...)", or nothing.
void tell(std::string& text, const std::vector<std::string>& names, const char* what) {
  if (names.empty()) return;
  if (!text.empty()) text += ", ";
  text +=
      std::to_string(names.size()) + " " + what + " (" + names.front() + (names.size() > 1 ? ", ...)" : ")");
}

// What does not fit; empty if everything does.
std::string misfit(const TransferReport& report) {
  std::string text;
  tell(text, report.initialised, "new");
  tell(text, report.dropped, "gone");
  tell(text, report.retyped, "of another type");
  tell(text, report.shortened, "shortened");
  tell(text, report.references, "references");
  return text;
}

}  // namespace

std::unique_ptr<RetainKeeper> RetainKeeper::open(const RetainConfig& config) {
  return std::unique_ptr<RetainKeeper>(new RetainKeeper(config));
}

RetainKeeper::RetainKeeper(const RetainConfig& config) : config_(config), period_ns_(config.period_ns) {
  if (config.store.empty()) return;
  if (auto found = RetainStore::read(config.store)) {
    stored_ = std::move(*found);
    if (stored_ && !stored_->damage.empty())
      set_note(config.store.string() + ": " + stored_->damage + "; the other one is used");
  } else {
    std::string note = result::to_string(found.error());
    if (auto aside = RetainStore::set_aside(config.store)) note += "; it is kept as " + aside->string();
    set_note(note + "; retained variables have their initial values");
  }
  writer_ = std::make_unique<RetainWriter>(config.store, std::chrono::nanoseconds(config.period_ns), stored_);
}

result::Result<std::shared_ptr<RetainChannel>> RetainKeeper::prepare(const bytecode::Program& program) {
  auto values = RetainedValues::of(program);
  if (!values) return result::forward(values);
  auto channel = std::make_shared<RetainChannel>(std::move(*values));
  if (writer_ != nullptr && channel->values.size() > 0) writer_->add(channel);
  return channel;
}

const StateLayout* RetainKeeper::kept_layout() const {
  if (kept_from_ != nullptr) return &kept_from_->values.in_payload();
  return stored_ ? &stored_->layout : nullptr;
}

std::span<const std::byte> RetainKeeper::kept_payload() const {
  return kept_from_ != nullptr ? std::span<const std::byte>(kept_from_->kept) : stored_->payload;
}

result::Diagnostics RetainKeeper::refusal(const RetainChannel& channel, bool cold) const {
  const StateLayout* const kept = kept_layout();
  if (config_.policy != RetainPolicy::Refuse || cold || kept == nullptr || channel.values.size() == 0)
    return {};
  const auto transfer = VariableTransfer::between(*kept, channel.values.in_payload());
  const std::string text = misfit(transfer.report());
  if (text.empty()) return {};
  auto failed = result::fail("R0025", {config_.store.string(), 0, 0},
                             "the retained values do not fit the program: " + text,
                             "load the program that they belong to, or start cold, which gives them up");
  return std::move(failed.value());
}

void RetainKeeper::begin(RetainChannel& channel, std::span<std::byte> image, bool cold) {
  current_ = nullptr;
  if (channel.values.size() == 0) return;  // what is kept stays for the program that wants it
  const StateLayout* const kept = kept_layout();
  if (!cold && kept != nullptr) {
    const auto transfer = VariableTransfer::between(*kept, channel.values.in_image());
    const std::string text = misfit(transfer.report());
    const bool restored = text.empty() || config_.policy != RetainPolicy::Initialise;
    if (restored) transfer.apply(kept_payload(), image);
    if (!text.empty()) {
      set_note("retained values that do not fit the program: " + text +
               (restored ? "" : "; all have their initial values"));
    } else if (kept_from_ != nullptr) {
      set_note({});
    }
  }
  channel.values.area().gather(image, channel.kept);
  kept_from_ = channel.shared_from_this();
  stored_.reset();
  current_ = &channel;
  due_ns_ = 0;
  publish(image);
  if (writer_ == nullptr) return;
  writer_->use(channel);
  writer_->ring();
}

void RetainKeeper::finish(std::span<const std::byte> image) {
  if (current_ == nullptr) return;
  current_->values.area().gather(image, current_->kept);
  publish(image);
  if (writer_ != nullptr) writer_->ring();
  current_ = nullptr;
}

void RetainKeeper::change(RetainChannel& channel, std::span<const std::byte> image) {
  current_ = nullptr;
  if (channel.values.size() == 0) return;
  kept_from_ = channel.shared_from_this();
  current_ = &channel;
  publish(image);
  if (writer_ != nullptr) writer_->use(channel);
}

void RetainKeeper::publish(std::span<const std::byte> image) {
  if (writer_ == nullptr) return;
  current_->values.area().gather(image, current_->buffer.back());
  current_->buffer.publish(++number_);
}

std::string RetainKeeper::note() const {
  std::string text = writer_ == nullptr ? std::string() : writer_->note();
  const std::lock_guard lock(mutex_);
  if (text.empty() || note_.empty()) return text + note_;
  return note_ + "; " + text;
}

void RetainKeeper::set_note(std::string note) {
  const std::lock_guard lock(mutex_);
  note_ = std::move(note);
}

}  // namespace stepwright::record
