#pragma once

#include <cstddef>
#include <functional>

namespace regrasp {

/// Works on the indices below `count` in several threads, a block at a time: `work(begin, end)`.
/// Blocks are taken in order; one that was taken is finished.
/// @param block    ≥ 1 indices that a thread takes: enough that taking them costs nothing, few
///                 enough that the threads end together.
/// @param threads  0: as many as the machine has cores; no more than there are blocks.
/// @throws std::invalid_argument  fewer than 0 threads.
/// @throws what `work` throws in the first block of all that throw; later ones may not be worked
///         on.
void InBlocks(std::size_t count, std::size_t block, int threads,
              const std::function<void(std::size_t begin, std::size_t end)>& work);

}  // namespace regrasp
