// Orders and instant actions (VDA 5050 2.1.0, sections 6.6.6 and 6.9).

#include "supervisor/fleet/vda5050/internal/shared_rules.h"

namespace stepwright::fleet::vda5050::rules {

namespace {

constexpr Rule kDeviationTheta{.kind = Kind::Number, .least = 0.0, .most = kPi};
constexpr std::array kPositionMembers = {Member{"x", true, &kNumber},
                                         Member{"y", true, &kNumber},
                                         Member{"theta", false, &kAngle},
                                         Member{"allowedDeviationXY", false, &kNotNegative},
                                         Member{"allowedDeviationTheta", false, &kDeviationTheta},
                                         Member{"mapId", true, &kText},
                                         Member{"mapDescription", false, &kText}};
constexpr Rule kPosition{.kind = Kind::Object, .members = kPositionMembers};

constexpr std::array kNodeMembers = {Member{"nodeId", true, &kText},
                                     Member{"sequenceId", true, &kCount},
                                     Member{"nodeDescription", false, &kText},
                                     Member{"released", true, &kBoolean},
                                     Member{"nodePosition", false, &kPosition},
                                     Member{"actions", true, &kActions}};
constexpr Rule kNode{.kind = Kind::Object, .members = kNodeMembers};
constexpr Rule kNodes{.kind = Kind::List, .items = &kNode, .fewest = 1};

constexpr std::array<std::string_view, 2> kOrientationWords = {"GLOBAL", "TANGENTIAL"};
constexpr Rule kOrientationType{.kind = Kind::Text, .words = kOrientationWords};
constexpr std::array<std::string_view, 2> kReferenceWords = {"KINEMATICCENTER", "CONTOUR"};
constexpr Rule kReferencePoint{.kind = Kind::Text, .words = kReferenceWords};
constexpr std::array kCorridorMembers = {Member{"leftWidth", true, &kNotNegative},
                                         Member{"rightWidth", true, &kNotNegative},
                                         Member{"corridorRefPoint", false, &kReferencePoint}};
constexpr Rule kCorridor{.kind = Kind::Object, .members = kCorridorMembers};

constexpr std::array kEdgeMembers = {Member{"edgeId", true, &kText},
                                     Member{"sequenceId", true, &kCount},
                                     Member{"edgeDescription", false, &kText},
                                     Member{"released", true, &kBoolean},
                                     Member{"startNodeId", true, &kText},
                                     Member{"endNodeId", true, &kText},
                                     Member{"maxSpeed", false, &kNumber},
                                     Member{"maxHeight", false, &kNumber},
                                     Member{"minHeight", false, &kNumber},
                                     Member{"orientation", false, &kAngle},
                                     Member{"orientationType", false, &kOrientationType},
                                     Member{"direction", false, &kText},
                                     Member{"rotationAllowed", false, &kBoolean},
                                     Member{"maxRotationSpeed", false, &kNumber},
                                     Member{"length", false, &kNumber},
                                     Member{"trajectory", false, &kTrajectory},
                                     Member{"corridor", false, &kCorridor},
                                     Member{"actions", true, &kActions}};
constexpr Rule kEdge{.kind = Kind::Object, .members = kEdgeMembers};
constexpr Rule kEdges{.kind = Kind::List, .items = &kEdge};

constexpr std::array kOrderMembers = {kHeaderId,
                                      kTimestampMember,
                                      kVersionMember,
                                      kManufacturer,
                                      kSerialNumber,
                                      Member{"orderId", true, &kText},
                                      Member{"orderUpdateId", true, &kCount},
                                      Member{"zoneSetId", false, &kText},
                                      Member{"nodes", true, &kNodes},
                                      Member{"edges", true, &kEdges}};

constexpr std::array kInstantMembers = {kHeaderId,     kTimestampMember, kVersionMember,
                                        kManufacturer, kSerialNumber,    Member{"actions", true, &kActions}};

}  // namespace

constinit const Rule kOrder{.kind = Kind::Object, .members = kOrderMembers};
constinit const Rule kInstantActions{.kind = Kind::Object, .members = kInstantMembers};

}  // namespace stepwright::fleet::vda5050::rules
