#pragma once

// Paths for MC_MovePath, drawn by a seed, and an evaluator of their own: way-points with blends, a time law
// of double S or quintic rows, stops on the way, and what the motion demands of each joint.
//
//   const PathTable table = random_table(seed);
//   table.at(1.5)[0]        // the first joint after 1.5 s
//   table.most(0).jerk      // the most that any moment demands of it

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace stepwright::driver_test {

using Joints = std::array<double, 7>;

class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
  }
  int whole(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<unsigned>(high - low + 1));
  }
  bool once_in(int times) { return engine_() % static_cast<unsigned>(times) == 0; }

 private:
  std::mt19937 engine_;
};

struct Demand {
  double speed = 0.0, acceleration = 0.0, jerk = 0.0;
};

class PathTable {
 public:
  struct WayPoint {
    double place = 0.0, blend = 0.0;
    Joints joints{}, direction{};
  };
  struct Row {
    double begin_s = 0.0, length_s = 0.0;
    std::array<double, 6> c{};
  };

  std::size_t joints = 0;
  std::vector<WayPoint> points;
  std::vector<Row> rows;
  double duration_s = 0.0;
  double rate_slope = 0.0, rate_bend = 0.0;  // promised for 1.5 times the accelerations and 3 times the jerks

  Joints at(double time_s) const;
  Demand most(std::size_t joint) const { return most_[joint]; }
  std::pair<double, double> range(std::size_t joint) const;  // of the way-points

  // Fills in what follows from way-points and rows.
  void finish();

 private:
  struct Place {
    std::array<double, 4> s{};  // and its derivatives by time
    std::array<Joints, 4> q{};  // and its derivatives by s
  };
  Place place(double time_s) const;

  std::array<Demand, 7> most_{};
};

PathTable random_table(std::uint32_t seed);

}  // namespace stepwright::driver_test
