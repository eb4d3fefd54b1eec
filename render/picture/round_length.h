#pragma once

namespace regrasp::render {

/// The longest of 1, 2 or 5 times a power of ten that is no longer than `limit` (> 0).
[[nodiscard]] double RoundLength(double limit);

}  // namespace regrasp::render
