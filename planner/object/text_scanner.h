#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace regrasp::object {

/// Cuts text into words, the same under any locale, and knows where it is for messages.
///
/// Blanks, and line ends as LF, CR LF or CR, separate words; '#' starts a comment that ends with
/// the line; a backslash at the end of a line joins it with the next, as in OBJ.
class TextScanner {
 public:
  /// @param text  must outlive the scanner.
  TextScanner(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {}

  /// The next word; nullopt at the end of the text.
  std::optional<std::string_view> Next();
  /// The next word on this line; nullopt at its end.
  std::optional<std::string_view> NextOnLine();
  /// Goes on with the next line.
  void SkipLine();

  /// The next word as a number. `what` says which, for the message.
  /// @throws InputError  the text ends, or the word is not a finite number or not an integer.
  double ReadDouble(const std::string& what);
  long long ReadInteger(const std::string& what);
  /// Reads a word that must be `expected`, in whatever case.
  void Expect(std::string_view expected);

  /// Where the next word will be read.
  [[nodiscard]] std::size_t position() const { return position_; }

  /// @throws InputError  "mesh.obj: line 12: …"
  [[noreturn]] void Fail(const std::string& message) const;

 private:
  bool SkipBlanks(bool across_lines);
  std::string_view ReadWord(const std::string& what);

  std::string_view text_;
  std::string name_;
  std::size_t position_ = 0;
  int line_ = 1;
};

/// A word of a file for a message: short, and without bytes that a terminal would act on.
[[nodiscard]] std::string Quoted(std::string_view word);

/// Lower case of ASCII letters, whatever the locale.
[[nodiscard]] std::string LowerCase(std::string_view word);

/// A whole word as an integer.
[[nodiscard]] std::optional<long long> ParseInteger(std::string_view word);

}  // namespace regrasp::object
