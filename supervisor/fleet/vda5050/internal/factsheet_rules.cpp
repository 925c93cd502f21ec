// What a type of vehicle is and can (VDA 5050 2.1.0, section 6.15.1).

#include "supervisor/fleet/vda5050/internal/shared_rules.h"

namespace stepwright::fleet::vda5050::rules {

namespace {

constexpr std::array<std::string_view, 3> kKinematicWords = {"DIFF", "OMNI", "THREEWHEEL"};
constexpr Rule kKinematic{.kind = Kind::Text, .words = kKinematicWords};
constexpr std::array<std::string_view, 4> kClassWords = {"FORKLIFT", "CONVEYOR", "TUGGER", "CARRIER"};
constexpr Rule kClass{.kind = Kind::Text, .words = kClassWords};
constexpr std::array<std::string_view, 6> kLocalizationWords = {"NATURAL", "REFLECTOR", "RFID",
                                                                "DMC",     "SPOT",      "GRID"};
constexpr Rule kLocalization{.kind = Kind::Text, .words = kLocalizationWords};
constexpr Rule kLocalizations{.kind = Kind::List, .items = &kLocalization};
constexpr std::array<std::string_view, 3> kNavigationWords = {"PHYSICAL_LINE_GUIDED", "VIRTUAL_LINE_GUIDED",
                                                              "AUTONOMOUS"};
constexpr Rule kNavigation{.kind = Kind::Text, .words = kNavigationWords};
constexpr Rule kNavigations{.kind = Kind::List, .items = &kNavigation};
constexpr std::array kTypeMembers = {Member{"seriesName", true, &kText},
                                     Member{"seriesDescription", false, &kText},
                                     Member{"agvKinematic", true, &kKinematic},
                                     Member{"agvClass", true, &kClass},
                                     Member{"maxLoadMass", true, &kNotNegative},
                                     Member{"localizationTypes", true, &kLocalizations},
                                     Member{"navigationTypes", true, &kNavigations}};
constexpr Rule kType{.kind = Kind::Object, .members = kTypeMembers};

constexpr std::array kPhysicalMembers = {Member{"speedMin", true, &kNumber},
                                         Member{"speedMax", true, &kNumber},
                                         Member{"angularSpeedMin", false, &kNumber},
                                         Member{"angularSpeedMax", false, &kNumber},
                                         Member{"accelerationMax", true, &kNumber},
                                         Member{"decelerationMax", true, &kNumber},
                                         Member{"heightMin", false, &kNumber},
                                         Member{"heightMax", true, &kNumber},
                                         Member{"width", true, &kNumber},
                                         Member{"length", true, &kNumber}};
constexpr Rule kPhysical{.kind = Kind::Object, .members = kPhysicalMembers};

constexpr std::array kStringLengthMembers = {Member{"msgLen", false, &kCount},
                                             Member{"topicSerialLen", false, &kCount},
                                             Member{"topicElemLen", false, &kCount},
                                             Member{"idLen", false, &kCount},
                                             Member{"idNumericalOnly", false, &kBoolean},
                                             Member{"enumLen", false, &kCount},
                                             Member{"loadIdLen", false, &kCount}};
constexpr Rule kStringLengths{.kind = Kind::Object, .members = kStringLengthMembers};
constexpr std::array kArrayLengthMembers = {Member{"order.nodes", false, &kCount},
                                            Member{"order.edges", false, &kCount},
                                            Member{"node.actions", false, &kCount},
                                            Member{"edge.actions", false, &kCount},
                                            Member{"actions.actionsParameters", false, &kCount},
                                            Member{"instantActions", false, &kCount},
                                            Member{"trajectory.knotVector", false, &kCount},
                                            Member{"trajectory.controlPoints", false, &kCount},
                                            Member{"state.nodeStates", false, &kCount},
                                            Member{"state.edgeStates", false, &kCount},
                                            Member{"state.loads", false, &kCount},
                                            Member{"state.actionStates", false, &kCount},
                                            Member{"state.errors", false, &kCount},
                                            Member{"state.information", false, &kCount},
                                            Member{"error.errorReferences", false, &kCount},
                                            Member{"information.infoReferences", false, &kCount}};
constexpr Rule kArrayLengths{.kind = Kind::Object, .members = kArrayLengthMembers};
constexpr std::array kTimingMembers = {
    Member{"minOrderInterval", true, &kNumber}, Member{"minStateInterval", true, &kNumber},
    Member{"defaultStateInterval", false, &kNumber}, Member{"visualizationInterval", false, &kNumber}};
constexpr Rule kTiming{.kind = Kind::Object, .members = kTimingMembers};
constexpr std::array kLimitMembers = {Member{"maxStringLens", true, &kStringLengths},
                                      Member{"maxArrayLens", true, &kArrayLengths},
                                      Member{"timing", true, &kTiming}};
constexpr Rule kLimits{.kind = Kind::Object, .members = kLimitMembers};

constexpr std::array<std::string_view, 2> kSupportWords = {"SUPPORTED", "REQUIRED"};
constexpr Rule kSupport{.kind = Kind::Text, .words = kSupportWords};
constexpr std::array kOptionalMembers = {Member{"parameter", true, &kText},
                                         Member{"support", true, &kSupport},
                                         Member{"description", false, &kText}};
constexpr Rule kOptional{.kind = Kind::Object, .members = kOptionalMembers};
constexpr Rule kOptionals{.kind = Kind::List, .items = &kOptional};
constexpr std::array<std::string_view, 3> kScopeWords = {"INSTANT", "NODE", "EDGE"};
constexpr Rule kScope{.kind = Kind::Text, .words = kScopeWords};
constexpr Rule kScopes{.kind = Kind::List, .items = &kScope};
constexpr std::array<std::string_view, 7> kDataTypeWords = {"BOOL",   "NUMBER", "INTEGER", "FLOAT",
                                                            "STRING", "OBJECT", "ARRAY"};
constexpr Rule kDataType{.kind = Kind::Text, .words = kDataTypeWords};
constexpr std::array kAbleParameterMembers = {
    Member{"key", true, &kText}, Member{"valueDataType", true, &kDataType},
    Member{"description", false, &kText}, Member{"isOptional", false, &kBoolean}};
constexpr Rule kAbleParameter{.kind = Kind::Object, .members = kAbleParameterMembers};
constexpr Rule kAbleParameters{.kind = Kind::List, .items = &kAbleParameter};
constexpr Rule kBlockings{.kind = Kind::List, .items = &kBlocking};
constexpr std::array kAbleMembers = {
    Member{"actionType", true, &kText},         Member{"actionDescription", false, &kText},
    Member{"actionScopes", true, &kScopes},     Member{"actionParameters", false, &kAbleParameters},
    Member{"resultDescription", false, &kText}, Member{"blockingTypes", false, &kBlockings}};
constexpr Rule kAble{.kind = Kind::Object, .members = kAbleMembers};
constexpr Rule kAbles{.kind = Kind::List, .items = &kAble};
constexpr std::array kFeatureMembers = {Member{"optionalParameters", true, &kOptionals},
                                        Member{"agvActions", true, &kAbles}};
constexpr Rule kFeatures{.kind = Kind::Object, .members = kFeatureMembers};

constexpr std::array<std::string_view, 4> kWheelWords = {"DRIVE", "CASTER", "FIXED", "MECANUM"};
constexpr Rule kWheelType{.kind = Kind::Text, .words = kWheelWords};
constexpr std::array kWheelPositionMembers = {Member{"x", true, &kNumber}, Member{"y", true, &kNumber},
                                              Member{"theta", false, &kNumber}};
constexpr Rule kWheelPosition{.kind = Kind::Object, .members = kWheelPositionMembers};
constexpr std::array kWheelMembers = {Member{"type", true, &kWheelType},
                                      Member{"isActiveDriven", true, &kBoolean},
                                      Member{"isActiveSteered", true, &kBoolean},
                                      Member{"position", true, &kWheelPosition},
                                      Member{"diameter", true, &kNumber},
                                      Member{"width", true, &kNumber},
                                      Member{"centerDisplacement", false, &kNumber},
                                      Member{"constraints", false, &kText}};
constexpr Rule kWheel{.kind = Kind::Object, .members = kWheelMembers};
constexpr Rule kWheels{.kind = Kind::List, .items = &kWheel};
constexpr std::array kCornerMembers = {Member{"x", true, &kNumber}, Member{"y", true, &kNumber}};
constexpr Rule kCorner{.kind = Kind::Object, .members = kCornerMembers};
constexpr Rule kCorners{.kind = Kind::List, .items = &kCorner};
constexpr std::array kOutlineMembers = {Member{"set", true, &kText}, Member{"polygonPoints", true, &kCorners},
                                        Member{"description", false, &kText}};
constexpr Rule kOutline{.kind = Kind::Object, .members = kOutlineMembers};
constexpr Rule kOutlines{.kind = Kind::List, .items = &kOutline};
constexpr Rule kAnyObject{.kind = Kind::Object};
constexpr std::array kSolidMembers = {Member{"set", true, &kText}, Member{"format", true, &kText},
                                      Member{"data", false, &kAnyObject}, Member{"url", false, &kText},
                                      Member{"description", false, &kText}};
constexpr Rule kSolid{.kind = Kind::Object, .members = kSolidMembers};
constexpr Rule kSolids{.kind = Kind::List, .items = &kSolid};
constexpr std::array kGeometryMembers = {Member{"wheelDefinitions", false, &kWheels},
                                         Member{"envelopes2d", false, &kOutlines},
                                         Member{"envelopes3d", false, &kSolids}};
constexpr Rule kGeometry{.kind = Kind::Object, .members = kGeometryMembers};

constexpr std::array kLoadSetMembers = {Member{"setName", true, &kText},
                                        Member{"loadType", true, &kText},
                                        Member{"loadPositions", false, &kTexts},
                                        Member{"boundingBoxReference", false, &kBoxReference},
                                        Member{"loadDimensions", false, &kLoadDimensions},
                                        Member{"maxWeight", false, &kNumber},
                                        Member{"minLoadhandlingHeight", false, &kNumber},
                                        Member{"maxLoadhandlingHeight", false, &kNumber},
                                        Member{"minLoadhandlingDepth", false, &kNumber},
                                        Member{"maxLoadhandlingDepth", false, &kNumber},
                                        Member{"minLoadhandlingTilt", false, &kNumber},
                                        Member{"maxLoadhandlingTilt", false, &kNumber},
                                        Member{"agvSpeedLimit", false, &kNumber},
                                        Member{"agvAccelerationLimit", false, &kNumber},
                                        Member{"agvDecelerationLimit", false, &kNumber},
                                        Member{"pickTime", false, &kNumber},
                                        Member{"dropTime", false, &kNumber},
                                        Member{"description", false, &kText}};
constexpr Rule kLoadSet{.kind = Kind::Object, .members = kLoadSetMembers};
constexpr Rule kLoadSets{.kind = Kind::List, .items = &kLoadSet};
constexpr std::array kLoadMembers = {Member{"loadPositions", false, &kTexts},
                                     Member{"loadSets", false, &kLoadSets}};
constexpr Rule kLoadSpecification{.kind = Kind::Object, .members = kLoadMembers};

constexpr std::array kVersionInfoMembers = {Member{"key", true, &kText}, Member{"value", true, &kText}};
constexpr Rule kVersionInfo{.kind = Kind::Object, .members = kVersionInfoMembers};
constexpr Rule kVersions{.kind = Kind::List, .items = &kVersionInfo};
constexpr std::array kNetworkMembers = {
    Member{"dnsServers", false, &kTexts}, Member{"localIpAddress", false, &kText},
    Member{"ntpServers", false, &kTexts}, Member{"netmask", false, &kText},
    Member{"defaultGateway", false, &kText}};
constexpr Rule kNetwork{.kind = Kind::Object, .members = kNetworkMembers};
constexpr std::array kConfigMembers = {Member{"versions", false, &kVersions},
                                       Member{"network", false, &kNetwork}};
constexpr Rule kConfig{.kind = Kind::Object, .members = kConfigMembers};

constexpr std::array kFactsheetMembers = {kHeaderId,
                                          kTimestampMember,
                                          kVersionMember,
                                          kManufacturer,
                                          kSerialNumber,
                                          Member{"typeSpecification", true, &kType},
                                          Member{"physicalParameters", true, &kPhysical},
                                          Member{"protocolLimits", true, &kLimits},
                                          Member{"protocolFeatures", true, &kFeatures},
                                          Member{"agvGeometry", true, &kGeometry},
                                          Member{"loadSpecification", true, &kLoadSpecification},
                                          Member{"vehicleConfig", false, &kConfig}};

}  // namespace

constinit const Rule kFactsheet{.kind = Kind::Object, .members = kFactsheetMembers};

}  // namespace stepwright::fleet::vda5050::rules
