#pragma once

// Blocks that flow over pages. Internal to this folder; not thread-safe.

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "ladder/graphic/svg_writer.h"

namespace stepwright::print {

struct Block {
  int height = 0;
  std::function<void(graphic::SvgWriter&, int x, int y)> draw;
  bool keep = false;                               // not the last one of a page
  std::shared_ptr<const Block> head{};             // repeated at the top of a page
  std::function<void(std::size_t page)> placed{};  // told its page, from 1, before anything is drawn
};

struct PlacedBlock {
  const Block* block = nullptr;
  int y = 0;
};

struct Page {
  std::size_t sheet = 0;
  std::vector<PlacedBlock> blocks;
};

// Appends the pages of one sheet, one at least. A block that is higher than `height` gets a page of its own.
// `blocks` must outlive the pages.
void flow(const std::vector<Block>& blocks, std::size_t sheet, int height, std::vector<Page>& pages);

}  // namespace stepwright::print
