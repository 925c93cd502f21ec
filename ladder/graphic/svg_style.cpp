#include "ladder/graphic/svg_style.h"

namespace stepwright::graphic {

std::string drawing_style() {
  return R"(.sw-drawing text{font-family:ui-monospace,'DejaVu Sans Mono','Liberation Mono',Menlo,Consolas,monospace;font-size:12px;fill:#222}
.sw-drawing text.sw-centre{text-anchor:middle}
.sw-drawing text.sw-end{text-anchor:end}
.sw-paper{fill:#f4f4f4}
.sw-wire{stroke:#333;stroke-width:1.5;fill:none}
.sw-box{fill:#fff;stroke:#333;stroke-width:1.5}
.sw-arrow{fill:#333}
)";
}

std::string ladder_style() {
  return R"(.sw-drawing text.sw-title{text-anchor:middle;font-weight:bold}
.sw-drawing text.sw-number{font-size:11px;fill:#777}
.sw-drawing text.sw-rung-comment{font-size:11px;fill:#555}
.sw-drawing text.sw-note{font-size:9px;fill:#555;text-anchor:middle}
.sw-rail{stroke:#111;stroke-width:3.5}
.sw-active .sw-wire{stroke:#0b5394;stroke-width:3}
.sw-active .sw-box{fill:#bcd9f2}
)";
}

std::string sfc_style() {
  return R"(.sw-drawing text.sw-name{font-weight:bold;text-anchor:middle}
.sw-drawing text.sw-comment{font-size:10px;fill:#555;text-anchor:middle}
.sw-drawing text.sw-label{font-size:10px;fill:#777;text-anchor:end}
.sw-halo{stroke:#f4f4f4;stroke-width:7}
.sw-bar{stroke:#111;stroke-width:3.5}
.sw-inner{fill:none;stroke:#333;stroke-width:1.2}
.sw-cell{fill:#fff;stroke:#777;stroke-width:1}
.sw-step.sw-done .sw-box{fill:#dcdcdc}
.sw-step.sw-active .sw-box{fill:#bcd9f2;stroke:#0b5394;stroke-width:2.5}
.sw-step.sw-active .sw-cell{fill:#e4f0fa}
)";
}

}  // namespace stepwright::graphic
