#pragma once

// A walk over all that is stored of a tag, in the order of its blocks. The visitor decides for every node of
// the tree whether its summary is enough, so that a walk costs what is looked at and not what is stored.
//
// Not thread-safe.

#include <cstdint>

#include "hmi_web/historian/history_file.h"
#include "hmi_web/historian/open_tags.h"
#include "hmi_web/historian/sample.h"
#include "hmi_web/historian/summary.h"
#include "runtime/ground/result/result.h"

namespace stepwright::historian {

enum class Look : std::uint8_t {
  Summary,  // take() gets the summary
  Closer,   // its children or its samples
  End,      // the walk ends
};

class Visitor {
 public:
  virtual ~Visitor() = default;
  virtual Look judge(const Summary& summary) = 0;
  virtual void take(const Summary& summary) = 0;
  virtual void take(const Sample& sample) = 0;
  // A block of which only the summary (of count 0, if that is damaged too) can be read.
  virtual void damaged(const Summary& summary) = 0;
};

// The file's blocks below `part.stored_end` and then those of the part.
[[nodiscard]] result::Result<void> walk(HistoryView& view, TagId tag, const OpenPart& part, Visitor& visitor);

}  // namespace stepwright::historian
