#pragma once

// Drawings of a ladder diagram: contacts, comparisons, parallel branches, blocks with their pins and coils
// between two power rails. What a rung powers (blocks, then coils, then its jump) hangs below each other at
// the right rail. Pure functions of their input: the same program gives the same bytes.
//
// The SVG scales (viewBox); rung k (from 1) is the group `<g class="sw-rung" data-rung="k">`, every contact
// and coil carries `data-variable="NAME"`, so that a viewer can light what has power (class `sw-active`).

#include <string>

#include "ladder/graphic/ladder_program.h"

namespace stepwright::graphic {

std::string draw_ladder_svg(const LadderProgram& program);
// UTF-8 with box characters, for a terminal. Rungs that are wider than `max_width` characters go on in
// another line where they can; 0 = no bound.
std::string draw_ladder_text(const LadderProgram& program, int max_width = 0);

}  // namespace stepwright::graphic
