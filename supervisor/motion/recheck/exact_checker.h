#pragma once

// The last word on collisions: the robot's own bodies, not spheres, with the world and with each other, by
// FCL; and straight motions of the joints as a whole, not only at places along them.
//
//   const auto exact = ExactChecker::make(robot, *bodies, &semantics, world, arm.coordinates, rest);
//   if (const auto contact = exact->contact(q)) std::cout << contact->link << " meets " << contact->other;
//   const MotionVerdict verdict = exact->check_motion(from, to);
//
// Configurations and what is checked are those of CollisionChecker (collision_checker.h), so the two can be
// compared. Does not change after it was made; any thread.
//
// A motion is divided until in each part of it every pair of bodies is farther apart in the middle than it
// can come nearer to the ends: a joint that turns by a moves a point by at most a times its greatest distance
// from the joint. So Free is a proof, up to the 1e-5 m that distances are trusted to.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "supervisor/motion/collision/collision_checker.h"
#include "supervisor/motion/mesh/link_meshes.h"

namespace stepwright::motion {

struct Contact {
  std::string link;
  std::string other;  // a link or an obstacle
};

struct MotionVerdict {
  enum class Kind : std::uint8_t {
    Free,
    Collides,
    TooClose,  // the bodies come nearer than kTooClose_m: neither can be shown
  };
  Kind kind = Kind::Free;
  double share = 0.0;  // of the motion, 0 to 1, at which it was seen
  Contact contact;
};

class ExactChecker {
 public:
  static constexpr double kTooClose_m = 5e-5;

  // `spheres` must contain the bodies (cover()); they change no answer, but with meshes checks take a
  // fraction of the time. Fails with A0301 and A0302 as CollisionChecker does.
  [[nodiscard]] static result::Result<ExactChecker> make(const Robot& robot, const Bodies& bodies,
                                                         const Semantics* semantics, const World& world,
                                                         std::span<const int> coordinates,
                                                         std::span<const double> rest,
                                                         const SphereModel* spheres = nullptr,
                                                         const std::vector<AttachedBody>& attached = {});
  // The same robot elsewhere, or carrying other things. The trees of its meshes, which take long to make, are
  // shared.
  [[nodiscard]] result::Result<ExactChecker> with(const World& world, std::span<const double> rest,
                                                  const std::vector<AttachedBody>& attached = {}) const;
  ~ExactChecker();
  ExactChecker(ExactChecker&&) noexcept;
  ExactChecker& operator=(ExactChecker&&) noexcept;

  std::size_t columns() const;
  // The first pair that meets.
  std::optional<Contact> contact(std::span<const double> configuration) const;
  MotionVerdict check_motion(std::span<const double> from, std::span<const double> to) const;

 private:
  class Scene;
  explicit ExactChecker(std::unique_ptr<const Scene> scene);

  std::unique_ptr<const Scene> scene_;
};

}  // namespace stepwright::motion
