#pragma once

// A robot as its files describe it, ready for problems: bodies with their meshes, spheres, groups.
//
//   const auto model = load_arm({.urdf = "panda.urdf", .srdf = "panda.srdf"});
//   for (const auto& note : model->notes) std::cerr << to_string(note);
//
// A value that does not change after it was made; any thread.

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "supervisor/motion/mesh/link_meshes.h"
#include "supervisor/motion/robot/semantics.h"
#include "supervisor/motion/spheres/sphere_model.h"

namespace stepwright::motion {

struct ArmFiles {
  std::filesystem::path urdf = {};
  std::filesystem::path srdf = {};  // empty: none; then only neighbours are not checked with each other
  std::filesystem::path instead =
      {};  // empty: none; another URDF whose bodies stand for meshes that are not found
  std::vector<std::pair<std::string, std::string>> packages =
      {};  // beginnings of mesh names, and their folders
  CoverOptions cover{.protrusion_m = 0.015, .most_per_body = 256};
};

struct ArmModel {
  Robot robot;
  std::optional<Semantics> semantics;
  Bodies bodies;
  SphereModel spheres;
  MeshLocator meshes{std::filesystem::path()};
  result::Diagnostics notes;  // warnings

  const Semantics* known_pairs() const { return semantics ? &*semantics : nullptr; }
};

// Fails with E0001 (files), A0101 to A0112 and A0201.
[[nodiscard]] result::Result<ArmModel> load_arm(const ArmFiles& files);

}  // namespace stepwright::motion
