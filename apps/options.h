#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

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

/// Adds an option that takes a finite number inside `range`, read the same under any locale.
CLI::Option* AddNumber(CLI::App& app, const std::string& name, double& value,
                       const NumberRange& range, const std::string& description);
CLI::Option* AddNumber(CLI::App& app, const std::string& name, std::optional<double>& value,
                       const NumberRange& range, const std::string& description);

/// Adds an option that takes a decimal integer in [lower, upper].
CLI::Option* AddInteger(CLI::App& app, const std::string& name, int& value, int lower, int upper,
                        const std::string& description);
CLI::Option* AddInteger(CLI::App& app, const std::string& name, std::optional<int>& value,
                        int lower, int upper, const std::string& description);

/// Adds `--seed N`, any number of 64 bits.
CLI::Option* AddSeed(CLI::App& app, std::uint64_t& value, const std::string& description);

/// Adds `--scale METRES_PER_UNIT`.
CLI::Option* AddScale(CLI::App& app, double& value);
CLI::Option* AddScale(CLI::App& app, std::optional<double>& value);

/// Adds `--quiet`.
CLI::Option* AddQuiet(CLI::App& app, bool& value);

/// Friction as the command line gives it: the cone's half-angle or its tangent.
class FrictionOptions {
 public:
  /// Adds `--friction-angle DEG` and `--mu X`.
  void AddTo(CLI::App& app);

  /// The half-angle in radians; nullopt where neither option is given.
  /// @throws InputError  both are given, or the half-angle is not inside (0°, 90°) as a double.
  [[nodiscard]] std::optional<double> half_angle() const;

  /// @throws InputError  also where neither is given.
  [[nodiscard]] double required_half_angle() const;

 private:
  std::optional<double> degrees_;
  std::optional<double> mu_;
};

}  // namespace regrasp::apps
