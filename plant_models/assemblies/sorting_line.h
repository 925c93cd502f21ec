#pragma once

// A sorting line as a plant: boxes arrive one by one, belts carry them past photo-eyes and a reader, pushers
// send them into chutes or into a lane that leads back to the reader. Box2D moves the boxes (body2d), CVODE
// the drives (ode). Thread rule and terminal semantics: core::Plant. plant_models/doc/conveyor.md has the
// model.
//
// Reproducible: everything advances by fixed steps of 5 ms of plant time, whatever advance_to() is asked;
// what is switched takes effect with the next step. Same parameters and the same calls at the same instants:
// the same bits, on machines with the same libraries. Invariant: every box is announced, on the line,
// delivered, taken away or fallen off; none is made or vanishes.
//
//   auto line = SortingLine::create({.boxes = 5, .seed = 7});
//   if (!line) return forward(line);
//   (*line)->set_actuator(*core::find_actuator(**line, "belt_in"), true);
//   (*line)->advance(std::chrono::milliseconds(10));

#include <chrono>
#include <cstdint>
#include <memory>
#include <vector>

#include "plant_models/assemblies/belt_drive.h"
#include "plant_models/assemblies/line_layout.h"
#include "plant_models/assemblies/line_parameters.h"
#include "plant_models/assemblies/line_ports.h"
#include "plant_models/body2d/conveying.h"
#include "plant_models/body2d/world.h"
#include "plant_models/core/plant.h"

namespace stepwright::assemblies {

enum class BoxState : std::uint8_t { Announced, OnTheLine, Delivered, TakenAway, Fallen };

class SortingLine final : public core::Plant {
 public:
  // Fails with the diagnostics of validate(), or with C0331 (solver).
  [[nodiscard]] static result::Result<std::unique_ptr<SortingLine>> create(const LineParameters& parameters);

  std::span<const core::Port> actuators() const override { return ports_.actuators; }
  std::span<const core::Port> sensors() const override { return ports_.sensors; }
  std::span<const core::Quantity> truths() const override { return ports_.truths; }
  std::span<const core::Quantity> faults() const override { return ports_.faults; }
  core::FaultRange fault_range(std::size_t fault) const override { return ports_.fault_ranges[fault]; }
  const core::PlantDescription& description() const override { return description_; }

  std::chrono::nanoseconds now() const override { return now_; }
  void set_actuator(core::ActuatorId id, std::int16_t value) override;
  core::PlantStatus advance_to(std::chrono::nanoseconds time) override;
  std::int16_t sensor(core::SensorId id) const override;
  double truth(core::TruthId id) const override;
  [[nodiscard]] result::Result<void> inject_fault(std::string_view name, double value) override;
  [[nodiscard]] result::Result<void> clear_fault(std::string_view name) override;

  std::size_t kept_size() const override;
  void keep(std::span<double> numbers) const override;
  // Goes on from what a line with as many boxes kept. False, and nothing happens, if no line can have kept
  // it.
  bool resume(std::span<const double> numbers);

  // Of everything that moves, for comparisons of runs.
  std::uint64_t state_hash() const;
  const LineLayout& layout() const { return layout_; }

 private:
  struct Belt {
    BeltDrive drive;
    bool on = false;
    double slip = 1.0;  // share of the grip
    body2d::BodyId obstacle;
  };
  struct Pusher {
    body2d::BodyId body;
    bool on = false;
    bool stuck = false;
    double travel_m = 0.0;
    bool met_a_belt = false;  // in the last step
  };
  struct Eye {
    std::int8_t shows = -1;  // a fault's 0 or 1; -1 = none
    bool dark = false;       // a box is there
  };
  struct Chute {
    bool dark = false;
    std::int16_t counted = 0;
    int got = 0;
  };
  struct Box {
    BoxData data;
    body2d::BodyId body;
    BoxState state = BoxState::Announced;
    int chute = 0;  // from 1
    int rank = 0;   // from 1
  };

  explicit SortingLine(const LineParameters& parameters);
  [[nodiscard]] result::Result<void> add_drives();
  void add_bodies();

  bool step();
  bool run_drives();
  void move_pushers();
  bool meets_a_belt(std::size_t pusher) const;
  void note_collisions();
  void carry_boxes();
  void let_boxes_arrive();
  void take_boxes_away();
  void look();
  bool sees(body2d::Vec2 from, body2d::Vec2 to) const;
  std::int16_t box_at_reader() const;
  void apply_fault(std::size_t fault, double value, bool active);
  void take_away(Box& box, BoxState state);
  std::size_t count(BoxState state) const;

  LineParameters parameters_;
  LineLayout layout_;
  LinePorts ports_;
  core::PlantDescription description_;
  body2d::World world_;
  std::vector<Belt> belts_;
  std::vector<Pusher> pushers_;
  std::vector<Eye> eyes_;
  std::vector<Chute> chutes_;
  std::vector<Box> boxes_;
  std::vector<std::size_t> list_;          // boxes in the order of arrival
  std::vector<body2d::Surface> surfaces_;  // belts, then chutes
  std::vector<double> pulled_n_;           // by surface
  std::size_t next_ = 0;                   // into list_
  double free_s_ = 0.0;                    // since when the infeed has room
  bool contactor_on_ = false;
  bool contactor_closed_ = false;
  double contactor_s_ = 0.0;  // how long it has been pulled
  bool emergency_stop_ = false;
  bool reset_ = false;
  double greatest_force_n_ = 0.0;
  int collisions_ = 0;
  std::int64_t steps_ = 0;
  std::chrono::nanoseconds now_{0};
  bool failed_ = false;
};

}  // namespace stepwright::assemblies
