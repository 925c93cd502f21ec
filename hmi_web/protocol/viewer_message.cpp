#include "hmi_web/protocol/viewer_message.h"

#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

namespace stepwright::protocol {
namespace {

using nlohmann::json;

// JSON holds whole numbers up to here without loss in every reader.
constexpr std::uint64_t kMostNumber = (std::uint64_t{1} << 53) - 1;
constexpr std::size_t kMostWord = 64;

// Takes members out of an object one by one; what is wrong first is kept, and the rest is read as nothing.
class Members {
 public:
  Members(const json& object, std::string& wrong) : object_(object), wrong_(wrong) {
    if (!object.is_object()) fail("an object is expected");
  }

  std::uint64_t whole(const char* name, std::uint64_t most = kMostNumber) {
    const json* value = take(name);
    if (value == nullptr) return 0;
    if (!value->is_number_unsigned() || value->get<std::uint64_t>() > most) {
      fail(std::string(name) + " is no number in range");
      return 0;
    }
    return value->get<std::uint64_t>();
  }
  bool flag(const char* name) {
    const json* value = take(name);
    if (value != nullptr && !value->is_boolean()) fail(std::string(name) + " is true or false");
    return value != nullptr && value->is_boolean() && value->get<bool>();
  }
  std::string word(const char* name) {
    const json* value = take(name);
    if (value == nullptr) return {};
    if (!value->is_string() || value->get_ref<const std::string&>().size() > kMostWord) {
      fail(std::string(name) + " is no short text");
      return {};
    }
    return value->get<std::string>();
  }
  // Null if it is not there.
  const json* take(const char* name) {
    if (!object_.is_object()) return nullptr;
    const auto found = object_.find(name);
    if (found == object_.end()) return nullptr;
    ++taken_;
    return &*found;
  }
  void end() {
    if (object_.is_object() && taken_ != object_.size()) fail("a member is not known");
  }
  void fail(std::string why) {
    if (wrong_.empty()) wrong_ = std::move(why);
  }

 private:
  const json& object_;
  std::string& wrong_;
  std::size_t taken_ = 0;
};

void read_ranges(const json& list, Members& members, std::vector<TagRange>& ranges) {
  if (!list.is_array()) return members.fail("tags are \"all\" or ranges");
  if (list.size() > kMostTagRanges) return members.fail("too many ranges of tags");
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
  std::uint64_t free = 0;  // the least index that the next range may begin with
  for (const json& each : list) {
    const bool pair = each.is_array() && each.size() == 2 && each[0].is_number_unsigned() &&
                      each[1].is_number_unsigned() && each[0].get<std::uint64_t>() <= kMost &&
                      each[1].get<std::uint64_t>() <= kMost;
    if (!pair) return members.fail("a range of tags is [first, count]");
    const auto first = each[0].get<std::uint64_t>();
    const auto count = each[1].get<std::uint64_t>();
    if (count == 0 || first < free || first + count > kMost)
      return members.fail("ranges of tags ascend and do not touch");
    free = first + count + 1;
    ranges.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count)});
  }
}

void read_also(const json& list, Members& members, Show& show) {
  if (!list.is_array()) return members.fail("also is a list");
  for (const json& each : list) {
    bool* wanted = each == "plan"       ? &show.plan
                   : each == "routes"   ? &show.routes
                   : each == "pictures" ? &show.pictures
                   : each == "trend"    ? &show.trend
                                        : nullptr;
    if (wanted == nullptr || *wanted) return members.fail("also has a word that is not known, or one twice");
    *wanted = true;
  }
}

Show read_show(Members& members) {
  Show show;
  show.number = static_cast<std::uint32_t>(members.whole("number", std::numeric_limits<std::int32_t>::max()));
  show.tags.digest = members.word("digest");
  if (const json* tags = members.take("tags")) {
    show.tags.all = *tags == "all";
    if (!show.tags.all) read_ranges(*tags, members, show.tags.ranges);
  }
  if (const json* also = members.take("also")) read_also(*also, members, show);
  if (show.number == 0) members.fail("number counts from 1");
  return show;
}

ViewerState read_has(const json& object, std::string& wrong) {
  Members members(object, wrong);
  ViewerState has;
  has.sequence = members.whole("seq");
  has.tags = members.flag("tags");
  has.program = members.whole("program");
  has.plan = members.whole("plan");
  has.routes = members.whole("routes");
  has.pictures = members.whole("pictures");
  has.alarms = members.whole("alarms");
  has.forces = members.whole("forces");
  has.trend_run = members.whole("trend_run");
  has.trend_next = members.whole("trend_next");
  members.end();
  return has;
}

void read_begin(Members& members, ViewerMessage& message, std::string& wrong) {
  message.begins = true;
  message.protocol = static_cast<std::int64_t>(members.whole("protocol"));
  message.epoch = members.word("epoch");
  if (const json* has = members.take("has")) message.has = read_has(*has, wrong);
  const json* show = members.take("show");
  if (show == nullptr) return members.fail("show is missing");
  Members shown(*show, wrong);
  message.show = read_show(shown);
  shown.end();
}

}  // namespace

tl::expected<ViewerMessage, std::string> read_viewer_message(std::string_view text) {
  if (text.size() > kMostViewerBytes) return tl::unexpected<std::string>("the message is too long");
  const json parsed = json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (parsed.is_discarded()) return tl::unexpected<std::string>("the message is not JSON");
  std::string wrong;
  Members members(parsed, wrong);
  ViewerMessage message;
  const std::string type = members.word("type");
  if (type == "begin") {
    read_begin(members, message, wrong);
  } else if (type == "show") {
    message.show = read_show(members);
  } else {
    members.fail("type is begin or show");
  }
  members.end();
  if (!wrong.empty()) return tl::unexpected<std::string>(std::move(wrong));
  return message;
}

}  // namespace stepwright::protocol
