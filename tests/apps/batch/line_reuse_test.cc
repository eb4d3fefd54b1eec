// Law on the reuse of results of an earlier run over many lines.
// After any change of one byte, exactly the results with unchanged inputs are reused. The work is a
// stub; all other code is that of the programs.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <random>
#include <set>

#include "apps/batch/line_run.h"
#include "apps/batch/object_cache.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/json.h"
#include "tests/fixtures/folder_test.h"

namespace regrasp::apps {
namespace line_reuse_test {

namespace fs = std::filesystem;

constexpr int kEntries = 1000;
constexpr int kObjects = 10;
constexpr unsigned kSeed = 56;

using Entries = std::set<std::int64_t>;

class LineReuseTest : public FolderTest {
 protected:
  LineReuseTest() {
    for (int i = 0; i < kObjects; ++i) WriteObject(i, "object " + std::to_string(i));
    for (int i = 0; i < kEntries; ++i) {
      // Every tenth line is a copy of another one.
      const int same = i % 10 == 9 ? i / 100 : i;
      lines_.push_back(R"({"object":{"file":")" + ObjectName(same % kObjects) + R"("},"seed":)" +
                       std::to_string(same) + "}");
    }
  }

  static std::string ObjectName(int i) { return "body_" + std::to_string(i) + ".obj"; }
  void WriteObject(int i, const std::string& bytes) {
    objects_[ObjectName(i)] = bytes;
    Write("objects/" + ObjectName(i), bytes);
  }

  /// Return the object that a line names; nullopt if it is not JSON or names none.
  static std::optional<ObjectOfLine> ObjectOf(const std::string& line) {
    try {
      const Json json = ParseJson(line, "line");
      const Json object = json.is_object() ? json.value("object", Json()) : Json();
      if (!object.is_object() || !object.value("file", Json()).is_string()) return std::nullopt;
      return ObjectOfLine{object["file"].get<std::string>()};
    } catch (const InputError&) {
      return std::nullopt;
    }
  }

  /// Return all inputs of the result of a line, as text; nullopt for an invalid line.
  [[nodiscard]] std::optional<std::string> StateOf(const std::string& line) const {
    const auto object = ObjectOf(line);
    if (!object || !objects_.contains(object->name)) return std::nullopt;
    return build_ + "|" + option_ + "|" + hand_ + "|" + line + "|" + objects_.at(object->name);
  }

  /// Run over all lines. @returns processed entries.
  Entries Run() {
    ++run_;
    std::string bytes;
    for (const std::string& line : lines_) bytes += line + ending_;
    const fs::path in = Write("in.jsonl", bytes);
    InputsDigest digest;
    digest.Add("build", build_).Add("hand", Sha256(hand_)).Add("options", {{"--mu", {option_}}});
    const std::string common = digest.Finish();
    ObjectFinder finder((folder_ / "objects").string());
    LineWork work;
    work.group = [](const Line& line) { return line.text; };
    work.prepare = [](const Line&) {};
    work.work = [this](const Line& line) { return Work(line); };
    work.inputs = [&](const Line& line) {
      return EntryDigest(common, line, ObjectOf(line.text), finder);
    };
    LinesInput input(in);
    LinesOutput output(Out(), {"reports", input.entries(), {}, identity_}, false);
    EXPECT_EQ(RunLines(input, output, work, {2, {}, [](const std::string&) {}, [] {}}), 0);
    output.Finish();
    EXPECT_EQ(output.next(), std::ssize(lines_) + 1);
    return Made();
  }

  [[nodiscard]] std::string Work(const Line& line) const {
    const auto state = StateOf(line.text);
    if (!state)
      return FormatNoResult(line.entry, Outcome::kBadInput, "run " + std::to_string(run_));
    return FormatRecord(line.entry, {{"format", "regrasp-report"},
                                     {"version", 1},
                                     {"verdict", "pass"},
                                     {"run", "run " + std::to_string(run_)},
                                     {"state", Sha256(*state)}});
  }

  /// Return the entries that the last run has computed; all must have their expected results.
  [[nodiscard]] Entries Made() const {
    Entries made;
    LinesInput output(Out());
    while (const auto line = output.Next()) {
      const Json json = ParseJson(line->text, line->name);
      const auto state = StateOf(lines_[line->entry - 1]);
      EXPECT_EQ(json["query"], line->entry);
      if (state) {
        EXPECT_EQ(json["state"], Sha256(*state)) << "a stale result of entry " << line->entry;
      }
      if (json.value("run", json.value("message", "")) == "run " + std::to_string(run_)) {
        made.insert(line->entry);
      }
    }
    return made;
  }

  /// Return the entries without a result, and those whose inputs differ from those of their last
  /// result.
  Entries Expected() {
    Entries expected;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const auto state = StateOf(lines_[i]);
      const auto last = last_.find(static_cast<std::int64_t>(i) + 1);
      if (!state || last == last_.end() || last->second != *state) expected.insert(i + 1);
    }
    return expected;
  }

