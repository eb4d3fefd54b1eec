#include "render/frames/sequence_cameras.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "planner/base/number.h"
#include "render/frames/annotation.h"
#include "render/frames/viewpoint.h"

namespace regrasp::render {

namespace {

using Eigen::Vector3d;

/// Distance from the centre (diameters) beyond which additional points do not enlarge the view.
constexpr double kFarMark = 1.5;

/// Translation (diameters) beyond which an object does not enlarge the view.
constexpr double kFarAway = 0.5;

/// Margins in font sizes: all around, at the top for a heading, and at the bottom for a caption of
/// two lines.
constexpr double kFrameMargin = 2.1;
constexpr double kHeadingMargin = 3.75;
constexpr double kCaptionMargin = 4.6;
constexpr double kMostMargin = 0.25;  ///< maximum margin per image height

/// Minimum width and height of a cropped frame per original side, for captions and headings.
constexpr double kNarrowest = 0.75;
constexpr double kLowest = 0.35;

/// Maximum number of evenly spaced frames of a hand that determine the viewpoint.
constexpr std::size_t kMostViewed = 12;

/// Cosines of the angle between line of sight and a length: above the first the length appears
/// below 60 % of its size, below the second above 87 %. Cost of an excess over the second.
constexpr double kEndOn = 0.8;
constexpr double kFromTheSide = 0.5;
constexpr double kEndOnCost = 10;

/// Distance from the centre of the object (diameters) within which a hand enlarges the view.
constexpr double kHandReach = 1.15;

int EvenShare(double share, int side) { return 2 * static_cast<int>(share * side / 2); }

Margins MarginsFor(const FrameOptions& options) {
  const double font = FontSize(options.width, options.height) / options.height;
  const auto margin = [&](double fonts) { return std::min(fonts * font, kMostMargin); };
  return {margin(kFrameMargin), margin(options.has_heading ? kHeadingMargin : kFrameMargin),
          margin(kCaptionMargin)};
}

bool IsNear(const Eigen::Isometry3d& pose) {
  return pose.translation().allFinite() && pose.translation().norm() < kFarAway;
}

class CameraChooser {
 public:
  explicit CameraChooser(const FrameModel& model) : model_(model) {}

  /// Compute cameras that see everything.
  [[nodiscard]] SequenceCameras Choose(const std::vector<plan::Snapshot>& snapshots) const {
    const Sequence all = SequenceOf(snapshots);
    const ViewOptions& view = model_.options.view;
    Viewpoints viewpoints =
        view.direction ? Viewpoints{view.direction->ToCamera(), {}} : ViewpointsOf(all);
    if (!view.direction && !model_.planar) ShowLengths(snapshots.size(), viewpoints);
    const std::vector<Vector3d> points = ExtentOf(all, CameraAxes(viewpoints.common));
    SequenceCameras cameras = {
        FitTo(points, viewpoints.common, model_.options.width, model_.options.height)};
    if (model_.options.crop) {
      cameras.common = Crop(cameras.common, MarginsFor(model_.options), points,
                            EvenShare(kNarrowest, model_.options.width),
                            EvenShare(kLowest, model_.options.height));
    }
    const auto& [width, height] = std::pair(cameras.common.width, cameras.common.height);
    for (std::size_t i = 0; i < viewpoints.own.size(); ++i) {
      if (!viewpoints.own[i]) continue;
      const Vector3d& back = *viewpoints.own[i];
      cameras.own[static_cast<int>(i)] =
          FitTo(ExtentOf(all, CameraAxes(back)), back, width, height);
    }
    cameras.common.half_height /= view.zoom;
    for (auto& [index, camera] : cameras.own) camera.half_height /= view.zoom;
    return cameras;
  }

 private:
  /// Return how directly the worst of the required lengths points towards the eye, 0 to 1.
  [[nodiscard]] double EndOn(const Vector3d& back) const {
    double worst = 0;
    for (const Vector3d& along : model_.options.shown_lengths) {
      worst = std::max(worst, std::abs(along.dot(back)));
    }
    return worst;
  }

  /// Give the last snapshot its own viewpoint if the present one does not show the required
  /// lengths: the nearest one by azimuth that shows them, on the side of the marks.
  void ShowLengths(std::size_t count, Viewpoints& viewpoints) const {
    if (count == 0) return;
    viewpoints.own.resize(count);
    const Vector3d now = viewpoints.own.back().value_or(viewpoints.common);
    if (EndOn(now) < kEndOn) return;
    Vector3d marks = Vector3d::Zero();
    for (const Vector3d& p_W : model_.options.also_seen) marks += model_.frame.FromWorld(p_W);
    double best = -std::numeric_limits<double>::infinity();
    for (int degrees = -150; degrees <= 180; degrees += 10) {
      const Vector3d back = Eigen::AngleAxisd(Radians(degrees), Vector3d::UnitZ()) * now;
      const double turn = std::abs(degrees) / 180.0;
      const double side = marks.norm() > 0 ? marks.normalized().dot(back) : 0;
      const double score = side - turn - kEndOnCost * std::max(0.0, EndOn(back) - kFromTheSide);
      if (score <= best) continue;
      best = score;
      viewpoints.own.back() = back;
    }
  }

