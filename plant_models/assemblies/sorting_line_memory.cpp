// What outlives the process that simulates the line: numbers in the order of keep().

#include <algorithm>
#include <cmath>

#include "plant_models/assemblies/sorting_line.h"

namespace stepwright::assemblies {
namespace {

// Reads or writes numbers one after the other.
class Writer {
 public:
  explicit Writer(std::span<double> numbers) : numbers_(numbers) {}
  void operator()(double value) { numbers_[at_++] = value; }

 private:
  std::span<double> numbers_;
  std::size_t at_ = 0;
};

class Reader {
 public:
  explicit Reader(std::span<const double> numbers) : numbers_(numbers) {}
  double operator()() { return numbers_[at_++]; }
  template <typename Number>
  Number whole() {
    return static_cast<Number>(operator()());
  }

 private:
  std::span<const double> numbers_;
  std::size_t at_ = 0;
};

constexpr std::size_t kPerBox = 10;
constexpr std::size_t kPerBelt = 2;
constexpr std::size_t kPerChute = 3;
constexpr std::size_t kOfTheLine = 3;

}  // namespace

std::size_t SortingLine::kept_size() const {
  return kOfTheLine + kPerBox * boxes_.size() + kPerBelt * belts_.size() + pushers_.size() +
         kPerChute * chutes_.size();
}

void SortingLine::keep(std::span<double> numbers) const {
  Writer write(numbers);
  write(static_cast<double>(boxes_.size()));
  write(static_cast<double>(next_));
  write(free_s_);
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    const Box& box = boxes_[i];
    const body2d::Pose pose = world_.pose(box.body);
    const body2d::Motion motion = world_.motion(box.body);
    write(static_cast<double>(list_[i]));
    write(static_cast<double>(box.state));
    write(box.chute);
    write(box.rank);
    write(pose.position.x), write(pose.position.y), write(pose.angle);
    write(motion.velocity.x), write(motion.velocity.y), write(motion.spin);
  }
  for (const Belt& belt : belts_) write(belt.drive.speed_m_s()), write(belt.drive.current_a());
  for (const Pusher& pusher : pushers_) write(pusher.travel_m);
  for (const Chute& chute : chutes_) write(chute.dark ? 1.0 : 0.0), write(chute.counted), write(chute.got);
}

bool SortingLine::resume(std::span<const double> numbers) {
  const bool finite = std::all_of(numbers.begin(), numbers.end(), [](double v) { return std::isfinite(v); });
  if (numbers.size() != kept_size() || !finite || numbers[0] != static_cast<double>(boxes_.size()))
    return false;
  Reader read(numbers.subspan(1));
  next_ = std::min(read.whole<std::size_t>(), list_.size());
  free_s_ = read();
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    Box& box = boxes_[i];
    list_[i] = std::min(read.whole<std::size_t>(), boxes_.size() - 1);
    box.state = static_cast<BoxState>(std::clamp(read(), 0.0, 4.0));
    box.chute = read.whole<int>();
    box.rank = read.whole<int>();
    const double x = read(), y = read(), angle = read();
    const double vx = read(), vy = read(), spin = read();
    world_.place(box.body, {{x, y}, angle}, {{vx, vy}, spin});
    world_.set_present(box.body, box.state == BoxState::OnTheLine);
  }
  for (Belt& belt : belts_) {
    const double speed = read();
    belt.drive.restore(std::max(speed, 0.0), read());
  }
  for (std::size_t i = 0; i < pushers_.size(); ++i) {
    const PusherPlace& place = layout_.pushers[i];
    pushers_[i].travel_m = std::clamp(read(), 0.0, place.stroke_m);
    world_.place(pushers_[i].body, {place.home + pushers_[i].travel_m * place.direction, 0.0}, {});
  }
  for (Chute& chute : chutes_) {
    chute.dark = read() != 0.0;
    chute.counted = read.whole<std::int16_t>();
    chute.got = read.whole<int>();
  }
  look();
  return true;
}

}  // namespace stepwright::assemblies
