#include "apps/list_option.h"

#include <algorithm>
#include <sstream>

#include "apps/options.h"

namespace regrasp::apps {

namespace {

std::vector<std::string> SplitItems(const std::string& text) {
  std::vector<std::string> items;
  std::istringstream stream(text + ",");  // the last item can be empty
  for (std::string item; std::getline(stream, item, ',');) items.push_back(item);
  return items;
}

std::string Enumerated(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

ListOption::ListOption(std::string name, std::set<std::string>* given)
    : names_(std::move(name)), name_(LongName(names_)), given_(given) {}

ListOption& ListOption::Values(const std::string& example, std::vector<Parser> parsers) {
  example_ = example;
  values_ = std::move(parsers);
  return *this;
}

ListOption& ListOption::AnyValue(Parser parser) {
  any_value_ = std::move(parser);
  return *this;
}

ListOption& ListOption::Word(const std::string& word, std::function<void()> set) {
  words_.push_back({word, std::move(set)});
  return *this;
}

ListOption& ListOption::Key(const std::string& key, Parser parser) {
  settings_.push_back({key, std::move(parser)});
  return *this;
}

CLI::Option* ListOption::AddTo(CLI::App& app, const std::string& type,
                               const std::string& description) const {
  return AddExpecting(1, app, type, description);
}

CLI::Option* ListOption::AddOptionalTo(CLI::App& app, const std::string& type,
                                       const std::string& description) const {
  return AddExpecting(0, app, type, description);
}

CLI::Option* ListOption::AddExpecting(int fewest, CLI::App& app, const std::string& type,
                                      const std::string& description) const {
  const auto parse = [list = *this, fewest](const std::vector<std::string>& results) {
    list.Parse(results, fewest == 0);
  };
  return app.add_option_function<std::vector<std::string>>(names_, parse, description)
      ->type_name(type)
      ->expected(fewest, 1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void ListOption::Parse(const std::vector<std::string>& results, bool optional) const {
  std::set<std::string> seen;
  std::size_t values = 0;
  for (const std::string& result : results) {
    if (result.empty() && optional) continue;
    for (const std::string& item : SplitItems(result)) ParseItem(item, seen, values);
  }
  if (values > 0 && values < values_.size()) {
    throw CLI::ValidationError(name_,
                               "expected " + example_ + ", found \"" + JoinItems(results) + "\"");
  }
}

void ListOption::ParseItem(const std::string& item, std::set<std::string>& seen,
                           std::size_t& values) const {
  const std::size_t sign = item.find('=');
  if (sign != std::string::npos) {
    return ParseSetting(item.substr(0, sign), item.substr(sign + 1), seen);
  }
  const auto word = std::ranges::find(words_, item, &SingleWord::word);
  if (word == words_.end()) return ParseValue(item, values);
  word->set();
  Note(item);
}

void ListOption::ParseValue(const std::string& item, std::size_t& values) const {
  if (any_value_) return any_value_(name_, item);
  if (values < values_.size()) return values_[values++](name_, item);
  const std::vector<std::string> names = Names();
  throw CLI::ValidationError(
      name_, (names.empty() ? "expected " + example_ : "expected one of " + Enumerated(names)) +
                 ", found \"" + item + "\"" + SimilarWord(item, names));
}

void ListOption::ParseSetting(const std::string& key, const std::string& value,
                              std::set<std::string>& seen) const {
  const auto setting = std::ranges::find(settings_, key, &Setting::key);
  if (setting == settings_.end()) {
    const std::vector<std::string> names = Names();
    throw CLI::ValidationError(name_, "unknown setting \"" + key + "\", expected one of " +
                                          Enumerated(names) + SimilarWord(key + "=", names));
  }
  if (!seen.insert(key).second) {
    throw CLI::ValidationError(name_ + " " + key, "found twice, expected once");
  }
  setting->parser(name_ + " " + key, value);
  Note(key);
}

void ListOption::Note(const std::string& item) const {
  if (given_ != nullptr) given_->insert(name_ + " " + item);
}

std::vector<std::string> ListOption::Names() const {
  std::vector<std::string> names;
  for (const SingleWord& word : words_) names.push_back(word.word);
  for (const Setting& setting : settings_) names.push_back(setting.key + "=");
  return names;
}

bool IsList(const CLI::Option& option) {
  return option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll &&
         option.get_items_expected_max() == 1;
}

std::string JoinItems(const std::vector<std::string>& results) {
  std::string text;
  for (const std::string& result : results) {
    if (!result.empty()) text += (text.empty() ? "" : ",") + result;
  }
  return text;
}

}  // namespace regrasp::apps
