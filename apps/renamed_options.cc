#include "apps/renamed_options.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

#include "planner/base/error.h"

namespace regrasp::apps {

namespace {

/// A renamed option.
struct Renaming {
  std::string_view programs;  ///< names of the programs, separated by spaces
  std::string_view old_name;
  std::string_view new_name;
  /// New value, in which `*` is replaced by the old one.
  /// If it is empty, the option keeps its value, if it has one.
  std::string_view value;
};

constexpr char kWithPlanner[] = "plan graph";
constexpr char kWithObject[] = "plan graph validate repair";
constexpr char kReplay[] = "validate";

constexpr std::array kRenamings = std::to_array<Renaming>({
    {kWithObject, "--max-deviation", "--repair", "max-deviation=*"},
    {kWithObject, "--faces", "--repair", "max-triangles=*"},
    {kWithObject, "--part", "--repair", "part=*"},
    {kWithObject, "--solidify", "--repair", "wall=*"},
    {kWithPlanner, "--roughness", "--patch", "roughness=*"},
    {kWithPlanner, "--spanning", "--planner", "spanning=*"},
    {kWithPlanner, "--contacts", "--planner", "points=*"},
    {kWithPlanner, "--clusters", "--planner", "clusters=*"},
    {kWithPlanner, "--no-lazy", "--planner", "fallback=no"},
    {kWithPlanner, "--force", "--allow", "large-graph"},
    {kWithPlanner, "--allow-invented", "--allow", "filled"},
    {"plan", "--effort", "--planner", "budget=*"},
    {"plan", "--reserve", "--robustness", ""},
    {"graph", "--queries", "--planner", "queries=*"},
    {"graph", "--sampling", "--planner", "sampling=*"},
    {"graph", "--compare", "--planner", "compare"},
    {"plan validate merge", "--fresh", "--restart", ""},
    {"validate figure", "--out", "--output", ""},
    {"validate figure", "--allow-object-change", "--allow", "object-change"},
    {kReplay, "--allow-undecided", "--allow", "undecided"},
    {kReplay, "--required-angle", "--compute", "required-angle"},
    {kReplay, "--quality", "--compute", "quality"},
    {kReplay, "--squeeze", "--grasp-force", ""},
    {kReplay, "--shake", "--disturbance", "*"},
    {kReplay, "--stress", "--disturbance", "limits"},
    {kReplay, "--align", "--replay", "align=*"},
    {kReplay, "--tip", "--replay", "tip=*"},
    {kReplay, "--tolerance-mm", "--tolerance", "*mm"},
    {kReplay, "--tolerance-deg", "--tolerance", "*deg"},
    {kReplay, "--min-pass-rate", "--trials", "min-pass-rate=*"},
    {kReplay, "--position-noise", "--trials", "position=*"},
    {kReplay, "--friction-error", "--trials", "friction=*"},
    {kReplay, "--mass-error", "--trials", "mass=*"},
    {kReplay, "--joint-noise", "--trials", "joints=*"},
    {kReplay, "--noise", "--trials", "*"},
    {kReplay, "--protocol", "--disturbance", "*"},
    {kReplay, "--animate", "--frames", "animation"},
    {kReplay, "--min-quality", "--export-states", "min-quality=*"},
    {kReplay, "--no-frames", "--frames", "none"},
    {kReplay, "--show-focus", "--show", "focus"},
    {kReplay, "--show-clusters", "--show", "clusters"},
    {kReplay, "--sheet-width", "--size", "overview=*"},
    {kReplay, "--animate-size", "--size", "animation=*"},
    {kReplay, "--zoom", "--view", "zoom=*"},
    {kReplay, "--orthographic", "--view", "orthographic"},
    {"validate figure", "--crease-angle", "--edges", "angle=*"},
    {"figure", "--width", "--size", "width=*"},
    {"figure", "--sheet-width", "--size", "sheet=*"},
    {"figure", "--font-size", "--size", "font=*"},
    {"figure", "--export-gltf", "--format", "gltf"},
    {"figure", "--contact-space", "--format", "contact-space"},
});

constexpr char kContact[] = "--contact";
constexpr char kTorsion[] = "--torsion";
constexpr char kConditions[] = "--conditions";
constexpr char kRequire[] = "--require";

bool IsOf(const Renaming& renaming, std::string_view program) {
  const std::string names = " " + std::string(renaming.programs) + " ";
  return names.find(" " + std::string(program) + " ") != std::string::npos;
}

const Renaming* FindRenaming(std::string_view program, std::string_view name) {
  const auto* found = std::ranges::find_if(kRenamings, [&](const Renaming& renaming) {
    return renaming.old_name == name && IsOf(renaming, program);
  });
  return found == kRenamings.end() ? nullptr : found;
}

std::string WithValue(std::string_view form, const std::string& value) {
  std::string text(form);
  const std::size_t star = text.find('*');
  return star == std::string::npos ? text : text.replace(star, 1, value);
}

bool HasWord(const std::vector<std::string>& words, std::string_view name) {
  return std::ranges::any_of(words, [&](const std::string& word) {
    return word == name || word.starts_with(std::string(name) + "=");
  });
}

/// Rewriter of a command line, from its first word to its last.
class Renamer {
 public:
  Renamer(std::string_view program, const std::vector<std::string>& words)
      : program_(program), words_(words) {}

