#pragma once

// Computes the live points of the synoptic from a snapshot: each from the first of its sources that has a
// value, scaled to the point's unit.
//
//   PointReader reader({{{PointSourceKind::Tag, "S1_FILTERED", 0.0325, -23, "S1"}}}, layout);
//   reader.read(snapshot, {{"S1", 12.5}})  ->  one value per binding
//
// Thread rule: immutable after construction.

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "hmi_web/server/cell_source.h"

namespace stepwright::server {

enum class PointSourceKind : std::uint8_t {
  Tag,         // a tag of the running program
  Address,     // an address in the input or output area, "%QX0.0"
  PlantTruth,  // a value that the simulated plant reports
};

struct PointSource {
  PointSourceKind kind = PointSourceKind::Tag;
  std::string name;
  double factor = 1;  // point = factor * (value - tare of `sensor`) + offset
  double offset = 0;
  std::string sensor = {};  // whose raw counts the value is; empty: nothing is to be subtracted
};

// Of one point; in the order in which they are tried.
using PointSources = std::vector<PointSource>;

class PointReader {
 public:
  // Resolves tags and addresses against `layout`, which may be null: then only plant truth has values.
  PointReader(const std::vector<PointSources>& points, const ProgramLayout* layout);

  // A sensor without a tare counts as unbiased.
  std::vector<std::optional<double>> read(const ImageSnapshot& snapshot, const Tare& tare) const;

 private:
  struct Resolved {
    std::variant<reader::Variable, std::string> where;  // in the image, or the name of a plant truth
    double factor;
    double offset;
    std::string sensor;
  };
  std::vector<std::vector<Resolved>> points_;
};

// Of each point the tags that share a place with one of its sources: also that of the raw counts of a level
// that is shown as the program filters it. What a plant reports of itself has none.
protocol::PointTags tags_of_points(const std::vector<PointSources>& points, const ProgramLayout& layout);

// Points that have one of these inputs among their sources, ascending: what a program filters of it is no
// more true than the input.
std::vector<std::size_t> points_from(const std::vector<PointSources>& points,
                                     const std::vector<UnreadInputs>& unread, const ProgramLayout& layout);

}  // namespace stepwright::server
