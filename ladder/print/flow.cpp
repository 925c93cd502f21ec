#include "ladder/print/flow.h"

namespace stepwright::print {

void flow(const std::vector<Block>& blocks, std::size_t sheet, int height, std::vector<Page>& pages) {
  pages.push_back({sheet, {}});
  int y = 0;
  const auto new_page = [&](const Block& next) {
    pages.push_back({sheet, {}});
    y = 0;
    if (!next.head) return;
    pages.back().blocks.push_back({next.head.get(), 0});
    y = next.head->height;
  };
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    // What stays together: blocks that may not be the last and the one behind them.
    int together = blocks[i].height;
    for (std::size_t j = i; blocks[j].keep && j + 1 < blocks.size(); ++j) together += blocks[j + 1].height;
    const bool starts = i == 0 || !blocks[i - 1].keep || together > height;
    const bool full = y > 0 && (starts ? y + together > height : y + blocks[i].height > height);
    if (full) new_page(blocks[i]);
    pages.back().blocks.push_back({&blocks[i], y});
    y += blocks[i].height;
    if (blocks[i].placed) blocks[i].placed(pages.size());
  }
}

}  // namespace stepwright::print
