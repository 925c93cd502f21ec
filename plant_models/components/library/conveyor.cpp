#include <algorithm>
#include <array>
#include <cmath>

#include "plant_models/components/library/fault_specs.h"
#include "plant_models/components/library/types.h"

namespace stepwright::components::library {
namespace {

enum Port : std::size_t { kShaft, kRun, kPlace, kSeen, kAtEnd, kSpeed, kItems, kLeft, kTravel };
enum Fault : std::size_t { kSlips, kJammed };
constexpr std::size_t kMostItems = 64;

// A belt that items lie on. It remembers at which travel of the belt each of them was put down at its
// beginning.
class Conveyor final : public Component {
 public:
  explicit Conveyor(const Parameters& p)
      : length_(p["length"]),
        item_(p["item"]),
        spacing_(p["spacing"]),
        eye_(p["eye"]),
        radius_(p["radius"]),
        speed_(p["speed"]),
        friction_(p["friction"]) {
    add_state({.tolerance = 1e-7});
    set_roots(4);
  }

  void evaluate(std::uint32_t stage, const Frame& f) const override {
    if (stage == 0) {
      across(f, kSeen) = seen_ ? 1.0 : 0.0;
      across(f, kAtEnd) = at_end_ ? 1.0 : 0.0;
      across(f, kItems) = static_cast<double>(count_);
      across(f, kLeft) = static_cast<double>(left_);
      across(f, kTravel) = y(f, 0);
      return;
    }
    const double turning = across(f, kShaft);
    const double driven = connected(kShaft) ? turning * radius_ : across(f, kRun) >= 0.5 ? speed_ : 0.0;
    across(f, kSpeed) = fault(kJammed) >= 0.5 ? 0.0 : driven * (1.0 - fault(kSlips));
    through(f, kShaft) = -friction_ * turning;
  }
  void derivative(const Frame& f) const override { dydt(f, 0) = across(f, kSpeed); }

  void roots(const Frame& f, double* g) const override {
    const double s = y(f, 0);
    g[0] = waits_ && count_ > 0 ? s - last_ - spacing_ : -1.0;
    g[1] = nearest(s, eye_);
    g[2] = nearest(s, length_);
    g[3] = count_ > 0 ? s - entry_[first_] - length_ - 0.5 * item_ : -1.0;
  }
  Event handle(const Frame& f, const int* signs, double*) override {
    if (signs[0] > 0) put_down(y(f, 0));
    if (signs[1] != 0) seen_ = signs[1] < 0;
    if (signs[2] != 0) at_end_ = signs[2] < 0;
    if (signs[3] > 0) drop();
    return Event::Changed;
  }
  bool settle(const Frame& f) override {
    waits_ = across(f, kPlace) >= 0.5;
    const double s = y(f, 0);
    if (!waits_ || (count_ > 0 && s - last_ < spacing_)) return false;
    put_down(s);
    const bool seen = nearest(s, eye_) <= 0.0;
    const bool changed = seen != seen_;
    seen_ = seen;
    return changed;
  }

 private:
  void put_down(double s) {
    if (count_ == kMostItems) return;
    entry_[(first_ + count_) % kMostItems] = last_ = s;
    ++count_;
  }
  void drop() {
    first_ = (first_ + 1) % kMostItems;
    --count_;
    ++left_;
  }
  // How far the nearest item's edge is from a place; negative inside of it.
  double nearest(double s, double place) const {
    double distance = 1.0;
    for (std::size_t i = 0; i < count_; ++i)
      distance = std::min(distance, std::abs(s - entry_[(first_ + i) % kMostItems] - place) - 0.5 * item_);
    return distance;
  }

  double length_, item_, spacing_, eye_, radius_, speed_, friction_;
  std::array<double, kMostItems> entry_{};
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  std::int64_t left_ = 0;
  double last_ = 0.0;
  bool waits_ = false;  // somebody holds the next item ready
  bool seen_ = false;
  bool at_end_ = false;
};

class PhotoEye final : public Component {
 public:
  explicit PhotoEye(const Parameters& p) : dark_(p.is("contact", "dark")) {}
  void evaluate(std::uint32_t, const Frame& f) const override {
    const bool sees = across(f, 0) >= 0.5 && fault(1) < 0.5;
    const bool shows = fault(0) == fault(0) ? fault(0) >= 0.5 : sees == dark_;
    across(f, 1) = shows && fault(2) < 0.5 ? 1.0 : 0.0;
  }

