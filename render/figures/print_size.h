#pragma once

namespace regrasp::render {

/// The widths that journals print figures at, in points: a column, 85 mm, and two, 174 mm.
inline constexpr double kPointsPerMillimetre = 72 / 25.4;
inline constexpr double kColumnWidth = 85 * kPointsPerMillimetre;
inline constexpr double kTwoColumnWidth = 174 * kPointsPerMillimetre;

}  // namespace regrasp::render
