#pragma once

// A CellSource whose cell follows the bench script at a chosen pace, with an image as a runtime would have
// it. Its time stands still until it is told to go on, and where it was told to: a page that comes late
// has missed nothing.
//
// Threads: observe() from one, the others from any.

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "hmi_web/server/cell_source.h"
#include "tests/browser/bench_script.h"

namespace stepwright::browser {

class ScriptedCell : public server::CellSource {
 public:
  // `speed`: cell seconds per second; the cell begins at `start_s`.
  ScriptedCell(double speed, double start_s);

  server::Observation observe() override;
  void wait_for_image(std::chrono::milliseconds) override {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));  // as often as a link sends one
  }
  void set_runtime_alive(bool alive) { alive_ = alive; }
  // The filtered level of a2 is far more than any tank holds, as of a sensor that has gone mad.
  void fill_beyond_its_edge() { overfull_ = true; }
  // From where it stands, until then, s of the script.
  void run_until(double end_s);

  // The sources of the points of bench_synoptic().
  static std::vector<server::PointSources> point_sources();

 private:
  double now_s();
  server::ImageSnapshot snapshot(double time_s) const;

  BenchScript script_;
  std::shared_ptr<const server::ProgramLayout> layout_;
  double speed_;
  std::mutex mutex_;  // of what follows
  double start_s_;
  double end_s_;
  std::chrono::steady_clock::time_point begun_;
  std::atomic<bool> alive_ = true;
  std::atomic<bool> overfull_ = false;
};

}  // namespace stepwright::browser
