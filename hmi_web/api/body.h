#pragma once

// The body of a request: one JSON object whose members a shape names, flat but for lists of points or texts
// and for objects of texts. Nothing else gets in: unknown, missing, repeated and wrongly typed members, texts
// that are too long, numbers out of range and nesting are refused, each with line, column and key.
//
//   const Shape shape{"NewUser", {{.name = "name", .most = 32, .description = "of the user"}}};
//   auto body = read_body(R"({"name": "ada"})", shape);
//   body->text("name");                                       // "ada"
//
// Pure; any thread. Diagnostics: H0030 no JSON, H0031 unknown or repeated member, H0032 missing member, H0033
// wrong type, length or range. The file of their place is "body".

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "runtime/ground/result/result.h"

namespace stepwright::api {

// Of an object of texts: bytes of a name, and of a text unless its field says otherwise.
inline constexpr std::size_t kLongestKey = 512;
inline constexpr std::size_t kLongestText = 64;

enum class Kind { Text, Number, Boolean, Points, Texts, List };

struct Field {
  std::string name = {};
  Kind kind = Kind::Text;
  bool required = true;
  double least = 0;   // of a number; of a text: bytes; of points, texts and lists: how many
  double most = 256;  // likewise
  std::vector<std::string> choices = {};  // of a text; empty: any
  std::size_t longest = kLongestText;     // of a text in an object or a list of texts: bytes
  bool whole = false;                     // of a number
  std::string description = {};
};

struct Shape {
  std::string name;  // in the OpenAPI document; empty: there is no body
  std::vector<Field> fields;
};

struct Point {
  double x = 0;
  double y = 0;
};

class Body {
 public:
  using Texts = std::map<std::string, std::string, std::less<>>;
  using List = std::vector<std::string>;
  using Value = std::variant<std::string, double, bool, std::vector<Point>, Texts, List>;

  // The default where the member is missing or of another kind.
  const std::string& text(std::string_view name) const;
  double number(std::string_view name, double otherwise = 0) const;
  bool boolean(std::string_view name, bool otherwise = false) const;
  const std::vector<Point>& points(std::string_view name) const;
  const Texts& texts(std::string_view name) const;
  const List& list(std::string_view name) const;
  bool has(std::string_view name) const { return values_.find(name) != values_.end(); }

  void set(std::string name, Value value) { values_.insert_or_assign(std::move(name), std::move(value)); }

 private:
  template <typename T>
  const T* find(std::string_view name) const;

  std::map<std::string, Value, std::less<>> values_;
};

[[nodiscard]] result::Result<Body> read_body(std::string_view text, const Shape& shape);

}  // namespace stepwright::api
