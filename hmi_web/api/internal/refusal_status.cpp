#include "hmi_web/api/internal/refusal_status.h"

#include <algorithm>

#include "hmi_web/access/codes.h"
#include "hmi_web/alarms/codes.h"
#include "hmi_web/api/force_service.h"
#include "hmi_web/api/online_change_service.h"
#include "hmi_web/api/recipe_service.h"
#include "hmi_web/api/screen_service.h"
#include "hmi_web/change/codes.h"
#include "hmi_web/recipes/codes.h"
#include "hmi_web/screens/codes.h"
#include "hmi_web/storage/codes.h"
#include "hmi_web/storage/private_files.h"
#include "hmi_web/trends/codes.h"
#include "runtime/host/change_codes.h"
#include "runtime/service/answer_codes.h"

namespace stepwright::api {
namespace {

struct Status {
  const char* code;
  unsigned status;
};

constexpr unsigned kForbidden = 403;
constexpr unsigned kNotFound = 404;
constexpr unsigned kConflict = 409;  // not in this state
constexpr unsigned kUnavailable = 503;
constexpr unsigned kTimeout = 504;

constexpr Status kStatuses[] = {
    {access::kNoSuchUser, kNotFound},
    {alarms::kNoSuchAlarm, kNotFound},
    {recipes::kNoSuchRecipe, kNotFound},
    {change::kNoSuchVersion, kNotFound},
    {trends::kNoSuchGroup, kNotFound},
    {screens::kNoSuchScreen, kNotFound},
    {kNoSuchPart, kNotFound},
    {kPartOfOtherRole, kForbidden},
    {screens::kSavedMeanwhile, kConflict},
    {kPartChanged, kConflict},
    {screens::kNoRoomForScreen, kConflict},
    {screens::kScreenDamaged, kConflict},
    {access::kLastAdministrator, kConflict},
    {access::kNoRoomForUser, kConflict},
    {alarms::kNotInThisState, kConflict},
    {recipes::kNoRoomForRecipe, kConflict},
    {trends::kNoRoomForGroup, kConflict},
    {recipes::kRecipeDamaged, kConflict},
    {kTagForced, kConflict},
    {kWriteFailed, kConflict},
    {kTooMuchForced, kConflict},
    {change::kVersionDamaged, kConflict},
    {kComparedWithAnother, kConflict},
    {kSupervisorActs, kConflict},
    {kRunsAlready, kConflict},
    {kOnTrial, kConflict},
    {host::kNoProgramRuns, kConflict},
    {host::kDownloadUnderWay, kConflict},
    {host::kStepLost, kConflict},
    {host::kOutputMoves, kConflict},
    {host::kReplacedMeanwhile, kConflict},
    {host::kStepsUnfit, kConflict},
    {service::kProgramJustChanged, kConflict},
    {service::kProgramDamaged, kConflict},
    {service::kOtherProgram, kConflict},
    {service::kNotNow, kConflict},
    {service::kNotAnsweredYet, kTimeout},
    {service::kNobodyAnswers, kUnavailable},
    {access::kNoMemoryToHash, kUnavailable},
    {storage::kFileFails, kUnavailable},
};

}  // namespace

unsigned refusal_status(std::string_view code) {
  if (storage::is_of_the_file(code)) return kUnavailable;  // of a history or a journal
  const auto* const found = std::find_if(std::begin(kStatuses), std::end(kStatuses),
                                         [&](const Status& each) { return each.code == code; });
  return found == std::end(kStatuses) ? 400 : found->status;
}

}  // namespace stepwright::api
