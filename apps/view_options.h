#pragma once

#include <CLI/CLI.hpp>
#include <optional>

#include "render/frames/frame.h"

namespace regrasp::apps {

/// Adds `--view`: where pictures are taken from.
void AddView(CLI::App& app, std::optional<render::ViewDirection>& view);

/// Adds `--edges` and `--crease-angle`: which lines of an object are drawn.
void AddEdges(CLI::App& app, render::BodyOptions& body);

/// Adds both, `--zoom` and `--orthographic`.
void AddFrameView(CLI::App& app, render::FrameOptions& frame);

}  // namespace regrasp::apps
