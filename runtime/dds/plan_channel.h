#pragma once

// The supervisor's documents (JSON texts: plan, goal form, outlook, pictures) to every viewer, and operator
// requests (JSON text) from viewers to the supervisor, which answers each. A viewer that joins late gets the
// newest of each document at once. The channel does not look into the text.
//
//   auto publisher = PlanPublisher::create({61, "supervisor", "bench"});
//   (*publisher)->publish(document);
//   if (auto request = (*publisher)->wait_request(100ms))
//     (*publisher)->answer(*request, obey(request->text));
//
// Threads: every function from any thread. Fast DDS failing to start is D0005.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "runtime/dds/types.h"
#include "runtime/ground/result/result.h"
#include "runtime/service/link_messages.h"

namespace stepwright::dds {

// Longer texts are refused with D0004.
inline constexpr std::size_t kMaxPlanDocumentBytes = 4u << 20;
inline constexpr std::size_t kMaxGoalDocumentBytes = 1u << 20;  // of the goal form, of the outlook
inline constexpr std::size_t kMaxPicturesBytes = 800'000;
using service::kMaxOperatorRequestBytes;

// A supervisor that lives answers in milliseconds.
inline constexpr std::chrono::milliseconds kAnswerTimeout{5'000};

using service::OperatorRequest;

class PlanPublisher {
 public:
  [[nodiscard]] static result::Result<std::unique_ptr<PlanPublisher>> create(const ParticipantConfig& config);
  ~PlanPublisher();

  // Replaces the document that viewers see.
  [[nodiscard]] result::Result<void> publish(const std::string& json);
  // The same for what a goal can be made of, and for where a plan would begin (supervisor/doc/goals.md).
  [[nodiscard]] result::Result<void> publish_goal_form(const std::string& json);
  [[nodiscard]] result::Result<void> publish_outlook(const std::string& json);
  // And for what is drawn of the plan (supervisor/doc/pictures.md).
  [[nodiscard]] result::Result<void> publish_pictures(const std::string& json);
  // The next request of any viewer, in order of arrival; none after `timeout`.
  std::optional<OperatorRequest> wait_request(std::chrono::milliseconds timeout);
  // Says to whoever asked that the request is accepted, or why not. Fails with D0010 if nobody takes it.
  [[nodiscard]] result::Result<void> answer(const OperatorRequest& request,
                                            const result::Result<void>& verdict);

 private:
  struct State;
  explicit PlanPublisher(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

class PlanSubscriber {
 public:
  [[nodiscard]] static result::Result<std::unique_ptr<PlanSubscriber>> create(
      const ParticipantConfig& config);
  ~PlanSubscriber();

  // The newest document; none before the first arrived. It stays when the supervisor is gone.
  std::optional<std::string> latest() const;
  std::optional<std::string> goal_form() const;
  std::optional<std::string> outlook() const;
  std::optional<std::string> pictures() const;
  // Waits until a document newer than the one last returned by this function is there; none after `timeout`.
  std::optional<std::string> wait_newer(std::chrono::milliseconds timeout);
  // True while a supervisor holds the other end, and up to a second longer if it was killed.
  bool supervisor_alive() const;
  // Asks the supervisor and waits for its answer. Fails with D0001 when none is there, with D0007 when none
  // has answered within `timeout` (it may obey all the same), else with the problems of the refusal.
  [[nodiscard]] result::Result<void> request(const std::string& json,
                                             std::chrono::milliseconds timeout = kAnswerTimeout);

 private:
  struct State;
  explicit PlanSubscriber(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace stepwright::dds
