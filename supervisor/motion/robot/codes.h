#pragma once

// Codes of what is wrong with files of robots (doc: supervisor/doc/motion.md).

namespace stepwright::motion::code {

inline constexpr const char* kBadXml = "A0101";      // no well-formed XML, or too large or too deep
inline constexpr const char* kBadMember = "A0102";   // an element or attribute is missing, twice or no number
inline constexpr const char* kOutOfRange = "A0103";  // a number that cannot be
inline constexpr const char* kUnknownName = "A0104";  // a link, joint or group that is not there
inline constexpr const char* kNoTree = "A0105";       // loops, two parents, no root or several
inline constexpr const char* kNoLimits = "A0106";     // a joint that moves has no limits
inline constexpr const char* kTooLarge = "A0107";     // more links, joints or shapes than are read
inline constexpr const char* kUnits = "A0108";      // lengths that no robot has: millimetres taken for metres
inline constexpr const char* kJointType = "A0109";  // a type of joint that is not planned for
inline constexpr const char* kNoMesh = "A0110";     // the file of a mesh is not found
inline constexpr const char* kNoChain = "A0111";    // the ends of a chain are not one below the other
inline constexpr const char* kInstead = "A0112";    // other bodies stand for a mesh that is not found
inline constexpr const char* kNoSpheres = "A0113";  // links that spheres cannot judge, or that always meet
inline constexpr const char* kNoBodies = "A0114";   // no link that moves has a body

}  // namespace stepwright::motion::code
