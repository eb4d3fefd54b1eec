#include "render/figures/contact_space_figure.h"

#include <gmock/gmock.h>
#include <png.h>

#include <iterator>
#include <regex>
#include <string>

#include "render/figures/contact_space_map.h"
#include "tests/render/figures/contact_space_scenes.h"
#include "tests/render/figures/planar_scenes.h"

namespace regrasp::render {
namespace contact_space_figure_test {

constexpr FigureFormat kFormats[] = {FigureFormat::kSvg, FigureFormat::kPdf, FigureFormat::kPng};

/// Return how often an SVG paints with a colour: "fill" or "stroke".
int Count(const std::string& svg, const std::string& how, Color color) {
  const auto percent = [](int channel) { return std::to_string(channel * 100 / 255); };
  const std::string rgb = "rgb\\(" + percent(color.r) + "(\\.\\d+)?%,\\s*" + percent(color.g) +
                          "(\\.\\d+)?%,\\s*" + percent(color.b) + "(\\.\\d+)?%\\)";
  const std::regex pattern("[\" ;]" + how + ":\\s*" + rgb);
  return static_cast<int>(std::distance(std::sregex_iterator(svg.begin(), svg.end(), pattern), {}));
}

int PngWidth(const std::string& bytes) {
  png_image header = {};
  header.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()) == 0) return 0;
  const int width = static_cast<int>(header.width);
  png_image_free(&header);
  return width;
}

struct Fork {
  object::Polygon polygon = MakeFork();
  plan::Plan plan = MakeForkPlan();
  ContactSpaceFigures figures{polygon, plan};
};

TEST(ContactSpaceFigureTest, TheSetsOfThePlanHaveTheirTints) {
  Fork fork;
  const std::string overview = fork.figures.DrawOverview({.format = FigureFormat::kSvg});
  for (const int name : {0, 1, 2}) EXPECT_EQ(Count(overview, "fill", PlanSetTint(name)), 1) << name;
  EXPECT_EQ(Count(overview, "fill", PlanSetTint(3)), 0);
  EXPECT_GT(Count(overview, "fill", OtherSetTint(sets::SetIndex(0))) +
                Count(overview, "fill", OtherSetTint(sets::SetIndex(1))),
            0);
}

TEST(ContactSpaceFigureTest, ASwitchShowsItsTwoSetsOnceInTheirWindowsAndOnceAsBars) {
  Fork fork;
  for (const int entry : {1, 2}) {
    const auto svg =
        fork.figures.DrawSwitch(plan::EntryIndex(entry), {.format = FigureFormat::kSvg});
    ASSERT_TRUE(svg.has_value());
    for (const int name : {0, 1, 2}) {
      const bool shown = name == entry - 1 || name == entry;
      EXPECT_EQ(Count(*svg, "fill", PlanSetTint(name)), shown ? 2 : 0) << entry << " " << name;
    }
  }
}

TEST(ContactSpaceFigureTest, OnlyAStretchingSetIsHatched) {
  constexpr Color kPale = {252, 252, 252};
  Fork fork;
  EXPECT_EQ(Count(*fork.figures.DrawSwitch(plan::EntryIndex(1), {.format = FigureFormat::kSvg}),
                  "stroke", kPale),
            0);
  EXPECT_EQ(Count(*fork.figures.DrawSwitch(plan::EntryIndex(2), {.format = FigureFormat::kSvg}),
                  "stroke", kPale),
            1);
}

TEST(ContactSpaceFigureTest, OnlySwitchesThatKeepAContactHaveAFigure) {
  Fork fork;
  EXPECT_EQ(fork.figures.DrawSwitch(plan::EntryIndex(0), {.format = FigureFormat::kSvg}),
            std::nullopt);
  const object::Polygon square = MakeSquare();
  const plan::Plan exchange = MakeExchangePlan();
  ContactSpaceFigures exchanged(square, exchange);
  EXPECT_EQ(exchanged.DrawSwitch(plan::EntryIndex(1), {.format = FigureFormat::kSvg}),
            std::nullopt);
  EXPECT_FALSE(exchanged.DrawOverview({.format = FigureFormat::kSvg}).empty());
  const object::Polygon disc = MakeDisc(12);
  const plan::Plan align = MakeDiscPlan(disc);
  EXPECT_EQ(ContactSpaceFigures(disc, align)
                .DrawSwitch(plan::EntryIndex(1), {.format = FigureFormat::kSvg}),
            std::nullopt);
}

TEST(ContactSpaceFigureTest, TheSamePlanHasTheSameBytesAndAnotherHasOthers) {
  // Files are compared as a whole: EXPECT_EQ would print megabytes.
  for (const FigureFormat format : kFormats) {
    Fork first, second;
    EXPECT_TRUE(first.figures.DrawOverview({.format = format}) ==
                second.figures.DrawOverview({.format = format}));
    EXPECT_TRUE(first.figures.DrawSwitch(plan::EntryIndex(1), {.format = format}) ==
                second.figures.DrawSwitch(plan::EntryIndex(1), {.format = format}));
    EXPECT_FALSE(first.figures.DrawSwitch(plan::EntryIndex(1), {.format = format}) ==
                 first.figures.DrawSwitch(plan::EntryIndex(2), {.format = format}));
  }
}

TEST(ContactSpaceFigureTest, ALargeOverviewIsTwoColumnsWide) {
  Fork fork;
  EXPECT_EQ(PngWidth(fork.figures.DrawOverview({.format = FigureFormat::kPng})), 1004);
  EXPECT_EQ(PngWidth(*fork.figures.DrawSwitch(plan::EntryIndex(1), {.format = FigureFormat::kPng})),
            2055);
  for (const int edges : {30, 100}) {
    const object::Polygon disc = MakeDisc(edges);
    const plan::Plan plan = MakeDiscPlan(disc);
    EXPECT_EQ(
        PngWidth(ContactSpaceFigures(disc, plan).DrawOverview({.format = FigureFormat::kPng})),
        edges < 60 ? 1004 : 2055);
  }
}

}  // namespace contact_space_figure_test
}  // namespace regrasp::render