  /// Run and compare. @returns number of processed entries.
  std::size_t Check(const std::string& change) {
    const Entries expected = Expected();
    const Entries made = Run();
    EXPECT_EQ(made, expected) << "after " << change << ", run " << run_;
    last_.clear();
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (const auto state = StateOf(lines_[i])) last_[i + 1] = *state;
    }
    return made.size();
  }

  [[nodiscard]] fs::path Out() const { return folder_ / "out.jsonl"; }

  int Draw(int count) { return std::uniform_int_distribution(0, count - 1)(random_); }
  /// Replace a byte by a different letter.
  void ChangeByte(std::string& text) {
    char& byte = text[Draw(static_cast<int>(text.size()))];
    const char other = static_cast<char>('a' + Draw(26));
    byte = other == byte ? 'A' : other;
  }

  /// Edit a line of the results, which may stay well-formed or not.
  void EditResult() {
    std::string whole = ReadFile(Out());
    std::vector<std::size_t> begins = {0};
    for (std::size_t end = whole.find('\n'); end + 1 < whole.size();
         end = whole.find('\n', end + 1)) {
      begins.push_back(end + 1);
    }
    const int entry = Draw(static_cast<int>(begins.size()));
    const std::size_t end = whole.find('\n', begins[entry]);
    std::string line = whole.substr(begins[entry], end - begins[entry]);
    ChangeByte(line);
    whole.replace(begins[entry], line.size(), line);
    WriteFile(Out(), whole);
    // Without a header of this run, the seals still identify the entries.
    last_.erase(entry);
  }

  /// Leave the files of a process that was killed while it wrote.
  void Kill() {
    const std::string whole = ReadFile(Out());
    const std::string cut = whole.substr(0, Draw(static_cast<int>(whole.size())));
    fs::remove(Out());
    Write("out.jsonl.part", cut);
    const auto entries = std::ranges::count(cut, '\n') - 1;
    std::erase_if(last_, [&](const auto& last) { return last.first > entries; });
  }

  std::vector<std::string> lines_;
  std::map<std::string, std::string> objects_;  ///< bytes by name
  std::string build_ = "build", option_ = "0.5", hand_ = "hand", identity_ = "run", ending_ = "\n";
  int run_ = 0;
  std::map<std::int64_t, std::string> last_;  ///< inputs of the last result, by entry
  std::mt19937 random_{kSeed};
};

TEST_F(LineReuseTest, AnyByteThatChangesRedoesExactlyWhatDependsOnIt) {
  EXPECT_EQ(Check("the first run"), kEntries);
  EXPECT_EQ(Check("nothing"), 0u);
  const std::vector<std::pair<std::string, std::function<void()>>> changes = {
      {"a line", [this] { ChangeByte(lines_[Draw(kEntries)]); }},
      {"an object",
       [this] {
         const int i = Draw(kObjects);
         std::string bytes = objects_[ObjectName(i)];
         ChangeByte(bytes);
         WriteObject(i, bytes);
       }},
      {"the hand", [this] { ChangeByte(hand_); }},
      {"an option", [this] { ChangeByte(option_); }},
      {"the build", [this] { ChangeByte(build_); }},
      {"the identity of the input", [this] { ChangeByte(identity_); }},
      {"a result", [this] { EditResult(); }},
      {"a kill", [this] { Kill(); }},
      {"a kill and a line",
       [this] {
         Kill();
         ChangeByte(lines_[Draw(kEntries)]);
       }},
      {"nothing", [] {}}};
  std::map<std::string, int> checked;
  std::size_t redone = 0;
  for (int round = 0; round < 50; ++round) {
    const auto& [change, apply] = changes[round % changes.size()];
    apply();
    redone += Check(change);
    ++checked[change];
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_EQ(checked.size(), changes.size());
  EXPECT_GT(redone, 5u * 3 * kEntries);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 3)
      << "input, output and objects";
}

TEST_F(LineReuseTest, ABadLineIsTriedInEveryRunUntilItIsGood) {
  lines_.resize(20);
  lines_[4] = "{";
  Check("the first run");
  EXPECT_EQ(Check("nothing"), 1u);
  fs::remove(folder_ / "objects" / ObjectName(2));
  objects_.erase(ObjectName(2));
  const std::size_t missing = Check("an object that is gone");
  EXPECT_GT(missing, 1u);
  EXPECT_EQ(Check("nothing"), missing);
  WriteObject(2, "object 2");
  lines_[4] = lines_[3];
  EXPECT_EQ(Check("both are good"), missing);
  EXPECT_EQ(Check("nothing"), 0u);
}

TEST_F(LineReuseTest, ALineThatIsAppendedLeavesTheOthersAsTheyAre) {
  Check("the first run");
  lines_.push_back(lines_[0]);
  EXPECT_EQ(Run(), (Entries{kEntries + 1}));
  lines_.pop_back();
  EXPECT_EQ(Run(), Entries());
}

