#include <gtest/gtest.h>

#include <array>
#include <set>
#include <stdexcept>
#include <vector>

#include "planner/base/number.h"
#include "render/frames/fault_marks.h"
#include "render/frames/replay_animation.h"
#include "tests/render/frames/scenes.h"

namespace regrasp::render {
namespace frame_sequence_test {

/// The three frames of the cube, repeated, each with its own number.
class FrameSequenceTest : public ::testing::Test {
 protected:
  FrameSequenceTest() {
    for (int i = 0; i < 7; ++i) {
      tasks_.push_back({&snapshots_[i % snapshots_.size()], "frame " + std::to_string(i)});
    }
  }

  [[nodiscard]] std::vector<Image> Render(int workers) const {
    std::vector<Image> images;
    RenderInOrder(renderer_, tasks_, workers, [&](int index, const Image& image) {
      EXPECT_EQ(index, static_cast<int>(images.size()));
      images.push_back(image);
    });
    return images;
  }

  object::Polyhedron cube_ = MakeCube(0.03);
  std::vector<plan::Snapshot> snapshots_ = MakeCubeSequence();
  FrameRenderer renderer_{cube_, 1, Radians(20), snapshots_, {480, 360, 1}};
  std::vector<FrameTask> tasks_;
};

TEST_F(FrameSequenceTest, FramesComeInOrderAndDoNotDependOnTheNumberOfWorkers) {
  FrameRenderer alone(renderer_);
  std::set<std::vector<unsigned char>> different;
  std::vector<Image> expected;
  for (const FrameTask& task : tasks_) {
    expected.push_back(alone.Render(*task.snapshot, task.text));
    different.insert(expected.back().rgb);
  }
  EXPECT_EQ(different.size(), tasks_.size());
  for (const int workers : {1, 2, 3, 20}) {
    const std::vector<Image> images = Render(workers);
    ASSERT_EQ(images.size(), expected.size());
    for (std::size_t i = 0; i < images.size(); ++i) {
      EXPECT_TRUE(images[i].rgb == expected[i].rgb) << workers << " workers, frame " << i;
    }
  }
}

TEST_F(FrameSequenceTest, AFrameWithSeveralTextsIsThatOfEachText) {
  const std::array texts = {FrameText{"with a caption", "5 of 90°"}, FrameText{"", "5 of 90°"}};
  const std::vector<Image> images = renderer_.RenderWithTexts(snapshots_[1], texts);
  ASSERT_EQ(images.size(), 2U);
  EXPECT_FALSE(images[0].rgb == images[1].rgb);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(images[i].rgb == renderer_.Render(snapshots_[1], texts[i]).rgb) << i;
  }
}

TEST_F(FrameSequenceTest, AnImageOfAPageHasNoHeadingAndLargerLabels) {
  const FaultMarks marks{.heading = "finger 0 slips by far", .fingers = {}};
  const auto count_red = [&](const FrameText& text, const FaultMarks* fault) {
    const Image image = renderer_.Render(snapshots_[1], text, fault);
    int red = 0;
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
      const Color c = {image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]};
      red += c.r > 150 && c.g < 60 && c.b < 60 ? 1 : 0;
    }
    return red;
  };
  const FrameText in_file, on_page = {"", "", /*is_on_page=*/true, /*size=*/1.5};
  EXPECT_GT(count_red(in_file, &marks), count_red(in_file, nullptr) + 50);
  EXPECT_EQ(count_red(on_page, &marks), count_red(on_page, nullptr));
  const Image small = renderer_.Render(snapshots_[1], in_file);
  const Image large = renderer_.Render(snapshots_[1], on_page);
  EXPECT_FALSE(small.rgb == large.rgb);
}

TEST_F(FrameSequenceTest, NothingToDrawIsNoWork) {
  tasks_.clear();
  EXPECT_TRUE(Render(2).empty());
}

TEST_F(FrameSequenceTest, ErrorsAreThrown) {
  int taken = 0;
  const auto take = [&taken](int, const Image&) {
    if (++taken == 3) throw std::runtime_error("the disk is full");
  };
  EXPECT_THROW(RenderInOrder(renderer_, tasks_, 2, take), std::runtime_error);
  EXPECT_EQ(taken, 3);
}

}  // namespace frame_sequence_test
}  // namespace regrasp::render
