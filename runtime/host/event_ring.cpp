#include "runtime/host/event_ring.h"

#include <algorithm>
#include <cassert>

namespace stepwright::host {
namespace {

// The slots that an event of this kind must leave to others.
std::size_t left_free(EventKind kind) {
  switch (kind) {
    case EventKind::Trap:
    case EventKind::RolledBack:
      return 0;
    case EventKind::StepChange:
      return 2;
    default:
      return 1;
  }
}

}  // namespace

EventRing::EventRing(std::size_t image_bytes, std::size_t plant_values) {
  const std::size_t slot_bytes = sizeof(Slot) + image_bytes + plant_values * sizeof(double);
  slots_.resize(std::clamp(kBytes / slot_bytes, kFewestSlots, kMostSlots));
  for (Slot& slot : slots_) {
    slot.image.resize(image_bytes);
    slot.plant.resize(plant_values);
  }
}

void EventRing::warm() {
  if (full()) return;
  std::vector<std::byte>& image = slots_[tail_.load(std::memory_order_relaxed)].image;
  std::fill(image.begin(), image.end(), std::byte{0});
}

std::size_t EventRing::room() const {
  const std::size_t head = head_.load(std::memory_order_acquire);
  const std::size_t tail = tail_.load(std::memory_order_acquire);
  const std::size_t held = tail >= head ? tail - head : tail + slots_.size() - head;
  return slots_.size() - 1 - held;
}

bool EventRing::full() const {
  return room() <= left_free(EventKind::StepChange);
}

bool EventRing::push(const EventNote& note, std::span<const std::byte> image, std::span<const double> plant) {
  if (room() <= left_free(note.kind)) return false;
  const std::size_t tail = tail_.load(std::memory_order_relaxed);
  Slot& slot = slots_[tail];
  assert(image.size() == slot.image.size() && plant.size() == slot.plant.size());
  slot.note = note;
  std::copy(image.begin(), image.end(), slot.image.begin());
  std::copy(plant.begin(), plant.end(), slot.plant.begin());
  tail_.store(after(tail), std::memory_order_release);
  return true;
}

const EventRing::Slot* EventRing::front() const {
  const std::size_t head = head_.load(std::memory_order_relaxed);
  return head == tail_.load(std::memory_order_acquire) ? nullptr : &slots_[head];
}

void EventRing::pop() {
  head_.store(after(head_.load(std::memory_order_relaxed)), std::memory_order_release);
}

}  // namespace stepwright::host
