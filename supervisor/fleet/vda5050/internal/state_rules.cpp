// What vehicles say: state, visualization, connection (VDA 5050 2.1.0, sections 6.10.6, 6.13, 6.14).

#include "supervisor/fleet/vda5050/internal/shared_rules.h"

namespace stepwright::fleet::vda5050::rules {

namespace {

constexpr std::array<std::string_view, 2> kMapWords = {"ENABLED", "DISABLED"};
constexpr Rule kMapStatus{.kind = Kind::Text, .words = kMapWords};
constexpr std::array kMapMembers = {Member{"mapId", true, &kText}, Member{"mapVersion", true, &kText},
                                    Member{"mapDescription", false, &kText},
                                    Member{"mapStatus", true, &kMapStatus}};
constexpr Rule kMap{.kind = Kind::Object, .members = kMapMembers};
constexpr Rule kMaps{.kind = Kind::List, .items = &kMap};

constexpr std::array kNodePositionMembers = {Member{"x", true, &kNumber}, Member{"y", true, &kNumber},
                                             Member{"theta", false, &kNumber}, Member{"mapId", true, &kText}};
constexpr Rule kNodePosition{.kind = Kind::Object, .members = kNodePositionMembers};
constexpr std::array kStateNodeMembers = {Member{"nodeId", true, &kText}, Member{"sequenceId", true, &kCount},
                                          Member{"nodeDescription", false, &kText},
                                          Member{"released", true, &kBoolean},
                                          Member{"nodePosition", false, &kNodePosition}};
constexpr Rule kStateNode{.kind = Kind::Object, .members = kStateNodeMembers};
constexpr Rule kStateNodes{.kind = Kind::List, .items = &kStateNode};
constexpr std::array kStateEdgeMembers = {Member{"edgeId", true, &kText}, Member{"sequenceId", true, &kCount},
                                          Member{"edgeDescription", false, &kText},
                                          Member{"released", true, &kBoolean},
                                          Member{"trajectory", false, &kTrajectory}};
constexpr Rule kStateEdge{.kind = Kind::Object, .members = kStateEdgeMembers};
constexpr Rule kStateEdges{.kind = Kind::List, .items = &kStateEdge};

constexpr std::array kStatePositionMembers = {Member{"x", true, &kNumber},
                                              Member{"y", true, &kNumber},
                                              Member{"theta", true, &kNumber},
                                              Member{"mapId", true, &kText},
                                              Member{"mapDescription", false, &kText},
                                              Member{"positionInitialized", true, &kBoolean},
                                              Member{"localizationScore", false, &kFraction},
                                              Member{"deviationRange", false, &kNumber}};
constexpr Rule kStatePosition{.kind = Kind::Object, .members = kStatePositionMembers};
constexpr std::array kVelocityMembers = {Member{"vx", false, &kNumber}, Member{"vy", false, &kNumber},
                                         Member{"omega", false, &kNumber}};
constexpr Rule kVelocity{.kind = Kind::Object, .members = kVelocityMembers};

constexpr std::array kStateLoadMembers = {Member{"loadId", false, &kText},
                                          Member{"loadType", false, &kText},
                                          Member{"loadPosition", false, &kText},
                                          Member{"boundingBoxReference", false, &kBoxReference},
                                          Member{"loadDimensions", false, &kLoadDimensions},
                                          Member{"weight", false, &kNotNegative}};
constexpr Rule kStateLoad{.kind = Kind::Object, .members = kStateLoadMembers};
constexpr Rule kStateLoads{.kind = Kind::List, .items = &kStateLoad};

constexpr std::array<std::string_view, 6> kStatusWords = {"WAITING", "INITIALIZING", "RUNNING",
                                                          "PAUSED",  "FINISHED",     "FAILED"};
constexpr Rule kStatus{.kind = Kind::Text, .words = kStatusWords};
constexpr std::array kActionMembers = {Member{"actionId", true, &kText}, Member{"actionType", false, &kText},
                                       Member{"actionDescription", false, &kText},
                                       Member{"actionStatus", true, &kStatus},
                                       Member{"resultDescription", false, &kText}};
constexpr Rule kActionState{.kind = Kind::Object, .members = kActionMembers};
constexpr Rule kActionStates{.kind = Kind::List, .items = &kActionState};

constexpr Rule kPercent{.kind = Kind::Number, .least = 0.0, .most = 100.0};
constexpr std::array kBatteryMembers = {
    Member{"batteryCharge", true, &kNumber}, Member{"batteryVoltage", false, &kNumber},
    Member{"batteryHealth", false, &kPercent}, Member{"charging", true, &kBoolean},
    Member{"reach", false, &kNotNegative}};
constexpr Rule kBattery{.kind = Kind::Object, .members = kBatteryMembers};

constexpr std::array kReferenceMembers = {Member{"referenceKey", true, &kText},
                                          Member{"referenceValue", true, &kText}};
constexpr Rule kReference{.kind = Kind::Object, .members = kReferenceMembers};
constexpr Rule kReferences{.kind = Kind::List, .items = &kReference};
constexpr std::array<std::string_view, 2> kErrorWords = {"WARNING", "FATAL"};
constexpr Rule kErrorLevel{.kind = Kind::Text, .words = kErrorWords};
constexpr std::array kErrorMembers = {
    Member{"errorType", true, &kText}, Member{"errorReferences", false, &kReferences},
    Member{"errorDescription", false, &kText}, Member{"errorHint", false, &kText},
    Member{"errorLevel", true, &kErrorLevel}};
constexpr Rule kError{.kind = Kind::Object, .members = kErrorMembers};
constexpr Rule kErrors{.kind = Kind::List, .items = &kError};
constexpr std::array<std::string_view, 2> kInfoWords = {"INFO", "DEBUG"};
constexpr Rule kInfoLevel{.kind = Kind::Text, .words = kInfoWords};
constexpr std::array kInfoMembers = {
    Member{"infoType", true, &kText}, Member{"infoReferences", false, &kReferences},
    Member{"infoDescription", false, &kText}, Member{"infoLevel", true, &kInfoLevel}};
constexpr Rule kInfo{.kind = Kind::Object, .members = kInfoMembers};
constexpr Rule kInformation{.kind = Kind::List, .items = &kInfo};

constexpr std::array<std::string_view, 4> kStopWords = {"AUTOACK", "MANUAL", "REMOTE", "NONE"};
constexpr Rule kStop{.kind = Kind::Text, .words = kStopWords};
constexpr std::array kSafetyMembers = {Member{"eStop", true, &kStop},
                                       Member{"fieldViolation", true, &kBoolean}};
constexpr Rule kSafety{.kind = Kind::Object, .members = kSafetyMembers};

constexpr std::array<std::string_view, 5> kModeWords = {"AUTOMATIC", "SEMIAUTOMATIC", "MANUAL", "SERVICE",
                                                        "TEACHIN"};
constexpr Rule kMode{.kind = Kind::Text, .words = kModeWords};

constexpr std::array kStateMembers = {kHeaderId,
                                      kTimestampMember,
                                      kVersionMember,
                                      kManufacturer,
                                      kSerialNumber,
                                      Member{"maps", false, &kMaps},
                                      Member{"orderId", true, &kText},
                                      Member{"orderUpdateId", true, &kCount},
                                      Member{"zoneSetId", false, &kText},
                                      Member{"lastNodeId", true, &kText},
                                      Member{"lastNodeSequenceId", true, &kCount},
                                      Member{"driving", true, &kBoolean},
                                      Member{"paused", false, &kBoolean},
                                      Member{"newBaseRequest", false, &kBoolean},
                                      Member{"distanceSinceLastNode", false, &kNumber},
                                      Member{"operatingMode", true, &kMode},
                                      Member{"nodeStates", true, &kStateNodes},
                                      Member{"edgeStates", true, &kStateEdges},
                                      Member{"agvPosition", false, &kStatePosition},
                                      Member{"velocity", false, &kVelocity},
                                      Member{"loads", false, &kStateLoads},
                                      Member{"actionStates", true, &kActionStates},
                                      Member{"batteryState", true, &kBattery},
                                      Member{"errors", true, &kErrors},
                                      Member{"information", false, &kInformation},
                                      Member{"safetyState", true, &kSafety}};

constexpr std::array kVisualizationMembers = {kHeaderId,
                                              kTimestampMember,
                                              kVersionMember,
                                              kManufacturer,
                                              kSerialNumber,
                                              Member{"agvPosition", false, &kStatePosition},
                                              Member{"velocity", false, &kVelocity}};

constexpr std::array<std::string_view, 3> kConnectionWords = {"ONLINE", "OFFLINE", "CONNECTIONBROKEN"};
constexpr Rule kConnectionState{.kind = Kind::Text, .words = kConnectionWords};
constexpr std::array kConnectionMembers = {
    kHeaderId,     kTimestampMember, kVersionMember,
    kManufacturer, kSerialNumber,    Member{"connectionState", true, &kConnectionState}};

}  // namespace

constinit const Rule kState{.kind = Kind::Object, .members = kStateMembers};
constinit const Rule kVisualization{.kind = Kind::Object, .members = kVisualizationMembers};
constinit const Rule kConnection{.kind = Kind::Object, .members = kConnectionMembers};

}  // namespace stepwright::fleet::vda5050::rules
