#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace regrasp::apps {

/// The values that a number on the command line may take.
struct NumberRange {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_included = true;
  bool upper_included = true;

  [[nodiscard]] static NumberRange Positive();
  [[nodiscard]] static NumberRange NotNegative();
};

/// Reads a finite number, the same under any locale.
/// @throws CLI::ValidationError  it is none, or outside the range; names the option.
[[nodiscard]] double ParseNumber(const std::string& name, const std::string& text,
                                 const NumberRange& range);

/// Reads a decimal integer of `Integer` (int, std::uint64_t) in [lower, upper].
/// @throws CLI::ValidationError  likewise.
template <class Integer>
[[nodiscard]] Integer ParseInteger(const std::string& name, const std::string& text, Integer lower,
                                   Integer upper);

/// Adds an option that takes a number inside `range`.
/// @param value  a double, or an optional one.
template <class Value>
CLI::Option* AddNumber(CLI::App& app, const std::string& name, Value& value,
                       const NumberRange& range, const std::string& description,
                       const std::string& type = "X") {
  const auto parse = [name, range, &value](const std::string& text) {
    value = ParseNumber(name, text, range);
  };
  return app.add_option_function<std::string>(name, parse, description)->type_name(type);
}

/// Adds an option that takes an integer in [lower, upper].
/// @param value  an integer of the type of the limits, or an optional one.
template <class Value, class Integer>
CLI::Option* AddInteger(CLI::App& app, const std::string& name, Value& value, Integer lower,
                        Integer upper, const std::string& description) {
  const auto parse = [name, lower, upper, &value](const std::string& text) {
    value = ParseInteger<Integer>(name, text, lower, upper);
  };
  return app.add_option_function<std::string>(name, parse, description)->type_name("N");
}

/// The place of a word among those that an option takes.
/// @throws CLI::ValidationError  it is none of them; names the one that was probably meant.
[[nodiscard]] std::size_t FindChoice(const std::string& name, const std::string& given,
                                     const std::vector<std::string>& words);

/// Adds an option that takes one of some words, each of which stands for a value.
template <class Value>
CLI::Option* AddChoice(CLI::App& app, const std::string& name, Value& value,
                       const std::vector<std::pair<std::string, Value>>& choices,
                       const std::string& description) {
  std::vector<std::string> words;
  std::string type;
  for (const auto& [word, unused] : choices) {
    words.push_back(word);
    type += (type.empty() ? "" : "|") + word;
  }
  const auto choose = [name, words, choices, &value](const std::string& given) {
    value = choices[FindChoice(name, given, words)].second;
  };
  return app.add_option_function<std::string>(name, choose, description)->type_name(type);
}

/// Adds `--seed N`, any number of 64 bits.
CLI::Option* AddSeed(CLI::App& app, std::uint64_t& value, const std::string& description);

/// Adds `--scale METRES_PER_UNIT`.
/// @param value  a double, or an optional one.
template <class Value>
CLI::Option* AddScale(
    CLI::App& app, Value& value,
    const std::string& description = "Metres per unit of length of the object file (default 1)") {
  return AddNumber(app, "--scale", value, NumberRange::Positive(), description, "METRES_PER_UNIT");
}

/// Adds `--quiet`.
CLI::Option* AddQuiet(CLI::App& app, bool& value);

/// The options that are given, each with its values, but for those that change no result.
[[nodiscard]] std::vector<std::pair<std::string, std::vector<std::string>>> GivenOptions(
    const CLI::App& app, const std::set<std::string>& change_nothing);

/// Friction as the command line gives it: the cone's half-angle or its tangent.
class FrictionOptions {
 public:
  /// Adds `--friction-angle DEG` and `--mu X`.
  void AddTo(CLI::App& app);

  /// As if --friction-angle had been given, and no --mu; or the other way round.
  void SetDegrees(double degrees);
  void SetMu(double mu);

  /// The half-angle in radians; nullopt where neither option is given.
  /// @throws InputError  both are given, or the half-angle is not inside (0°, 90°) as a double.
  [[nodiscard]] std::optional<double> half_angle() const;

  /// @throws InputError  also where neither is given.
  [[nodiscard]] double required_half_angle() const;

  /// Of a coefficient that hardly any fingertip has; otherwise empty.
  [[nodiscard]] std::string warning() const;

 private:
  std::optional<double> degrees_;
  std::optional<double> mu_;
};

/// What contacts are, as the command line gives it: hard points or soft fingers.
class ContactOptions {
 public:
  /// Adds `--contact hard|soft` and `--torsion R`.
  /// @param usual  what holds where neither is given: "hard", "that of the plan".
  void AddTo(CLI::App& app, const std::string& usual);

  /// grasp::Contact::torsion, the object's unit of length, 0 of hard points; nullopt where nothing
  /// is given.
  /// @throws InputError  --torsion without --contact soft, or that without --torsion.
  [[nodiscard]] std::optional<double> torsion() const;

 private:
  std::optional<bool> soft_;
  std::optional<double> torsion_;
};

}  // namespace regrasp::apps