 private:
  bool dark_;
};

}  // namespace

ComponentType conveyor_type() {
  return {.name = "conveyor",
          .meaning =
              "a belt, driven by a shaft or at a constant speed, that items are put on at its beginning and "
              "fall off at its end",
          .parameters = {{.name = "length",
                          .unit = "m",
                          .fallback = "2 m",
                          .low = 1e-2,
                          .high = 1e4,
                          .meaning = "from where items are put down to its end"},
                         {.name = "item",
                          .unit = "m",
                          .fallback = "0.2 m",
                          .low = 1e-3,
                          .high = 100.0,
                          .meaning = "length of an item"},
                         {.name = "spacing",
                          .unit = "m",
                          .fallback = "0.4 m",
                          .low = 1e-3,
                          .high = 100.0,
                          .meaning = "from item to item at least"},
                         {.name = "eye",
                          .unit = "m",
                          .fallback = "1 m",
                          .low = 0.0,
                          .high = 1e4,
                          .meaning = "place that `seen` is of"},
                         {.name = "speed",
                          .unit = "m/s",
                          .fallback = "0.5 m/s",
                          .low = 0.0,
                          .high = 100.0,
                          .meaning = "without a shaft"},
                         {.name = "radius",
                          .unit = "m",
                          .fallback = "0.05 m",
                          .low = 1e-4,
                          .high = 10.0,
                          .meaning = "of its drum, gear included: travel per turning of the shaft"},
                         {.name = "friction",
                          .unit = "N m s",
                          .fallback = "0.01 N m s",
                          .low = 0.0,
                          .high = 1e6,
                          .meaning = "that the shaft feels, per speed"}},
          .ports = {{.name = "shaft",
                     .kind = PortKind::Rotation,
                     .stage = 1,
                     .reads = 1,
                     .open = Open::Fine,
                     .meaning = "a motor"},
                    {.name = "run",
                     .kind = PortKind::Logic,
                     .reads = 1,
                     .open = Open::Constant,
                     .meaning = "without a shaft: it runs"},
                    {.name = "place",
                     .kind = PortKind::Logic,
                     .open = Open::Constant,
                     .meaning = "somebody puts down items as often as there is room"},
                    {.name = "seen",
                     .kind = PortKind::Logic,
                     .role = Role::Node,
                     .open = Open::Fine,
                     .meaning = "an item is at the eye"},
                    {.name = "at_end",
                     .kind = PortKind::Logic,
                     .role = Role::Node,
                     .open = Open::Fine,
                     .meaning = "an item is at the end"},
                    {.name = "speed_out",
                     .role = Role::Node,
                     .unit = "m/s",
                     .stage = 1,
                     .open = Open::Fine,
                     .meaning = "of the belt"},
                    {.name = "items", .role = Role::Node, .open = Open::Fine, .meaning = "that lie on it"},
                    {.name = "left",
                     .role = Role::Node,
                     .open = Open::Fine,
                     .meaning = "items that have fallen off its end"},
                    {.name = "travel",
                     .role = Role::Node,
                     .unit = "m",
                     .open = Open::Fine,
                     .meaning = "of the belt so far"}},
          .faults = {{.name = "slips",
                      .unit = "percent",
                      .low = 0.0,
                      .high = 100.0,
                      .rest = 0.0,
                      .meaning = "it is slower by this"},
                     flag_fault("jammed", "1: it stands")},
          .stages = 2,
          .make = [](const Parameters& p) { return std::make_unique<Conveyor>(p); }};
}

ComponentType photo_eye_type() {
  return {.name = "photo_eye",
          .meaning = "a light barrier as a contact",
          .parameters = {{.name = "contact",
                          .fallback = "dark",
                          .meaning = "dark: closed while something is there; light: open",
                          .choices = {"dark", "light"}}},
          .ports = {{.name = "of",
                     .kind = PortKind::Logic,
                     .reads = 0,
                     .meaning = "something is there: conveyor.seen"},
                    {.name = "contact_out",
                     .kind = PortKind::Logic,
                     .role = Role::Node,
                     .open = Open::Fine,
                     .meaning = "what the program sees"}},
          .faults = {contact_fault("stuck", "the program sees this whatever is there"),
                     flag_fault("blind", "1: it sees nothing any more"),
                     flag_fault("broken_wire", "1: its wire is broken, whatever its contact does")},
          .make = [](const Parameters& p) { return std::make_unique<PhotoEye>(p); }};
}

}  // namespace stepwright::components::library
