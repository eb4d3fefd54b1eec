#include "apps/options.h"

#include <charconv>
#include <cmath>
#include <numbers>

#include "planner/base/angle.h"
#include "planner/base/error.h"
#include "planner/base/number.h"

namespace regrasp::apps {

namespace {

std::string Describe(const NumberRange& range) {
  const auto value = [](double x) { return FormatDouble(x); };
  std::string text = "expected a number";
  if (std::isfinite(range.lower)) {
    text += (range.lower_included ? " of at least " : " above ") + value(range.lower);
  }
  if (std::isfinite(range.upper)) {
    text += std::isfinite(range.lower) ? " and" : "";
    text += (range.upper_included ? " of at most " : " below ") + value(range.upper);
  }
  return text;
}

bool Contains(const NumberRange& range, double x) {
  const bool above = range.lower_included ? x >= range.lower : x > range.lower;
  const bool below = range.upper_included ? x <= range.upper : x < range.upper;
  return above && below;
}

double ParseNumber(const std::string& name, const std::string& text, const NumberRange& range) {
  const std::optional<double> value = ParseDouble(text);
  if (!value || !Contains(range, *value)) {
    throw CLI::ValidationError(name, Describe(range) + ", found \"" + text + "\"");
  }
  return *value;
}

template <class Integer>
Integer ParseInteger(const std::string& name, const std::string& text, Integer lower,
                     Integer upper) {
  Integer value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || value < lower || value > upper) {
    throw CLI::ValidationError(name, "expected an integer from " + std::to_string(lower) + " to " +
                                         std::to_string(upper) + ", found \"" + text + "\"");
  }
  return value;
}

template <class Number>
CLI::Option* AddParsed(CLI::App& app, const std::string& name, Number& value,
                       const NumberRange& range, const std::string& description,
                       const std::string& type) {
  const auto parse = [name, range, &value](const std::string& text) {
    value = ParseNumber(name, text, range);
  };
  return app.add_option_function<std::string>(name, parse, description)->type_name(type);
}

constexpr char kScaleName[] = "--scale";
constexpr char kScaleType[] = "METRES_PER_UNIT";
constexpr char kScaleText[] = "Metres per unit of length of the object file (default 1)";

}  // namespace

NumberRange NumberRange::Positive() { return {.lower = 0, .lower_included = false}; }
NumberRange NumberRange::NotNegative() { return {.lower = 0}; }

CLI::Option* AddNumber(CLI::App& app, const std::string& name, double& value,
                       const NumberRange& range, const std::string& description) {
  return AddParsed(app, name, value, range, description, "X");
}

CLI::Option* AddNumber(CLI::App& app, const std::string& name, std::optional<double>& value,
                       const NumberRange& range, const std::string& description) {
  return AddParsed(app, name, value, range, description, "X");
}

namespace {

template <typename Value>
CLI::Option* AddIntegerTo(CLI::App& app, const std::string& name, Value& value, int lower,
                          int upper, const std::string& description) {
  const auto parse = [name, lower, upper, &value](const std::string& text) {
    value = ParseInteger(name, text, lower, upper);
  };
  return app.add_option_function<std::string>(name, parse, description)->type_name("N");
}

}  // namespace

CLI::Option* AddInteger(CLI::App& app, const std::string& name, int& value, int lower, int upper,
                        const std::string& description) {
  return AddIntegerTo(app, name, value, lower, upper, description);
}

CLI::Option* AddInteger(CLI::App& app, const std::string& name, std::optional<int>& value,
                        int lower, int upper, const std::string& description) {
  return AddIntegerTo(app, name, value, lower, upper, description);
}

CLI::Option* AddSeed(CLI::App& app, std::uint64_t& value, const std::string& description) {
  const auto parse = [&value](const std::string& text) {
    value =
        ParseInteger<std::uint64_t>("--seed", text, 0, std::numeric_limits<std::uint64_t>::max());
  };
  return app.add_option_function<std::string>("--seed", parse, description)->type_name("N");
}

CLI::Option* AddScale(CLI::App& app, double& value) {
  return AddParsed(app, kScaleName, value, NumberRange::Positive(), kScaleText, kScaleType);
}

CLI::Option* AddScale(CLI::App& app, std::optional<double>& value) {
  return AddParsed(app, kScaleName, value, NumberRange::Positive(), kScaleText, kScaleType);
}

CLI::Option* AddQuiet(CLI::App& app, bool& value) {
  return app.add_flag("--quiet", value, "Print errors and warnings only");
}

void FrictionOptions::AddTo(CLI::App& app) {
  const NumberRange angle = {
      .lower = 0, .upper = 90, .lower_included = false, .upper_included = false};
  AddParsed(app, "--friction-angle", degrees_, angle,
            "Half-angle of the friction cone, degrees in (0, 90)", "DEG");
  AddParsed(app, "--mu", mu_, NumberRange::Positive(),
            "Coefficient of friction, the tangent of the half-angle; instead of --friction-angle",
            "X");
}

std::optional<double> FrictionOptions::half_angle() const {
  if (degrees_ && mu_) throw InputError("--friction-angle and --mu exclude each other");
  if (!degrees_ && !mu_) return std::nullopt;
  const double angle = degrees_ ? Radians(*degrees_) : std::atan(*mu_);
  // A huge or tiny number may round onto an end of the interval, in radians or in degrees.
  if (!(angle > 0 && angle < std::numbers::pi / 2 && Degrees(angle) < 90)) {
    throw InputError(degrees_ ? "--friction-angle " + FormatDouble(*degrees_) +
                                    ": too close to an end of (0°, 90°)"
                              : "--mu " + FormatDouble(*mu_) +
                                    ": the half-angle is too close to an end of (0°, 90°)");
  }
  return angle;
}

double FrictionOptions::required_half_angle() const {
  const std::optional<double> angle = half_angle();
  if (!angle) throw InputError("friction is missing: give --friction-angle DEG or --mu X");
  return *angle;
}

}  // namespace regrasp::apps
