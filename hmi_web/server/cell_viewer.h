#pragma once

// Converts observations of a cell into the data for viewers. A point of the picture that is read from a
// device which does not answer has no value; a tag of it keeps what stands in the image, as the program works
// with that, and `CellState::unread` names it.
//
// Thread rule: one thread at a time.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hmi_web/protocol/cell_state.h"
#include "hmi_web/server/cell_source.h"
#include "hmi_web/server/point_reader.h"

namespace stepwright::server {

struct CellView {
  std::shared_ptr<const ProgramLayout> layout;        // null = no program is known
  std::shared_ptr<const protocol::PointTags> points;  // of that layout; null with it
  protocol::CellState state;
  std::optional<std::string> plan;
  std::optional<std::string> pictures;
};

class CellViewer {
 public:
  // One entry per point of the synoptic.
  explicit CellViewer(std::vector<PointSources> points);

  CellView view(const Observation& observation);

 private:
  void take_layout(const std::shared_ptr<const ProgramLayout>& layout);
  void take_unread(const std::vector<UnreadInputs>& unread);

  std::vector<PointSources> points_;
  std::shared_ptr<const ProgramLayout> layout_;  // that `reader_` was made for
  PointReader reader_;
  std::shared_ptr<const protocol::PointTags> point_tags_;
  // Found anew only when devices or the program have changed: there may be thousands of both.
  std::vector<UnreadInputs> unread_;
  std::vector<protocol::UnreadDevice> unread_tags_;
  std::vector<std::uint32_t> reals_;  // tags of the type REAL, by their index
  std::vector<std::size_t> unread_points_;
};

}  // namespace stepwright::server
