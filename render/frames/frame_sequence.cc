#include "render/frames/frame_sequence.h"

#include <algorithm>
#include <deque>
#include <future>
#include <vector>

namespace regrasp::render {

void RenderInOrder(const FrameRenderer& renderer, std::span<const FrameTask> tasks, int workers,
                   const std::function<void(int index, const Image& image)>& take) {
  const auto count = static_cast<int>(tasks.size());
  const int ahead = std::min(workers, count);
  std::vector<FrameRenderer> renderers(ahead, renderer);
  std::deque<std::future<Image>> frames;
  // A renderer's next task starts when its last one is done.
  const auto start = [&](int index) {
    frames.push_back(std::async(std::launch::async, [&, index] {
      const FrameTask& task = tasks[index];
      return renderers[index % ahead].Render(*task.snapshot, task.caption, task.fault, task.view);
    }));
  };
  for (int index = 0; index < ahead; ++index) start(index);
  for (int index = 0; index < count; ++index) {
    const Image image = frames.front().get();
    frames.pop_front();
    if (index + ahead < count) start(index + ahead);
    take(index, image);
  }
}

}  // namespace regrasp::render
