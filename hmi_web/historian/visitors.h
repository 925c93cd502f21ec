#pragma once

// Visitors of a walk over the history of a tag, one for each kind of reading: samples of a range, a trend,
// rows of CSV.
//
// Not thread-safe; one object per walk.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_web/historian/historian.h"
#include "hmi_web/historian/walk.h"

namespace stepwright::historian {

// Skips what lies outside of a window, but for the value that it begins with, and collects damage.
class WindowVisitor : public Visitor {
 public:
  explicit WindowVisitor(Window window) : window_(window) {}
  void damaged(const Summary& summary) override;

  std::optional<Sample> before;
  std::vector<Damage> damage;

 protected:
  bool outside(const Summary& summary) const;
  bool inside(const Sample& sample) const;
  void note_before(const Sample& sample);
  const Window window_;
};

class RangeVisitor : public WindowVisitor {
 public:
  RangeVisitor(Window window, std::size_t most) : WindowVisitor(window), most_(most) {}
  Look judge(const Summary& summary) override;
  void take(const Summary& summary) override;
  void take(const Sample& sample) override;

  std::vector<Sample> samples;
  bool truncated = false;

 private:
  std::size_t most_;
};

class TrendVisitor : public WindowVisitor {
 public:
  // Requires a window that does not end before it begins and at least one bucket.
  TrendVisitor(Window window, std::size_t buckets);
  Look judge(const Summary& summary) override;
  void take(const Summary& summary) override;
  void take(const Sample& sample) override;

  std::int64_t bucket_ns() const { return static_cast<std::int64_t>(bucket_ns_); }
  std::vector<Summary> buckets;

 private:
  std::size_t bucket_of(std::int64_t time_ns) const;
  std::uint64_t bucket_ns_;
};

// Rows of CSV, handed on in pieces.
class CsvVisitor : public WindowVisitor {
 public:
  CsvVisitor(Window window, std::string_view tag, const Historian::Sink& sink);
  Look judge(const Summary& summary) override;
  void take(const Summary&) override {}
  void take(const Sample& sample) override;
  // Visits the rest. False: the sink wants no more.
  bool finish();

 private:
  void hand_on();
  std::string tag_;  // quoted, with the comma behind it
  const Historian::Sink& sink_;
  std::string text_;
  bool wanted_ = true;
};

// "2026-11-23T05:59:16.25Z": the fraction without zeros at its end.
std::string iso_time(std::int64_t time_ns);

}  // namespace stepwright::historian
