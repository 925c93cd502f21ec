#pragma once

// The names of the topics. A change of a type's meaning gets a new version in its name: old and new then
// never meet.

namespace stepwright::dds::internal {

inline constexpr char kCommandTopic[] = "stepwright/command/2";
inline constexpr char kExtraTopic[] = "stepwright/extra_command/2";
inline constexpr char kChunkTopic[] = "stepwright/program_chunk/1";
inline constexpr char kReplyTopic[] = "stepwright/reply/2";
inline constexpr char kEventTopic[] = "stepwright/event/1";
inline constexpr char kStatusTopic[] = "stepwright/status/2";
inline constexpr char kHealthTopic[] = "stepwright/health/1";
inline constexpr char kSnapshotTopic[] = "stepwright/snapshot/1";
inline constexpr char kPresenceTopic[] = "stepwright/presence/1";
inline constexpr char kBeaconTopic[] = "stepwright/beacon/1";
inline constexpr char kDocumentTopic[] = "stepwright/plan_document/1";
inline constexpr char kGoalFormTopic[] = "stepwright/goal_form/1";
inline constexpr char kOutlookTopic[] = "stepwright/outlook/1";
inline constexpr char kOperatorTopic[] = "stepwright/operator_request/1";
inline constexpr char kAnswerTopic[] = "stepwright/operator_answer/1";

}  // namespace stepwright::dds::internal
