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

/// Range of a number on the command line.
struct NumberRange {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_included = true;
  bool upper_included = true;

  [[nodiscard]] static NumberRange Positive();
  [[nodiscard]] static NumberRange NotNegative();
};

/// Return the long name among "-j,--jobs".
[[nodiscard]] inline std::string LongName(const std::string& names) {
  return names.substr(names.find("--"));
}

/// Parse a finite number, the same under any locale.
/// @throws CLI::ValidationError  if the text is not a number in the range; names the option.
[[nodiscard]] double ParseNumber(const std::string& name, const std::string& text,
                                 const NumberRange& range);

/// Parse a decimal integer of type `Integer` in [lower, upper].
/// `Integer` is int or std::uint64_t, for example.
/// @throws CLI::ValidationError  as ParseNumber.
template <class Integer>
[[nodiscard]] Integer ParseInteger(const std::string& name, const std::string& text, Integer lower,
                                   Integer upper);

/// Add an option that takes a number inside `range`.
/// @param value  destination: a double, or an optional one.
template <class Value>
CLI::Option* AddNumber(CLI::App& app, const std::string& name, Value& value,
                       const NumberRange& range, const std::string& description,
                       const std::string& type = "X") {
  const auto parse = [label = LongName(name), range, &value](const std::string& text) {
    value = ParseNumber(label, text, range);
  };
  return app.add_option_function<std::string>(name, parse, description)->type_name(type);
}

/// Add an option that takes an integer in [lower, upper].
/// @param value  destination: an integer of the type of the limits, or an optional one.
template <class Value, class Integer>
CLI::Option* AddInteger(CLI::App& app, const std::string& name, Value& value, Integer lower,
                        Integer upper, const std::string& description) {
  const auto parse = [label = LongName(name), lower, upper, &value](const std::string& text) {
    value = ParseInteger<Integer>(label, text, lower, upper);
  };
  return app.add_option_function<std::string>(name, parse, description)->type_name("N");
}

/// Return the index of a word among the choices of an option.
/// @throws CLI::ValidationError  if it is not one of them; names a similar one.
[[nodiscard]] std::size_t FindChoice(const std::string& name, const std::string& given,
                                     const std::vector<std::string>& words);

/// Add an option whose value is one of some words.
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

/// Add `--seed N`, an integer of 64 bits.
CLI::Option* AddSeed(CLI::App& app, std::uint64_t& value, const std::string& description);

/// Add `--scale METRES_PER_UNIT`.
/// @param value  a double, or an optional one.
template <class Value>
CLI::Option* AddScale(
    CLI::App& app, Value& value,
    const std::string& description = "Metres per length unit of the object file [default: 1]") {
  return AddNumber(app, "--scale", value, NumberRange::Positive(), description, "METRES_PER_UNIT");
}

/// Add `-q, --quiet`.
CLI::Option* AddQuiet(CLI::App& app, bool& value);

/// Return the given options with their values, except those that change no result.
/// The items of a list option are one value, also if it is given several times.
[[nodiscard]] std::vector<std::pair<std::string, std::vector<std::string>>> GivenOptions(
    const CLI::App& app, const std::set<std::string>& change_nothing);

/// Friction of the command line: the friction angle or its tangent.
class FrictionOptions {
 public:
  /// Add `--friction-angle DEG` and `--mu X`.
  void AddTo(CLI::App& app);

  /// Set the friction as if the option --friction-angle, or --mu, were given alone.
  void SetDegrees(double degrees);
  void SetMu(double mu);

  /// Friction angle in radians; nullopt if neither option is given.
  /// @throws InputError  if both are given, or the angle is not inside (0°, 90°) as a double.
  [[nodiscard]] std::optional<double> friction_angle() const;

  /// Friction angle in radians.
  /// @throws InputError  as friction_angle, or if neither option is given.
  [[nodiscard]] double required_friction_angle() const;

  /// Warning about an implausible coefficient; otherwise empty.
  [[nodiscard]] std::string warning() const;

 private:
  std::optional<double> degrees_;
  std::optional<double> mu_;
};

/// Contact model of the command line: hard points or soft fingers.
class ContactOptions {
 public:
  /// Add `--torsion E`.
  /// @param usual  text of the default: "0", "that of the plan".
  void AddTo(CLI::App& app, const std::string& usual);

  /// Torsional friction length, in the object's length unit.
  /// It is grasp::Contact::torsion: 0 for hard points, nullopt if the option is not given.
  [[nodiscard]] std::optional<double> torsion() const { return torsion_; }

 private:
  std::optional<double> torsion_;
};

/// Return "; similar: --object" for the most similar word, or an empty text.
///
/// A word that starts with the given text is similar. Otherwise similarity is the number of
/// insertions, deletions, replacements and transpositions (Damerau 1964). At most one per three
/// characters is permitted. If several words are equally similar, the first is returned.
[[nodiscard]] std::string SimilarWord(const std::string& given,
                                      const std::vector<std::string>& words);

}  // namespace regrasp::apps