  RenamedWords Run() {
    while (next_ < words_.size()) {
      if (words_[next_] == "--") break;
      RenameNext();
    }
    result_.words.insert(result_.words.end(), words_.begin() + next_, words_.end());
    return result_;
  }

 private:
  void RenameNext() {
    const std::string word = words_[next_++];
    const std::size_t sign = word.find('=');
    const std::string name = word.substr(0, sign);
    std::optional<std::string> value;
    if (sign != std::string::npos) value = word.substr(sign + 1);
    if (name == kContact && program_ != "figure") return RenameContact(value);
    if (name == kRequire && program_ == kReplay) return RenameRequire(value);
    const Renaming* renaming = FindRenaming(program_, name);
    if (renaming == nullptr) {
      result_.words.push_back(word);
    } else if (renaming->value.empty()) {
      result_.words.push_back(std::string(renaming->new_name) + word.substr(name.size()));
      Note(name, std::string(renaming->new_name));
    } else {
      RenameToItem(*renaming, value);
    }
  }

  void RenameToItem(const Renaming& renaming, std::optional<std::string> value) {
    const bool takes_value = renaming.value.find('*') != std::string_view::npos;
    const std::string new_name(renaming.new_name);
    if (takes_value && !value) value = TakeValue();
    if (takes_value && !value) return result_.words.push_back(new_name);  // the parser refuses it
    const std::string item = WithValue(renaming.value, value.value_or(""));
    result_.words.push_back(new_name + "=" + item);
    Note(std::string(renaming.old_name) + (takes_value ? " " + *value : ""), new_name + " " + item);
  }

  /// Remove `--contact hard|soft`, which the torsional friction length implies.
  void RenameContact(std::optional<std::string> value) {
    if (!value) value = TakeValue();
    if (!value || (*value != "hard" && *value != "soft")) {
      throw InputError("--contact: expected one of hard, soft, found \"" + value.value_or("") +
                       "\"; help: use --torsion E instead");
    }
    const std::string old = std::string(kContact) + " " + *value;
    if (program_ == "graph") {
      if (*value == "soft") throw InputError(old + ": not supported by graph");
      return Note(old, "the only contact model of graph");
    }
    if (*value == "soft") {
      if (!HasWord(words_, kTorsion)) throw InputError(old + ": requires --torsion E");
      return Note(old, std::string(kTorsion) + " E alone");
    }
    if (HasWord(words_, kTorsion)) throw InputError(old + ": cannot be used with --torsion");
    result_.words.push_back(std::string(kTorsion) + "=0");
    Note(old, std::string(kTorsion) + " 0");
  }

  /// Replace `--require standard|conditions[=SHARE]` by a setting of --conditions.
  void RenameRequire(std::optional<std::string> value) {
    if (!value) value = TakeValue();
    const std::string text = value.value_or("");
    const std::size_t sign = text.find('=');
    const std::string word = text.substr(0, sign);
    if (word != "standard" && word != "conditions") {
      throw InputError(std::string(kRequire) + ": expected standard or conditions, found \"" +
                       word + "\"; help: use --conditions standard,require instead");
    }
    std::string items = "require" + text.substr(word.size());
    if (word == "standard" && !HasWord(words_, kConditions)) items = "standard," + items;
    result_.words.push_back(std::string(kConditions) + "=" + items);
    Note(std::string(kRequire) + " " + text, std::string(kConditions) + " " + items);
  }

  /// Return the value of an option; nullopt if it is missing.
  std::optional<std::string> TakeValue() {
    if (next_ == words_.size() || IsOption(words_[next_])) return std::nullopt;
    return words_[next_++];
  }

  void Note(const std::string& old_form, const std::string& new_form) {
    result_.notes.push_back(old_form + " is now " + new_form);
  }

  std::string_view program_;
  const std::vector<std::string>& words_;
  std::size_t next_ = 0;
  RenamedWords result_;
};

}  // namespace

bool IsOption(std::string_view word) {
  return word.starts_with("-") && word.size() > 1 &&
         (word[1] == '-' || std::isalpha(static_cast<unsigned char>(word[1])) != 0);
}

RenamedWords RenameOptions(std::string_view program, const std::vector<std::string>& words) {
  return Renamer(program, words).Run();
}

}  // namespace regrasp::apps
