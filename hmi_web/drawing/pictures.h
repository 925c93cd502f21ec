#pragma once

// Pictures of pixels that stand in a drawing itself, as "data:image/png;base64,...". Pure; any thread.

#include <string_view>

namespace stepwright::drawing {

// Png, jpeg or webp in base64: nothing is loaded, and nothing in it can run.
bool is_embedded_picture(std::string_view value);
// Whether the data begins and ends as one of them does, whatever it is called: else a browser shows a broken
// picture. Requires is_embedded_picture.
bool is_whole_picture(std::string_view value);

}  // namespace stepwright::drawing
