#pragma once

#include <CLI/CLI.hpp>
#include <optional>

#include "render/frames/frame.h"

namespace regrasp::apps {

/// Add `--view AZIMUTH,ELEVATION`, the view direction.
void AddView(CLI::App& app, std::optional<render::ViewDirection>& view);

/// Add `--edges`, the drawn lines of an object and their crease angle.
void AddEdges(CLI::App& app, render::BodyOptions& body);

/// Add `--view` with zoom and projection, `--edges` and `--background`.
void AddFrameView(CLI::App& app, render::FrameOptions& frame);

}  // namespace regrasp::apps
