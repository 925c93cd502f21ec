#pragma once

// Queries of the API's routes for records (hmi_web/api/record_routes.cpp, hmi_web/doc/records.md).
//
//   RecordQueries records(recorder);
//   RouteTable table(api::all_routes({.control = ..., .records = &records}));
//
// Thread rule: every function from any thread; each reads files. The recorder outlives it. Parameters come
// from anybody; every answer is bounded.

#include "hmi_web/api/cell_records.h"
#include "hmi_web/recorder/cell_recorder.h"

namespace stepwright::recorder {

class RecordQueries : public api::CellRecords {
 public:
  explicit RecordQueries(CellRecorder& recorder) : recorder_(recorder) {}

  api::Answer tags(const Parameters& given) const override;
  api::Answer trend(const Parameters& given) const override;
  api::Answer samples_csv(const Parameters& given) const override;
  api::Answer alarms(const Parameters& given) const override;
  api::Answer journal(const Parameters& given) const override;
  api::Answer journal_csv(const Parameters& given) const override;
  [[nodiscard]] result::Result<api::AlarmChange> act(const api::AlarmAction& action) override;
  bool accept_calendar() override { return recorder_.accept_calendar(); }

 private:
  CellRecorder& recorder_;
};

}  // namespace stepwright::recorder
