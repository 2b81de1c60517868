// display/tile_grid.h
//
// The tiles of a picture (64 x 64 pixels), and the conversion between the order of pixels in tiles and in
// rows of an image.

#pragma once

#include <algorithm>
#include <cstddef>

#include "display/vector_kernels.h"

namespace penumbra {

struct TileGrid {
  int width = 0, height = 0;  // size of the picture [pixels]
  int across = 0, down = 0;   // number of tiles in a row and in a column

  TileGrid() = default;
  TileGrid(int w, int h)
      : width(w), height(h), across((w + kTileSize - 1) / kTileSize), down((h + kTileSize - 1) / kTileSize) {}

  std::size_t Count() const { return static_cast<std::size_t>(across) * static_cast<std::size_t>(down); }
  int X(std::size_t tile) const { return static_cast<int>(tile) % across * kTileSize; }
  int Y(std::size_t tile) const { return static_cast<int>(tile) / across * kTileSize; }
};

// Divides the pixels in the first `height` rows of the tile at (x0, y0) that lie in the picture into runs of
// n <= 4 pixels of one row. Calls body(index in the tile, index in the picture, n) for each run of n pixels.
// With `height` 4, ForEachPart() divides one row of 4 x 4 blocks instead of a whole tile.
template <class Body>
void ForEachPart(const TileGrid& grid, int x0, int y0, int height, const Body& body) {
  const int rows = std::min(height, grid.height - y0), columns = std::min(kTileSize, grid.width - x0);
  for (int y = 0; y < rows; ++y) {
    const std::size_t row = static_cast<std::size_t>(y0 + y) * static_cast<std::size_t>(grid.width) +
                            static_cast<std::size_t>(x0);
    for (int x = 0; x < columns; x += kBlockSize)
      body(static_cast<std::size_t>(TileIndex(x, y)), row + static_cast<std::size_t>(x),
           static_cast<std::size_t>(std::min(kBlockSize, columns - x)));
  }
}

// Calls body(x, y) for each row of 4 x 4 blocks of the tile that lies in the picture; (x, y) is the upper
// left pixel of the row of blocks.
template <class Body>
void ForEachBlockRow(const TileGrid& grid, std::size_t tile, const Body& body) {
  const int end = std::min(grid.Y(tile) + kTileSize, grid.height);
  for (int y = grid.Y(tile); y < end; y += kBlockSize) body(grid.X(tile), y);
}

// Copies n values of a part of a pixel row. If n == kBlockSize, as is common, a separate branch lets the
// compiler copy the values as one word.
template <class T>
void CopyPart(const T* from, std::size_t n, T* to) {
  if (n == kBlockSize)
    std::copy_n(from, kBlockSize, to);
  else
    std::copy_n(from, n, to);
}

}  // namespace penumbra
