#include "apps/options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>

#include "apps/help.h"
#include "apps/list_option.h"
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

}  // namespace

NumberRange NumberRange::Positive() { return {.lower = 0, .lower_included = false}; }
NumberRange NumberRange::NotNegative() { return {.lower = 0}; }

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

template int ParseInteger(const std::string&, const std::string&, int, int);
template std::int64_t ParseInteger(const std::string&, const std::string&, std::int64_t,
                                   std::int64_t);
template std::uint64_t ParseInteger(const std::string&, const std::string&, std::uint64_t,
                                    std::uint64_t);

std::size_t FindChoice(const std::string& name, const std::string& given,
                       const std::vector<std::string>& words) {
  const auto found = std::ranges::find(words, given);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  std::string expected;
  for (const std::string& word : words) expected += (expected.empty() ? "" : ", ") + word;
  throw CLI::ValidationError(name, "expected one of " + expected + ", found \"" + given + "\"" +
                                       SimilarWord(given, words));
}

CLI::Option* AddSeed(CLI::App& app, std::uint64_t& value, const std::string& description) {
  return AddInteger(app, "--seed", value, std::uint64_t{0},
                    std::numeric_limits<std::uint64_t>::max(), description);
}

CLI::Option* AddQuiet(CLI::App& app, bool& value) {
  return app.add_flag("-q,--quiet", value, "Print only errors, warnings and failures")
      ->group(kGeneralGroup);
}

std::vector<std::pair<std::string, std::vector<std::string>>> GivenOptions(
    const CLI::App& app, const std::set<std::string>& change_nothing) {
  std::vector<std::pair<std::string, std::vector<std::string>>> given;
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_name();
    if (option->count() == 0 || change_nothing.contains(name)) continue;
    const std::vector<std::string> values =
        IsList(*option) ? std::vector{JoinItems(option->results())} : option->results();
    given.emplace_back(name, values);
  }
  return given;
}

void FrictionOptions::SetDegrees(double degrees) {
  degrees_ = degrees;
  mu_.reset();
}

void FrictionOptions::SetMu(double mu) {
  mu_ = mu;
  degrees_.reset();
}

void FrictionOptions::AddTo(CLI::App& app) {
  const NumberRange angle = {
      .lower = 0, .upper = 90, .lower_included = false, .upper_included = false};
  AddNumber(app, "--friction-angle", degrees_, angle,
            "Friction angle, the half-angle of the friction cone. Degrees in (0, 90)", "DEG");
  AddNumber(app, "--mu", mu_, NumberRange::Positive(),
            "Friction coefficient, the tangent of the friction angle. Replaces --friction-angle");
}

std::optional<double> FrictionOptions::friction_angle() const {
  if (degrees_ && mu_) throw InputError("--friction-angle: cannot be used with --mu");
  if (!degrees_ && !mu_) return std::nullopt;
  const double angle = degrees_ ? Radians(*degrees_) : std::atan(*mu_);
  // A huge or tiny number may be rounded to an end of the interval, in radians or in degrees.
  if (!(angle > 0 && angle < std::numbers::pi / 2 && Degrees(angle) < 90)) {
    throw InputError(degrees_ ? "--friction-angle " + FormatDouble(*degrees_) +
                                    ": too close to an end of (0°, 90°)"
                              : "--mu " + FormatDouble(*mu_) +
                                    ": the friction angle is too close to an end of (0°, 90°)");
  }
  return angle;
}

std::string FrictionOptions::warning() const {
  // Largest plausible coefficient; rubber on rough surfaces has up to 2.
  constexpr double kMostUsual = 3;
  if (!mu_ || *mu_ <= kMostUsual) return "";
  return "--mu " + FormatDouble(*mu_) +
         ": implausible friction coefficient, rubber has 1 to 2; help: give an angle in degrees "
         "with --friction-angle";
}

double FrictionOptions::required_friction_angle() const {
  const std::optional<double> angle = friction_angle();
  if (!angle) throw InputError("friction: --friction-angle DEG or --mu X is required");
  return *angle;
}

void ContactOptions::AddTo(CLI::App& app, const std::string& usual) {
  AddNumber(app, "--torsion", torsion_, NumberRange::NotNegative(),
            "Torsional friction length of soft fingers. Ratio of maximum torque about the contact "
            "normal to maximum tangential force, in object units; 2a/3 for a uniform round patch "
            "of radius a. Force and torque together stay in an ellipsoid. 0: hard contacts "
            "[default: " +
                usual + "]",
            "E");
}

namespace {

/// Return the number of edits, by dynamic programming over prefixes.
int Distance(const std::string& a, const std::string& b) {
  std::vector<std::vector<int>> d(a.size() + 1, std::vector<int>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = static_cast<int>(i + j);
        continue;
      }
      const int replaced = d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      d[i][j] = std::min({replaced, d[i - 1][j] + 1, d[i][j - 1] + 1});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d.back().back();
}

}  // namespace

std::string SimilarWord(const std::string& given, const std::vector<std::string>& words) {
  // Maximum length of the given text, above all words with plausible misspellings.
  constexpr std::size_t kLongest = 64;
  constexpr int kCharactersAnEdit = 3;
  if (given.size() > kLongest) return "";
  std::string nearest;
  int least = std::numeric_limits<int>::max();
  for (const std::string& word : words) {
    const bool begun = given.size() >= kCharactersAnEdit && word.starts_with(given);
    const int distance = begun ? 0 : Distance(given, word);
    if (distance < least) {
      least = distance;
      nearest = word;
    }
  }
  const int most = std::max(1, static_cast<int>(given.size()) / kCharactersAnEdit);
  return least <= most ? "; similar: " + nearest : "";
}

}  // namespace regrasp::apps
