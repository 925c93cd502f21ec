#pragma once

// The register map of a program as a document. Pure functions.

#include <string>
#include <vector>

#include "hmi_web/tags/known_tags.h"
#include "runtime/modbus/map/register_rows.h"

namespace stepwright::tags {

// A value that a client can reach, with what is known of it for people.
struct TaggedRow {
  modbus::map::RegisterRow row;
  protocol::TagNote note;
};

std::vector<TaggedRow> tagged(std::vector<modbus::map::RegisterRow> rows, const KnownTags& tags);

// A table a Modbus table, with the default map's ranges in words if it is there.
std::string to_markdown(const std::vector<TaggedRow>& rows, const std::string& title, bool openplc);
// RFC 4180: table, address, registers, functions, name, type, iec_address, access, byte_order, word_order,
// comment, unit, description, group, least, greatest.
std::string to_csv(const std::vector<TaggedRow>& rows);
// A list of objects with the same keys.
std::string to_json(const std::vector<TaggedRow>& rows);

}  // namespace stepwright::tags
