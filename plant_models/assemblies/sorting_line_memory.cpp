// What outlives the process that simulates the line: numbers in the order of keep().

#include <algorithm>
#include <cmath>
#include <cstdint>

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
  void skip(std::size_t count) { at_ += count; }

 private:
  std::span<const double> numbers_;
  std::size_t at_ = 0;
};

constexpr std::size_t kMotionPerBox = 6;
constexpr std::size_t kPerBox = 4 + kMotionPerBox;
constexpr std::size_t kPerBelt = 2;
constexpr std::size_t kPerChute = 3;
constexpr std::size_t kOfTheLine = 5;
constexpr double kMost = 1e6;  // of anything that is kept, in its unit

bool is_count(double value, double most) {
  return value >= 0.0 && value <= most && value == std::floor(value);
}

// Whether every box is in the list once, and announced exactly if its turn is still to come; in the order of
// keep(), from the first number on.
bool boxes_make_sense(std::span<const double> numbers, std::size_t boxes, std::size_t chutes) {
  const auto count = static_cast<double>(boxes);
  Reader read(numbers);
  if (read() != count) return false;
  const double next = read();
  if (!is_count(next, count)) return false;
  read.skip(kOfTheLine - 2);
  std::vector<std::size_t> list;
  std::vector<bool> announced;
  for (std::size_t i = 0; i < boxes; ++i) {
    const double listed = read(), state = read(), chute = read(), rank = read();
    read.skip(kMotionPerBox);
    if (!is_count(listed, count - 1.0) || !is_count(state, static_cast<double>(BoxState::Fallen)))
      return false;
    if (!is_count(chute, static_cast<double>(chutes)) || !is_count(rank, count)) return false;
    list.push_back(static_cast<std::size_t>(listed));
    announced.push_back(state == static_cast<double>(BoxState::Announced));
  }
  std::vector<bool> met(boxes, false);
  for (std::size_t place = 0; place < boxes; ++place) {
    if (met[list[place]] || announced[list[place]] != (static_cast<double>(place) >= next)) return false;
    met[list[place]] = true;
  }
  return true;
}

bool chutes_make_sense(std::span<const double> numbers, std::size_t boxes) {
  Reader read(numbers);
  for (std::size_t i = 0; i < numbers.size() / kPerChute; ++i) {
    const double dark = read(), counted = read(), got = read();
    if (!is_count(dark, 1.0) || !is_count(counted, INT16_MAX) || !is_count(got, static_cast<double>(boxes)))
      return false;
  }
  return true;
}

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
  write(collisions_);
  write(greatest_force_n_);
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
  const bool small =
      std::all_of(numbers.begin(), numbers.end(), [](double v) { return std::abs(v) <= kMost; });
  if (numbers.size() != kept_size() || !small || !boxes_make_sense(numbers, boxes_.size(), chutes_.size()) ||
      !chutes_make_sense(numbers.last(kPerChute * chutes_.size()), boxes_.size()))
    return false;
  Reader read(numbers.subspan(1));
  next_ = read.whole<std::size_t>();
  free_s_ = read();
  collisions_ = read.whole<int>();
  greatest_force_n_ = read();
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    Box& box = boxes_[i];
    list_[i] = read.whole<std::size_t>();
    box.state = read.whole<BoxState>();
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
    pushers_[i].met_a_belt = meets_a_belt(i);  // what is counted already is not counted again
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
