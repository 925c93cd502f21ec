#pragma once

// The judge of a robot cell: who touches whom, how near the arms come, what was dropped and where it fell. It
// looks at where bodies are, with solids and distances of its own, and knows neither plan nor planner.
//
// Thread rule: one thread at a time; nothing is allocated after the constructor. Invariant: a contact is
// counted once until its two things are apart.
//
//   RobotCellJudge judge(parameters);
//   const Look& look = judge.look({arms, openings, objects, held, blocked}, now_s);
//   for (const Incident& incident : judge.incidents()) text += judge.text(incident);
//
// No contact: an object and what it stands on, an object and the arm that holds it, things that stand on one
// another, an arm's first joint and the robot's own stand, two bodies of one arm.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "plant_models/assemblies/robot_cell_arm.h"
#include "plant_models/assemblies/robot_cell_objects.h"

namespace stepwright::assemblies {

enum class IncidentKind : std::uint8_t {
  ArmArm,
  ArmFixed,
  ArmObject,
  ObjectObject,
  ObjectFixed,
  Dropped,
  Slipped
};
inline constexpr std::size_t kIncidentKinds = 7;

// `a` and `b` are things: see RobotCellJudge::name(). Of a drop: what fell, and on what.
struct Incident {
  IncidentKind kind = IncidentKind::ArmArm;
  std::size_t a = 0;
  std::size_t b = 0;
  double at_s = 0.0;
  double height_m = 0.0;  // of a drop
};

// What there is to be seen at an instant.
struct CellView {
  std::span<const ArmPose> arms;
  std::span<const double> openings_m;
  const CellObjects* objects = nullptr;
  std::span<const int> held;  // by each arm: its object, or -1
  std::span<const bool> blocked;
};

// Where an object is, for a report.
struct ObjectPlace {
  std::string object;
  std::string on;  // what it stands on; empty while it is held or falls
  ObjectState state = ObjectState::Stands;
  ObjectPose pose;
};

// What an arm touches that is free to give way.
struct Touch {
  std::size_t arm = 0;
  std::size_t body = 0;
  std::size_t object = 0;
};

struct Look {
  std::array<bool, kMostArms> arm_stopped{};  // it touches an arm or something fixed
  std::array<Touch, kMostArms * kMostCellObjects> touches{};
  std::size_t touch_count = 0;
  double arms_apart_m = 0.0;  // 0 where there is one arm
};

class RobotCellJudge {
 public:
  explicit RobotCellJudge(const RobotCellParameters& parameters);

  const Look& look(const CellView& view, double now_s);
  // Whether nothing was where that blockage would stand at the last look.
  bool has_room(std::size_t blockage) const;
  // What the plant tells it: only who has force and speed knows.
  void note_drop(std::size_t object, int support, double height_m, double now_s);
  void note_slip(std::size_t object, std::size_t arm, double now_s);

  std::int64_t count(IncidentKind kind) const { return counts_[static_cast<std::size_t>(kind)]; }
  double smallest_gap_m() const { return smallest_gap_m_; }  // between the arms so far; 0 after a contact
  double arms_apart_m() const { return look_.arms_apart_m; }
  // The first kMostIncidents of them.
  std::span<const Incident> incidents() const { return {incidents_.data(), noted_}; }
  // "t = 3.2 s: cup_1 fell 0.31 m on table"
  std::string text(const Incident& incident) const;
  std::vector<ObjectPlace> object_places(const CellObjects& objects) const;
  // Of a thing, by its number: arms, then fixed bodies, blockages, objects, and last the floor.
  const std::string& name(std::size_t thing) const { return names_[thing]; }

  static constexpr std::size_t kMostIncidents = 256;

 private:
  // The parts of an object where they are.
  struct PlacedParts {
    std::array<PlacedSolid, 3> solids;
    std::size_t count = 0;

    std::span<const PlacedSolid> all() const { return {solids.data(), count}; }
  };
  void place_bodies(const CellView& view);
  void judge_arms();
  void judge_arm_and_fixed(std::size_t arm, const CellView& view);
  void judge_arm_and_objects(std::size_t arm, const CellView& view);
  void judge_objects(const CellView& view);
  static bool touch(const PlacedSolid& a, const PlacedSolid& b);
  static bool touch(const PlacedSolid& a, const PlacedParts& parts);
  void contact(IncidentKind kind, std::size_t a, std::size_t b);
  void note(const Incident& incident);
  std::size_t fixed_thing(std::size_t k) const { return arms_.size() + k; }
  std::size_t object_thing(std::size_t k) const { return arms_.size() + fixed_.size() + k; }
  std::size_t thing_of_support(int support) const;

  std::vector<ArmFigures> arms_;
  std::vector<FixedBody> fixed_;  // blockages behind the others
  std::size_t standing_ = 0;      // of those: that always stand
  std::vector<std::string> names_;
  std::array<std::vector<PlacedSolid>, kMostArms> bodies_;
  std::vector<PlacedParts> parts_;  // of each object
  std::vector<bool> touching_;      // pairs of things, now and
  std::vector<bool> touched_;       // at the last look
  std::array<std::int64_t, kIncidentKinds> counts_{};
  std::vector<Incident> incidents_;
  std::size_t noted_ = 0;
  double smallest_gap_m_ = 0.0;
  double now_s_ = 0.0;
  Look look_;
};

}  // namespace stepwright::assemblies
