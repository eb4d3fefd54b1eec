#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/object/polygon.h"
#include "planner/object/text_scanner.h"

namespace regrasp::object {

using Eigen::Vector2d;

namespace {

constexpr std::string_view kBlanks = " \t\r\n\v\f";

/// Reader of WKT. Boost.Geometry's reader depends on the locale and reports neither ring nor
/// vertex.
class WktReader {
 public:
  WktReader(std::string_view text, const std::string& name)
      : rest_(TextOf(text, name)), name_(name) {}

  PolygonRings Read() {
    const std::string kind = LowerCase(Word());
    if (kind != "polygon" && kind != "multipolygon") {
      Fail(Quoted(kind) + ", expected POLYGON or MULTIPOLYGON");
    }
    RefuseWords();
    const bool several = kind == "multipolygon";
    if (several) Expect('(');
    RefuseWords();
    PolygonRings rings = ReadPolygon();
    if (several && Peek() == ',') Fail("expected a MULTIPOLYGON of one polygon, found several");
    if (several) Expect(')');
    if (Peek() != '\0' || !rest_.empty())
      Fail("expected the end after the polygon, found " + Quoted(rest_));
    return rings;
  }

 private:
  PolygonRings ReadPolygon() {
    PolygonRings rings;
    Expect('(');
    do {
      where_ = "ring " + std::to_string(rings.size());
      rings.push_back(ReadRing());
    } while (Take(','));
    where_.clear();
    Expect(')');
    return rings;
  }

  std::vector<Vector2d> ReadRing() {
    const std::string ring = where_;
    if (LowerCase(PeekWord()) == "empty") Fail("empty");
    std::vector<Vector2d> points;
    Expect('(');
    do {
      where_ = ring + ": vertex " + std::to_string(points.size());
      const double x = ReadNumber();
      points.emplace_back(x, ReadNumber());
      if (Peek() != ',' && Peek() != ')') Fail("expected two coordinates, found more");
    } while (Take(','));
    where_ = ring;
    Expect(')');
    if (points.size() < 2 || points.front() != points.back()) {
      Fail("not closed: the last point must be the first");
    }
    points.pop_back();
    return points;
  }

  double ReadNumber() {
    const std::string_view word = Word();
    const auto value = ParseDouble(word);
    if (!value) Fail("expected a finite number, found " + Quoted(word));
    return *value;
  }

  /// Reject "POLYGON EMPTY", "POLYGON Z" and "POLYGON M".
  void RefuseWords() {
    const std::string word = LowerCase(PeekWord());
    if (word == "empty") Fail("empty");
    if (!word.empty()) Fail(Quoted(word) + ", expected \"(\"");
  }

  /// Return the next character that is not blank; '\0' at the end.
  char Peek() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kBlanks), rest_.size()));
    return rest_.empty() ? '\0' : rest_.front();
  }

  bool Take(char c) {
    if (Peek() != c || rest_.empty()) return false;
    rest_.remove_prefix(1);
    return true;
  }

  void Expect(char c) {
    if (Take(c)) return;
    const std::string expected = std::string("\"") + c + "\"";
    if (rest_.empty()) Fail("truncated, expected " + expected);
    Fail(Quoted(rest_.substr(0, 1)) + ", expected " + expected);
  }

  std::string_view PeekWord() {
    Peek();
    const std::size_t end = rest_.find_first_of(" \t\r\n\v\f,()");
    return rest_.substr(0, end);
  }

  std::string_view Word() {
    const std::string_view word = PeekWord();
    rest_.remove_prefix(word.size());
    return word;
  }

  [[noreturn]] void Fail(const std::string& what) const {
    throw InputError(name_ + ": " + (where_.empty() ? "" : where_ + ": ") + what);
  }

  std::string_view rest_;
  const std::string& name_;
  std::string where_;  ///< ring and vertex, for messages
};

}  // namespace

PolygonRings ReadWktRings(std::string_view text, const std::string& name) {
  return WktReader(text, name).Read();
}

}  // namespace regrasp::object
