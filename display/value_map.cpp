#include "display/value_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "display/false_colour.h"
#include "display/markup.h"
#include "display/round_ticks.h"

namespace penumbra {
namespace {

constexpr double kLongSide = 640;                                   // of the map [px]
constexpr double kLeft = 64, kTop = 44, kBelow = 56, kRight = 130;  // margins [px]
constexpr double kBarGap = 24, kBarWidth = 22;                      // of the scale [px]
constexpr int kMostTicks = 9, kMostContours = 10, kBarSteps = 128;

std::string ColourText(double x) {
  const ScreenColour colour = FalseColour(x);
  return fmt::format("#{:02x}{:02x}{:02x}", colour.red, colour.green, colour.blue);
}

// Draws one map. Lengths and places of the drawing are in px.
class MapDrawing {
 public:
  explicit MapDrawing(const ValueMap& map) : map_(map) {
    for (const double value : map.grid.values)
      if (!std::isnan(value)) top_ = std::max(top_, value);
    if (top_ == 0) top_ = 1;  // all is dark; the scale still needs an end
    cell_ = kLongSide / std::max(map.grid.columns, map.grid.rows);
    width_ = cell_ * map.grid.columns;
    height_ = cell_ * map.grid.rows;
  }

  std::string Svg() {
    Add("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 "
        "{0:.0f} {1:.0f}\" "
        "font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"100%\" height=\"100%\" "
        "fill=\"white\"/>\n",
        kLeft + width_ + kRight, kTop + height_ + kBelow);
    Add("<text x=\"{:.1f}\" y=\"26\" font-size=\"15\">{}</text>\n", kLeft, EscapeMarkup(map_.title));
    AddCells();
    AddContours();
    AddAxes();
    AddScale();
    return svg_ + "</svg>\n";
  }

 private:
  template <class... Values>
  void Add(fmt::format_string<Values...> format, Values&&... values) {
    svg_ += fmt::format(format, std::forward<Values>(values)...);
  }

  // The place of (column, row); squares are centred on whole numbers.
  Vec2 Place(const Vec2& at) const {
    return {kLeft + cell_ * (at.x() + 0.5), kTop + height_ - cell_ * (at.y() + 0.5)};
  }

  void AddCells() {
    svg_ += "<g shape-rendering=\"crispEdges\">\n";
    for (int row = 0; row < map_.grid.rows; ++row)
      for (int column = 0; column < map_.grid.columns; ++column) {
        const double value = map_.grid.At(column, row);
        if (std::isnan(value)) continue;
        const Vec2 corner = Place({column - 0.5, row + 0.5});
        Add("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n", corner.x(),
            corner.y(), cell_, cell_, ColourText(value / top_));
      }
    svg_ += "</g>\n";
  }

  // A line at each round value, with the value beside one of its segments: of neighbouring lines at different
  // heights, so that labels do not crowd.
  void AddContours() {
    constexpr double kGoldenSection = 0.618;
    double share = 0.5;
    for (const double level : RoundTicks(0, top_, kMostContours)) {
      const std::vector<std::array<Vec2, 2>> lines = ContourLines(map_.grid, level);
      if (lines.empty()) continue;
      share += kGoldenSection - std::floor(share + kGoldenSection);
      AddContour(lines, level, static_cast<std::size_t>(share * static_cast<double>(lines.size())));
    }
  }

  void AddContour(const std::vector<std::array<Vec2, 2>>& lines, double level, std::size_t labelled) {
    std::string path;
    for (const std::array<Vec2, 2>& line : lines) {
      const Vec2 a = Place(line[0]), b = Place(line[1]);
      path += fmt::format("M{:.2f} {:.2f}L{:.2f} {:.2f}", a.x(), a.y(), b.x(), b.y());
    }
    // Light on dark and dark on light: two strokes can be seen on every colour.
    Add("<path d=\"{0}\" fill=\"none\" stroke=\"black\" stroke-width=\"2.4\" stroke-opacity=\"0.55\"/>\n"
        "<path d=\"{0}\" fill=\"none\" stroke=\"white\" stroke-width=\"1\"/>\n",
        path);
    const Vec2 at = Place(0.5 * (lines[labelled][0] + lines[labelled][1]));
    Add("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"11\" text-anchor=\"middle\" fill=\"white\" "
        "stroke=\"black\" "
        "stroke-width=\"2.5\" paint-order=\"stroke\">{:g}</text>\n",
        at.x(), at.y() + 4, level);
  }

  void AddAxes() {
    Add("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" "
        "stroke=\"black\"/>\n",
        kLeft, kTop, width_, height_);
    const Vec2 low = map_.first - Vec2::Constant(0.5 * map_.spacing);
    const double px_per_metre = cell_ / map_.spacing, base = kTop + height_;
    for (const double x : RoundTicks(low.x(), low.x() + map_.spacing * map_.grid.columns, kMostTicks)) {
      const double at = kLeft + px_per_metre * (x - low.x());
      Add("<path d=\"M{0:.1f} {1:.1f}v5\" stroke=\"black\"/><text x=\"{0:.1f}\" y=\"{2:.1f}\" "
          "text-anchor=\"middle\">{3:g}</text>\n",
          at, base, base + 20, x);
    }
    for (const double y : RoundTicks(low.y(), low.y() + map_.spacing * map_.grid.rows, kMostTicks)) {
      const double at = base - px_per_metre * (y - low.y());
      Add("<path d=\"M{:.1f} {:.1f}h-5\" stroke=\"black\"/><text x=\"{:.1f}\" y=\"{:.1f}\" "
          "text-anchor=\"end\">{:g}</text>\n",
          kLeft, at, kLeft - 8, at + 4.5, y);
    }
    Add("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">x [m]</text>\n", kLeft + width_ / 2,
        base + 42);
    Add("<text x=\"16\" y=\"{0:.1f}\" text-anchor=\"middle\" transform=\"rotate(-90 16 {0:.1f})\">y "
        "[m]</text>\n",
        kTop + height_ / 2);
  }

  void AddScale() {
    const double x = kLeft + width_ + kBarGap, step = height_ / kBarSteps;
    svg_ += "<g shape-rendering=\"crispEdges\">\n";
    for (int i = 0; i < kBarSteps; ++i)
      Add("<rect x=\"{:.1f}\" y=\"{:.2f}\" width=\"{:.1f}\" height=\"{:.2f}\" fill=\"{}\"/>\n", x,
          kTop + height_ - (i + 1) * step, kBarWidth, step + 0.5, ColourText((i + 0.5) / kBarSteps));
    svg_ += "</g>\n";
    Add("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" "
        "stroke=\"black\"/>\n",
        x, kTop, kBarWidth, height_);
    for (const double value : RoundTicks(0, top_, kMostContours)) {
      const double y = kTop + height_ * (1 - value / top_);
      Add("<path d=\"M{:.1f} {:.1f}h5\" stroke=\"black\"/><text x=\"{:.1f}\" y=\"{:.1f}\">{:g}</text>\n",
          x + kBarWidth, y, x + kBarWidth + 8, y + 4.5, value);
    }
    Add("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", x, kTop - 10, EscapeMarkup(map_.unit));
  }

  const ValueMap& map_;
  double top_ = 0;  // the end of the scale
  double cell_ = 0, width_ = 0, height_ = 0;
  std::string svg_;
};

}  // namespace

std::string ValueMapSvg(const ValueMap& map) { return MapDrawing(map).Svg(); }

}  // namespace penumbra