TEST_F(LineReuseTest, TheEndOfALineIsNoPartOfIt) {
  Check("the first run");
  ending_ = "\r\n";
  EXPECT_EQ(Check("line ends of Windows"), 0u);
}

TEST_F(LineReuseTest, AnEditedNumberHidesNoOtherEntry) {
  Check("the first run");
  for (const char* number : {"1000", "999999999999", "5", "-7", "18446744073709551616"}) {
    std::string whole = ReadFile(Out());
    const std::string entry = R"({"query":7,)";
    whole.replace(whole.find(entry), entry.size(), R"({"query":)" + std::string(number) + ",");
    WriteFile(Out(), whole);
    last_.erase(7);
    EXPECT_EQ(Check(number), 1u);
  }
}

TEST_F(LineReuseTest, AnObjectThatIsReplacedByOneOfTheSameNameAndLengthIsNoticed) {
  Check("the first run");
  WriteObject(3, "tcejbo 3");
  EXPECT_GT(Check("an object"), 50u);
}

TEST_F(LineReuseTest, AResultOfAnotherEntryIsNotTaken) {
  // Swap two lines and their results: every line then has a complete, sealed result for its text.
  lines_[1] = lines_[0];
  Check("the first run");
  std::string whole = ReadFile(Out());
  const std::size_t first = whole.find(R"({"query":1,)");
  const std::size_t second = whole.find(R"({"query":2,)");
  const std::size_t third = whole.find(R"({"query":3,)");
  std::string one = whole.substr(first, second - first);
  one.replace(one.find("1"), 1, "2");
  whole.replace(second, third - second, one);
  WriteFile(Out(), whole);
  EXPECT_EQ(Run(), (Entries{2}));
}

TEST(InputsDigestTest, DifferentInputsHaveDifferentDigests) {
  using Options = InputsDigest::Options;
  std::set<std::string> digests;
  int count = 0;
  const auto add = [&](InputsDigest& digest) {
    digests.insert(digest.Finish());
    ++count;
  };
  const auto with = [](const std::string& name, const std::string& value) {
    InputsDigest digest;
    digest.Add(name, value);
    return digest;
  };
  InputsDigest none;
  InputsDigest absent;
  absent.AddAbsent("start");
  add(none);
  add(absent);
  for (const char* value : {"", "-", "random", "random-any", "null", "0:", "\xff", "\xfe"}) {
    InputsDigest digest = with("start", value);
    add(digest);
  }
  InputsDigest goal = with("goal", "random"), both = with("start", "random");
  both.Add("goal", "random");
  add(goal);
  add(both);
  for (const Options& options :
       {Options{}, Options{{"--mu", {}}}, Options{{"--mu", {"0.5"}}}, Options{{"--mu", {"0.50"}}},
        Options{{"--mu", {"0", ".5"}}}, Options{{"--mu", {"0.5"}}, {"--seed", {}}},
        Options{{"--mu", {"0.5", "--seed"}}}, Options{{"--mu", {"\xff"}}},
        Options{{"--mu", {"\xfe"}}}}) {
    InputsDigest digest;
    digest.Add("options", options);
    add(digest);
  }
  EXPECT_EQ(static_cast<int>(digests.size()), count);
  EXPECT_EQ(count, 21);
}

TEST(SealTest, TellsAnEditedLineFromOneAsItWasWritten) {
  const std::string inputs = Sha256("inputs");
  const std::string record = FormatRecord(
      7, {{"format", "regrasp-report"}, {"version", 1}, {"verdict", "pass"}, {"x", "y"}});
  const std::string sealed = SealRecord(record, 7, inputs);
  EXPECT_EQ(OutcomeOf(sealed, 7), Outcome::kPass);
  EXPECT_EQ(SealedInputs(sealed), inputs);
  EXPECT_EQ(ParseJson(sealed, "line")["inputs_sha256"], inputs);
  int edited = 0;
  for (std::size_t i = 0; i < sealed.size(); ++i, ++edited) {
    std::string other = sealed;
    other[i] = other[i] == 'z' ? 'y' : 'z';
    EXPECT_FALSE(SealedInputs(other)) << i;
    EXPECT_FALSE(SealedInputs(sealed.substr(0, i))) << i;
  }
  EXPECT_GT(edited, 200);
  EXPECT_FALSE(SealedInputs(record));
  EXPECT_FALSE(SealedInputs(sealed + "}"));
  for (const Outcome outcome : {Outcome::kBadInput, Outcome::kError}) {
    const std::string line = FormatNoResult(7, outcome, "why");
    EXPECT_EQ(SealRecord(line, 7, inputs), line);
  }
  EXPECT_TRUE(SealedInputs(SealRecord(FormatNoResult(7, Outcome::kNoPlan, "none"), 7, inputs)));
}

}  // namespace line_reuse_test
}  // namespace regrasp::apps
