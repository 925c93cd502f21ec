#include "supervisor/motion/problem/arm_model.h"

#include "runtime/ground/files/files.h"
#include "supervisor/motion/robot/codes.h"
#include "supervisor/motion/robot/srdf_reader.h"
#include "supervisor/motion/robot/urdf_reader.h"

namespace stepwright::motion {

namespace {

result::Result<Robot> load_urdf(const std::filesystem::path& file) {
  const auto text = files::read_file(file.string());
  if (!text) return tl::unexpected(text.error());
  return read_urdf(*text, file.string());
}

bool has_moving_bodies(const ArmModel& model) {
  std::vector<bool> moves(model.robot.links.size(), false);
  for (std::size_t link = 1; link < moves.size(); ++link) {
    const auto parent = static_cast<std::size_t>(model.robot.parent_link(static_cast<int>(link)));
    moves[link] = moves[parent] || model.robot.joints[link - 1].kind != JointKind::Fixed;
    if (moves[link] && !model.bodies[link].empty()) return true;
  }
  return false;
}

}  // namespace

result::Result<ArmModel> load_arm(const ArmFiles& files) {
  auto robot = load_urdf(files.urdf);
  if (!robot) return result::forward(robot);
  ArmModel model;
  model.robot = std::move(*robot);
  if (!files.srdf.empty()) {
    const auto text = files::read_file(files.srdf.string());
    if (!text) return tl::unexpected(text.error());
    auto semantics = read_srdf(*text, files.srdf.string(), model.robot);
    if (!semantics) return result::forward(semantics);
    model.semantics = std::move(*semantics);
  }
  model.meshes = MeshLocator(files.urdf.parent_path());
  for (const auto& [beginning, folder] : files.packages) model.meshes.map(beginning, folder);
  if (files.instead.empty()) {
    auto bodies = read_bodies(model.robot, model.meshes);
    if (!bodies) return result::forward(bodies);
    model.bodies = std::move(*bodies);
  } else {
    auto instead = load_urdf(files.instead);
    if (!instead) return result::forward(instead);
    auto bodies = read_bodies(model.robot, model.meshes, *instead, model.notes);
    if (!bodies) return result::forward(bodies);
    model.bodies = std::move(*bodies);
  }
  if (!has_moving_bodies(model))
    model.notes.push_back({code::kNoBodies,
                           result::Severity::Warning,
                           {files.urdf.string()},
                           "no link that moves has a body: nothing can be met",
                           "<collision> of its links, or --instead"});
  model.spheres = cover(model.bodies, files.cover);
  return model;
}

}  // namespace stepwright::motion
