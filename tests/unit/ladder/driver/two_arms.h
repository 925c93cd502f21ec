#pragma once

// The two arms of tests/cells/robot_cell (supervisor/doc/two_arms.md) for ARM_DISTANCE, as texts of ST. Seven
// capsules each contain all bodies, wherever the fingers are (tests/unit/supervisor/tamp/program).

namespace stepwright::driver_test {

// Variables.
inline constexpr const char* kTwoArms = R"(
  leftArm : ARM_MODEL := (Joints := 7, Joint := [
      (R := [1.0, 0.0, 0.0, 0.0, 0.5, 0.8660254037844386, 0.0, -0.8660254037844386, 0.5], Y := 0.15, Z := 1.15),
      (R := [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -1.0, 0.0], Z := 0.15),
      (R := [1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0], Y := -0.2),
      (R := [1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0], Z := 0.2),
      (R := [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -1.0, 0.0], Y := 0.19),
      (R := [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -1.0, 0.0], Z := 0.19),
      (R := [1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0])],
    Capsules := 7, Capsule := [
      (Joint := 1, Z2 := 0.14, Radius := 0.071),
      (Joint := 3, Z1 := -0.2, Z2 := 0.2, Radius := 0.08), (Joint := 5, Z1 := -0.19, Z2 := 0.19, Radius := 0.07),
      (Joint := 7, Z2 := 0.1, Radius := 0.055), (Joint := 7, Y1 := -0.066, Y2 := 0.066, Z1 := 0.13, Z2 := 0.13, Radius := 0.045),
      (Joint := 7, Y1 := 0.0285, Y2 := 0.0285, Z1 := 0.176, Z2 := 0.224, Radius := 0.035),
      (Joint := 7, Y1 := -0.0285, Y2 := -0.0285, Z1 := 0.176, Z2 := 0.224, Radius := 0.035)]);
  rightArm : ARM_MODEL;
)";

// Statements, once: the right arm is the left one on the other side of y = 0.
inline constexpr const char* kRightArm = R"(
    rightArm := leftArm;
    rightArm.Joint[1].Y := -0.15;
    rightArm.Joint[1].R[5] := -0.8660254037844386;
    rightArm.Joint[1].R[7] := 0.8660254037844386;
)";

}  // namespace stepwright::driver_test