  /// Everything that is drawn of a sequence.
  struct Sequence {
    /// Fingers of each frame; empty if the object is far away.
    std::vector<std::vector<FingerGlyph>> frames = {};
    std::vector<Eigen::Isometry3d> poses = {Eigen::Isometry3d::Identity()};
    /// Object and hand in each frame of a plan for a hand.
    std::vector<FramePlacement> placements = {};
    std::vector<Vector3d> hands = {};  ///< points that bound the hands
  };

  [[nodiscard]] Sequence SequenceOf(const std::vector<plan::Snapshot>& snapshots) const {
    Sequence all;
    for (const plan::Snapshot& snapshot : snapshots) {
      all.frames.emplace_back();
      if (model_.hand) all.placements.emplace_back();
      const Eigen::Isometry3d pose = model_.frame.BodyPose(snapshot.X_WO);
      if (!IsNear(pose)) continue;
      all.poses.push_back(pose);
      if (snapshot.X_WO_before) all.poses.push_back(model_.frame.BodyPose(*snapshot.X_WO_before));
      if (model_.hand) {
        all.placements.back() = {pose.inverse(), model_.hand->Rays(snapshot)};
        for (const Vector3d& p : model_.hand->Bounds(snapshot)) {
          if ((p - pose.translation()).norm() < kHandReach) all.hands.push_back(p);
        }
      }
      all.frames.back() = model_.GlyphsOf(snapshot, /*free_fingers=*/false);
    }
    return all;
  }

  /// Return points whose projections bound the images of a sequence.
  [[nodiscard]] std::vector<Vector3d> ExtentOf(const Sequence& all,
                                               const Eigen::Matrix3d& axes) const {
    ProjectedExtent extent(axes, model_.meshes);
    for (const Eigen::Isometry3d& pose : all.poses) extent.Add(MeshInstance{kOutsideMesh, pose});
    for (const std::vector<FingerGlyph>& fingers : all.frames) {
      for (const Shape& shape : model_.FingerShapes(fingers)) extent.Add(shape.form);
      for (const FingerGlyph& glyph : fingers) {
        extent.Add(Sphere{glyph.end + glyph.outward * kLabelSpace, kLabelSpace / 2});
      }
    }
    for (const Vector3d& p : all.hands) extent.Add(Sphere{p, 0});
    for (const Vector3d& p_W : model_.options.reached)
      extent.Add(Sphere{model_.frame.FromWorld(p_W), 0});
    for (const Vector3d& p_W : model_.options.also_seen) {
      const Vector3d p = model_.frame.FromWorld(p_W);
      if (p.norm() < kFarMark) extent.Add(Sphere{p, kLabelSpace / 2});
    }
    return extent.points();
  }

  /// Fit a camera with the same margins in pixels for any height.
  [[nodiscard]] Camera FitTo(const std::vector<Vector3d>& points, const Vector3d& back, int width,
                             int height) const {
    Margins margins = MarginsFor(model_.options);
    for (double* margin : {&margins.side, &margins.top, &margins.bottom}) {
      *margin *= static_cast<double>(model_.options.height) / height;
    }
    const Projection default_projection =
        model_.planar ? Projection::kOrthographic : Projection::kPerspective;
    return FitCamera(CameraAxes(back), model_.options.view.projection.value_or(default_projection),
                     width, height, margins, points);
  }

  /// Choose viewpoints. A plan for a hand has one viewpoint, with the palm fixed in the image.
  [[nodiscard]] Viewpoints ViewpointsOf(const Sequence& all) const {
    if (all.placements.empty()) {
      return ChooseViewpoints(model_.body, model_.planar, all.frames, model_.largest_force);
    }
    const std::size_t stride = 1 + (all.frames.size() - 1) / kMostViewed;
    std::vector<std::vector<FingerGlyph>> frames;
    std::vector<FramePlacement> placements;
    for (std::size_t i = 0; i < all.frames.size(); i += stride) {
      frames.push_back(all.frames[i]);
      placements.push_back(all.placements[i]);
    }
    return {ChooseViewpoints(model_.body, model_.planar, frames, model_.largest_force, placements)
                .common,
            {}};
  }

  const FrameModel& model_;
};

}  // namespace

SequenceCameras MakeCameras(const FrameModel& model, const std::vector<plan::Snapshot>& snapshots) {
  return CameraChooser(model).Choose(snapshots);
}

}  // namespace regrasp::render
