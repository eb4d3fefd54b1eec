#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "apps/options.h"

namespace regrasp::apps {

/// Option whose value is a list: `--view 30,20,zoom=2,orthographic`.
/// Its items are values, words and KEY=VALUE settings, separated by commas. The option may be given
/// several times, and each occurrence adds its items.
///
/// Values have a fixed order. A repeated or unknown setting and a wrong number of values are bad
/// usage. Messages name a similar setting.
class ListOption {
 public:
  /// Parser of a value. The first argument is its name in messages: "--view zoom".
  using Parser = std::function<void(const std::string& name, const std::string& value)>;

  /// @param name  option name, with short name if it has one: "-o,--output".
  /// @param given  set to which the names of given items are added: "--view zoom"; may be null.
  explicit ListOption(std::string name, std::set<std::string>* given = nullptr);

  /// Add the values, in their order. Either none or all are given.
  /// @param example  text for messages: "AZIMUTH,ELEVATION, as in 30,20".
  ListOption& Values(const std::string& example, std::vector<Parser> parsers);
  /// Add a value that may be given any number of times.
  ListOption& AnyValue(Parser parser);
  /// Add a word.
  ListOption& Word(const std::string& word, std::function<void()> set);
  /// Add a setting KEY=VALUE.
  ListOption& Key(const std::string& key, Parser parser);

  /// Add the option to a command line.
  /// @param type  its value in help texts: "AZIMUTH,ELEVATION[,KEY=VALUE,…]".
  CLI::Option* AddTo(CLI::App& app, const std::string& type, const std::string& description) const;
  /// Add the option to a command line; it can be given without a value.
  CLI::Option* AddOptionalTo(CLI::App& app, const std::string& type,
                             const std::string& description) const;

 private:
  struct Setting {
    std::string key;
    Parser parser;
  };
  struct SingleWord {
    std::string word;
    std::function<void()> set;
  };

  CLI::Option* AddExpecting(int fewest, CLI::App& app, const std::string& type,
                            const std::string& description) const;
  /// @param optional  whether the option can be given without a value.
  void Parse(const std::vector<std::string>& results, bool optional) const;
  void ParseItem(const std::string& item, std::set<std::string>& seen, std::size_t& values) const;
  void ParseValue(const std::string& item, std::size_t& values) const;
  void ParseSetting(const std::string& key, const std::string& value,
                    std::set<std::string>& seen) const;
  void Note(const std::string& item) const;
  [[nodiscard]] std::vector<std::string> Names() const;

  std::string names_;
  std::string name_;  ///< long name
  std::set<std::string>* given_;
  std::string example_;
  std::vector<Parser> values_;
  Parser any_value_;
  std::vector<SingleWord> words_;
  std::vector<Setting> settings_;
};

/// Return whether an option was added by ListOption.
[[nodiscard]] bool IsList(const CLI::Option& option);

/// Return the items of all occurrences of a list option, joined by commas.
[[nodiscard]] std::string JoinItems(const std::vector<std::string>& results);

/// Return a parser of a number in a range.
/// @param value  destination: a double, or an optional one.
template <class Value>
[[nodiscard]] ListOption::Parser NumberParser(Value& value, const NumberRange& range) {
  return [&value, range](const std::string& name, const std::string& text) {
    value = ParseNumber(name, text, range);
  };
}

/// Return a parser of an integer in [lower, upper].
template <class Value, class Integer>
[[nodiscard]] ListOption::Parser IntegerParser(Value& value, Integer lower, Integer upper) {
  return [&value, lower, upper](const std::string& name, const std::string& text) {
    value = ParseInteger<Integer>(name, text, lower, upper);
  };
}

/// Return a parser of words that name values.
template <class Value>
[[nodiscard]] ListOption::Parser ChoiceParser(
    Value& value, const std::vector<std::pair<std::string, Value>>& choices) {
  return [&value, choices](const std::string& name, const std::string& text) {
    std::vector<std::string> words;
    for (const auto& choice : choices) words.push_back(choice.first);
    value = choices[FindChoice(name, text, words)].second;
  };
}

}  // namespace regrasp::apps
