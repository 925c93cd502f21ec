#pragma once

// Tables that orders, states and factsheets share (VDA 5050 2.1.0, sections 6.4, 6.6.6, 6.10.6).

#include <array>

#include "supervisor/fleet/vda5050/internal/rule.h"

namespace stepwright::fleet::vda5050::rules {

inline constexpr Member kHeaderId{"headerId", true, &kCount};
inline constexpr Member kTimestampMember{"timestamp", true, &kTimestamp};
inline constexpr Member kVersionMember{"version", true, &kVersion};
inline constexpr Member kManufacturer{"manufacturer", true, &kText};
inline constexpr Member kSerialNumber{"serialNumber", true, &kText};

inline constexpr std::array<std::string_view, 3> kBlockingWords = {"NONE", "SOFT", "HARD"};
inline constexpr Rule kBlocking{.kind = Kind::Text, .words = kBlockingWords};
inline constexpr Rule kParameterValue{.kind = Kind::NotNull};
inline constexpr std::array kParameterMembers = {Member{"key", true, &kText},
                                                 Member{"value", true, &kParameterValue}};
inline constexpr Rule kParameter{.kind = Kind::Object, .members = kParameterMembers};
inline constexpr Rule kParameters{.kind = Kind::List, .items = &kParameter};
inline constexpr std::array kActionMembers = {
    Member{"actionType", true, &kText}, Member{"actionId", true, &kText},
    Member{"actionDescription", false, &kText}, Member{"blockingType", true, &kBlocking},
    Member{"actionParameters", false, &kParameters}};
inline constexpr Rule kAction{.kind = Kind::Object, .members = kActionMembers};
inline constexpr Rule kActions{.kind = Kind::List, .items = &kAction};

inline constexpr Rule kDegree{.kind = Kind::Whole, .least = 1.0, .most = kMostWhole};
inline constexpr Rule kKnots{.kind = Kind::List, .items = &kFraction};
inline constexpr std::array kControlPointMembers = {Member{"x", true, &kNumber}, Member{"y", true, &kNumber},
                                                    Member{"weight", false, &kNotNegative}};
inline constexpr Rule kControlPoint{.kind = Kind::Object, .members = kControlPointMembers};
inline constexpr Rule kControlPoints{.kind = Kind::List, .items = &kControlPoint};
inline constexpr std::array kTrajectoryMembers = {Member{"degree", true, &kDegree},
                                                  Member{"knotVector", true, &kKnots},
                                                  Member{"controlPoints", true, &kControlPoints}};
inline constexpr Rule kTrajectory{.kind = Kind::Object, .members = kTrajectoryMembers};

inline constexpr std::array kBoxReferenceMembers = {Member{"x", true, &kNumber}, Member{"y", true, &kNumber},
                                                    Member{"z", true, &kNumber},
                                                    Member{"theta", false, &kNumber}};
inline constexpr Rule kBoxReference{.kind = Kind::Object, .members = kBoxReferenceMembers};
inline constexpr std::array kLoadDimensionMembers = {
    Member{"length", true, &kNumber}, Member{"width", true, &kNumber}, Member{"height", false, &kNumber}};
inline constexpr Rule kLoadDimensions{.kind = Kind::Object, .members = kLoadDimensionMembers};

}  // namespace stepwright::fleet::vda5050::rules
