// solver/transport/sources/error_floors.h
//
// Relative errors compare a difference with the light at the same place. In the dark that would ask for
// accuracy that nobody sees, so light below a floor counts as the floor. Each floor is a fraction of a mean
// over the scene, for each channel alone.

#pragma once

namespace penumbra {

// Of the mean irradiance: what `--error` promises (PipelineOptions::error) is measured with this floor, and
// so is how well parts of sources are seen as one (SourceSet).
inline constexpr double kErrorFloor = 0.01;
// Of the mean irradiance, for the weight of discontinuities on a whole leaf: the mean of a leaf says nothing
// of its dark places, for which the floor of errors would ask too much.
inline constexpr double kLeafFloor = 0.05;
// Of the mean reflected radiosity, for cells of a mesh as sources (SourceCells): a cell's deviation arrives
// spread over many receivers, most of them brighter than the floor of errors.
inline constexpr double kCellFloor = 0.05;
// Of the mean reflected radiosity, for the parts into which corrections cut leaves (LeafCells): these bound
// their errors one by one, without a measure of what arrives.
inline constexpr double kPartFloor = 0.5;

}  // namespace penumbra
