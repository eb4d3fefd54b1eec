#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace regrasp::object {

/// Scanner that splits text into words and knows its position for messages.
///
/// The result does not depend on the locale. Words are separated by blanks and line ends (LF, CR LF
/// or CR). '#' starts a comment until the end of the line. A backslash at the end of a line joins
/// it with the next, as in OBJ.
class TextScanner {
 public:
  /// @param text  must outlive the scanner.
  TextScanner(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {}

  /// Return the next word; nullopt at the end of the text.
  std::optional<std::string_view> Next();
  /// Return the next word on this line; nullopt at its end.
  std::optional<std::string_view> NextOnLine();
  /// Skip to the next line.
  void SkipLine();

  /// Read the next word as a number.
  /// @param what  name of the number for messages.
  /// @throws InputError  if the text ends, or the word is not a finite number or not an integer.
  double ReadDouble(const std::string& what);
  long long ReadInteger(const std::string& what);
  /// Read a word that must be `expected`, in any case.
  void Expect(std::string_view expected);

  /// Index of the first character that is not read yet.
  [[nodiscard]] std::size_t position() const { return position_; }

  /// Throw an InputError with name and line: "mesh.obj: line 12: …".
  [[noreturn]] void Fail(const std::string& message) const;

 private:
  bool SkipBlanks(bool across_lines);
  std::string_view ReadWord(const std::string& what);

  std::string_view text_;
  std::string name_;
  std::size_t position_ = 0;
  int line_ = 1;
};

/// Quote a word of a file for a message: shortened, and without control characters of terminals.
[[nodiscard]] std::string Quoted(std::string_view word);

/// Convert ASCII letters to lower case, in any locale.
[[nodiscard]] std::string LowerCase(std::string_view word);

/// Parse a whole word as an integer; nullopt if it is not one.
[[nodiscard]] std::optional<long long> ParseInteger(std::string_view word);

}  // namespace regrasp::object
