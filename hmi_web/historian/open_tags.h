#pragma once

// The tags of a historian in memory: suppression, the block of each tag that is not full, the unfinished
// summaries above it, and the rows for the next write.
//
//   tags.append({id, sample});
//   WriteSet set = tags.collect(false);
//   if (file.write(set, tags.blocks(), tags.parents())) tags.committed(set);
//
// Thread rule: under one lock; blocks() and parents() change in append, release_held and committed only, so
// that the thread that calls these may read them without the lock. Invariants: the samples of an open block
// ascend in time; a full block leaves `blocks()` when it is written, or when too many wait for a failing
// disk: then its samples are counted as lost.

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "hmi_web/historian/history_file.h"
#include "hmi_web/historian/sample.h"
#include "hmi_web/historian/suppression.h"

namespace stepwright::historian {

// Data of a tag that are not in the file yet, for readers.
struct OpenPart {
  std::uint32_t stored_end = 0;                // blocks below are in the file
  std::vector<std::vector<std::byte>> blocks;  // full ones that may not be
  std::vector<Sample> samples;                 // of the block that is not full
};

class OpenTags {
 public:
  explicit OpenTags(std::size_t most_waiting_bytes) : most_waiting_bytes_(most_waiting_bytes) {}

  void restore(StoredTag stored);
  // The tag of this name, a new one if there is none; the settings hold from here on. nullopt: kMostTags.
  std::optional<TagId> add(const std::string& name, const SuppressionSettings& settings);
  std::optional<TagId> find(const std::string& name) const;
  std::vector<TagRow> names() const;
  std::string name(TagId tag) const;  // empty: there is none

  // Ids are those of add() and restore(); others are counted as unknown.
  void append(const TagSample& sample);
  // Before the end: keeps the samples that the suppression still holds.
  void release_held();

  WriteSet collect(bool checkpoint);
  // The last result of collect() is in the file, and with it blocks() and parents().
  void committed(const WriteSet& set);
  // The file is lost with its content; the samples in memory go to the next one.
  void begin_new_file();
  void deleted(const std::vector<BlockNumber>& numbers);

  const std::vector<BlockRow>& blocks() const { return blocks_; }
  const std::vector<ParentRow>& parents() const { return parents_; }
  std::optional<OpenPart> open_part(TagId tag) const;

  std::uint64_t kept() const { return kept_; }        // samples after suppression
  std::uint64_t unknown() const { return unknown_; }  // samples of no tag
  std::uint64_t lost() const { return lost_; }        // samples of blocks that no disk took

 private:
  struct Tag {
    std::string name;
    Suppression suppression;
    std::optional<SuppressionSettings> next_settings;  // from the next sample on
    std::uint32_t first_number = 0;                    // as StoredTag
    std::uint32_t number = 0;                          // of the open block
    std::vector<Sample> open;
    std::vector<Sample> fresh;     // of them: not in the tail yet
    std::vector<Summary> partial;  // as StoredTag
    bool is_new = false;           // its name is not in the file
    bool touched = false;          // since the last write
    bool changed = false;          // since the last checkpoint
    bool exists = false;
  };

  void keep(TagId id, Tag& tag, const Sample& sample);
  void seal(TagId id, Tag& tag);
  void change_settings(TagId id, Tag& tag);
  void drop_what_waits_too_long();

  std::size_t most_waiting_bytes_;
  std::vector<Tag> tags_;  // by id
  std::map<std::string, TagId, std::less<>> by_name_;
  std::vector<TagId> touched_;
  std::vector<BlockRow> blocks_;
  std::vector<ParentRow> parents_;
  std::size_t waiting_bytes_ = 0;
  std::uint64_t kept_ = 0, unknown_ = 0, lost_ = 0;
};

}  // namespace stepwright::historian
