#include "runtime/record/retain_manager.h"

#include <utility>

namespace stepwright::record {
namespace {

// The source of what a store held; programs are numbered from 1.
constexpr std::uint64_t kStore = 0;

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

std::unique_ptr<RetainManager> RetainManager::open(const RetainConfig& config) {
  return std::unique_ptr<RetainManager>(new RetainManager(config));
}

RetainManager::RetainManager(const RetainConfig& config) : config_(config), period_ns_(config.period_ns) {
  if (config.store.empty()) return;
  if (auto found = RetainStore::read(config.store)) {
    if (*found) found_ = std::make_shared<const StoredState>(std::move(**found));
    if (found_ && !found_->damage.empty())
      set_note(config.store.string() + ": " + found_->damage + "; the other one is used");
  } else {
    std::string note = result::to_string(found.error());
    if (auto aside = RetainStore::set_aside(config.store)) note += "; it is kept as " + aside->string();
    set_note(note + "; retained variables have their initial values");
  }
  writer_ = std::make_unique<RetainWriter>(config.store, std::chrono::nanoseconds(config.period_ns),
                                           found_ ? std::optional(*found_) : std::nullopt);
}

result::Result<std::shared_ptr<RetainChannel>> RetainManager::prepare(const bytecode::Program& program) {
  auto values = RetainedValues::of(program);
  if (!values) return result::forward(values);
  auto channel = std::make_shared<RetainChannel>(std::move(*values));
  if (channel->values.size() == 0) return channel;
  forget_unused();
  channel->source = ++sources_;
  if (found_ && !begun_.load(std::memory_order_acquire))
    channel->arrivals.push_back(arrival(kStore, found_->layout, *channel));
  for (const auto& each : channels_)
    channel->arrivals.push_back(arrival(each->source, each->values.in_payload(), *channel));
  channel->arrivals.push_back(arrival(channel->source, channel->values.in_payload(), *channel));
  channels_.push_back(channel);
  if (writer_ != nullptr) writer_->add(channel);
  return channel;
}

RetainArrival RetainManager::arrival(std::uint64_t source, const StateLayout& from,
                                     const RetainChannel& to) const {
  RetainArrival arrival{source, VariableTransfer::between(from, to.values.in_image()), {}, {}};
  arrival.misfit = misfit(arrival.transfer.report());
  if (config_.policy == RetainPolicy::Refuse)
    arrival.refusal = misfit(VariableTransfer::between(from, to.values.in_payload()).report());
  return arrival;
}

// What only this list, and that of the writer, still hold.
void RetainManager::forget_unused() {
  const long holders = writer_ == nullptr ? 1 : 2;
  std::erase_if(channels_, [&](const auto& each) { return each.use_count() <= holders; });
}

std::optional<std::uint64_t> RetainManager::kept_source() const {
  if (kept_from_ != nullptr) return kept_from_->source;
  if (found_ && !begun_.load(std::memory_order_relaxed)) return kStore;
  return std::nullopt;
}

const StateLayout& RetainManager::kept_layout() const {
  return kept_from_ != nullptr ? kept_from_->values.in_payload() : found_->layout;
}

std::span<const std::byte> RetainManager::kept_payload() const {
  return kept_from_ != nullptr ? std::span<const std::byte>(kept_from_->kept) : found_->payload;
}

result::Diagnostics RetainManager::refusal(const RetainChannel& channel, bool cold) const {
  const auto source = kept_source();
  if (config_.policy != RetainPolicy::Refuse || cold || !source || channel.values.size() == 0) return {};
  const RetainArrival* const prepared = channel.arrival_from(*source);
  const std::string text =
      prepared != nullptr ? prepared->refusal : arrival(*source, kept_layout(), channel).refusal;
  if (text.empty()) return {};
  auto failed = result::fail("R0025", {config_.store.string(), 0, 0},
                             "the retained values do not fit the program: " + text,
                             "load the program that they belong to, or start cold, which gives them up");
  return std::move(failed.value());
}

// A source that was prepared later than the program is none that a runtime has; then it is worked out here.
void RetainManager::restore(const RetainChannel& channel, std::uint64_t source, std::span<std::byte> image) {
  const RetainArrival* prepared = channel.arrival_from(source);
  std::optional<RetainArrival> late;
  if (prepared == nullptr) prepared = &late.emplace(arrival(source, kept_layout(), channel));
  const bool restored = prepared->misfit.empty() || config_.policy != RetainPolicy::Initialise;
  if (restored) prepared->transfer.apply(kept_payload(), image);
  if (!prepared->misfit.empty()) {
    set_note("retained values that do not fit the program: " + prepared->misfit +
             (restored ? "" : "; all have their initial values"));
  } else if (kept_from_ != nullptr && noted_.load(std::memory_order_acquire)) {
    set_note({});
  }
}

void RetainManager::begin(RetainChannel& channel, std::span<std::byte> image, bool cold) {
  current_ = nullptr;
  if (channel.values.size() == 0) return;  // what is kept stays for the program that wants it
  if (const auto source = kept_source(); source && !cold) restore(channel, *source, image);
  channel.values.area().gather(image, channel.kept);
  kept_from_ = channel.shared_from_this();
  begun_.store(true, std::memory_order_release);
  current_ = &channel;
  due_ns_ = 0;
  publish(image);
  if (writer_ == nullptr) return;
  writer_->use(channel);
  writer_->notify();
}

void RetainManager::finish(std::span<const std::byte> image) {
  if (current_ == nullptr) return;
  current_->values.area().gather(image, current_->kept);
  publish(image);
  if (writer_ != nullptr) writer_->notify();
  current_ = nullptr;
}

void RetainManager::change(RetainChannel& channel, std::span<const std::byte> image) {
  current_ = nullptr;
  if (channel.values.size() == 0) return;
  kept_from_ = channel.shared_from_this();
  current_ = &channel;
  publish(image);
  if (writer_ != nullptr) writer_->use(channel);
}

void RetainManager::publish(std::span<const std::byte> image) {
  if (writer_ == nullptr) return;
  current_->values.area().gather(image, current_->buffer.back());
  current_->buffer.publish(++number_);
}

std::string RetainManager::note() const {
  std::string text = writer_ == nullptr ? std::string() : writer_->note();
  const std::lock_guard lock(mutex_);
  if (text.empty() || note_.empty()) return text + note_;
  return note_ + "; " + text;
}

void RetainManager::set_note(std::string note) {
  const std::lock_guard lock(mutex_);
  noted_.store(!note.empty(), std::memory_order_release);
  note_ = std::move(note);
}

}  // namespace stepwright::record
