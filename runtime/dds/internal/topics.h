#pragma once

// The names of the topics. All but the documents of the supervisor carry frames (frame_types.idl), which say
// the version of the message that they hold; the number is that of the frame itself, or of the document's
// type. With another number old and new never meet.

namespace stepwright::dds::internal {

inline constexpr char kRequestTopic[] = "stepwright/request/3";
inline constexpr char kReplyTopic[] = "stepwright/reply/3";
inline constexpr char kEventTopic[] = "stepwright/event/3";
inline constexpr char kStatusTopic[] = "stepwright/status/3";
inline constexpr char kHealthTopic[] = "stepwright/health/3";
inline constexpr char kSnapshotTopic[] = "stepwright/snapshot/3";
inline constexpr char kPresenceTopic[] = "stepwright/presence/3";
inline constexpr char kBeaconTopic[] = "stepwright/beacon/3";
inline constexpr char kDocumentTopic[] = "stepwright/plan_document/1";
inline constexpr char kGoalFormTopic[] = "stepwright/goal_form/1";
inline constexpr char kOutlookTopic[] = "stepwright/outlook/1";
inline constexpr char kPicturesTopic[] = "stepwright/pictures/1";
inline constexpr char kOperatorTopic[] = "stepwright/operator_request/3";
inline constexpr char kAnswerTopic[] = "stepwright/operator_answer/3";

}  // namespace stepwright::dds::internal
