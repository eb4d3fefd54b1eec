#pragma once

#include <CLI/CLI.hpp>

#include "render/frames/frame.h"

namespace regrasp::apps {

/// Adds what frames look like and where they are taken from: `--view`, `--zoom`, `--orthographic`,
/// `--edges`, `--crease-angle`.
void AddView(CLI::App& app, render::FrameOptions& frame);

}  // namespace regrasp::apps
